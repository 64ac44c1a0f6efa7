// The reduced search from several starts.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/multi_start.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

MultiStartOptions planar_options() {
  MultiStartOptions options;
  options.search.steps = 12;
  options.search.demands.force = {20, 20};
  options.search.weights.effort = 0.05;
  options.starts = 5;
  return options;
}

JointPath planar_path(int via) { return JointPath({degrees({10, 60}), degrees({60, -60})}).resampled(via); }

}  // namespace

TEST_CASE("starts: within all limits, near the given path, of one seed always the same", "[dress_pack]") {
  PackProblem pack = planar_pack(8);
  std::vector<Joint> joints = pack.robot->joints();
  joints[1].upper = 65 * units::deg;
  joints[0].velocity = joints[1].velocity = 1.1;
  const Robot robot("limited", pack.robot->links(), joints);
  const JointPath path = planar_path(6);
  double farthest = 0;
  for (int number = 1; number <= 30; ++number) {
    CAPTURE(number);
    const JointPath start = strayed(path, robot, 0.5, 2.2, 7, number);
    CHECK(beyond_robot(start, robot, 2.2) == "");
    CHECK(start.via().front() == path.via().front());
    CHECK(start.via().back() == path.via().back());
    for (int k = 0; k < 6; ++k) farthest = std::max(farthest, (start.via()[k] - path.via()[k]).cwiseAbs().maxCoeff());
    CHECK(strayed(path, robot, 0.5, 2.2, 7, number).via()[3] == start.via()[3]);
    CHECK(strayed(path, robot, 0.5, 2.2, 8, number).via()[3] != start.via()[3]);
    CHECK(strayed(path, robot, 0, 2.2, 7, number).via()[3] == path.via()[3]);
  }
  CHECK(farthest <= 0.5);
  CHECK(farthest > 0.1);
}

TEST_CASE("several starts: the best of them, each as if searched alone", "[dress_pack]") {
  const PackProblem pack = planar_pack(10);
  const MultiStartOptions options = planar_options();
  const JointPath path = planar_path(5);
  RunContext context;
  context.seed = 11;
  const MultiStartResult found = optimise_from_starts(pack, path, options, context);
  REQUIRE(found.ok());
  REQUIRE(found.starts.size() == 5);
  double least = INFINITY;
  for (int k = 0; k < 5; ++k) {
    CAPTURE(k);
    const ReducedResult alone = optimise(pack, found.starts[k].start, options.search);
    CHECK(alone.objective == found.starts[k].objective);
    CHECK(alone.objective_before == found.starts[k].objective_before);
    least = std::min(least, alone.objective);
  }
  CHECK(found.objective == least);
  CHECK(found.starts[found.best].objective == least);
  CHECK(found.starts[0].start.via()[2] == path.via()[2]);
  CHECK(found.objective_before == found.starts[0].objective_before);
  CHECK(found.before.largest_end_force() == optimise(pack, path, options.search).before.largest_end_force());
}

TEST_CASE("several starts: the same bits for any number of threads", "[dress_pack]") {
  const PackProblem pack = planar_pack(8);
  RunContext one, three;
  one.threads = 1;
  three.threads = 3;
  const MultiStartResult a = optimise_from_starts(pack, planar_path(4), planar_options(), one);
  const MultiStartResult b = optimise_from_starts(pack, planar_path(4), planar_options(), three);
  REQUIRE(a.ok());
  CHECK(a.best == b.best);
  for (int k = 0; k < 5; ++k) CHECK(a.starts[k].objective == b.starts[k].objective);
  for (int k = 0; k < 4; ++k) CHECK(a.path.via()[k] == b.path.via()[k]);
}

TEST_CASE("several starts: interrupted, refused, infeasible, and without free via points", "[dress_pack]") {
  const PackProblem pack = planar_pack(8);
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  context.threads = 1;
  context.progress = [&](double, const char*) { cancel = true; };
  const MultiStartResult cut = optimise_from_starts(pack, planar_path(4), planar_options(), context);
  CHECK(cut.status == Status::cancelled);
  CHECK_THAT(cut.message, Contains("best path so far"));
  CHECK(cut.objective < cut.objective_before);
  MultiStartOptions options = planar_options();
  options.starts = 0;
  CHECK_THROWS_WITH(optimise_from_starts(pack, planar_path(4), options), Contains("0 starts"));
  options = planar_options();
  options.spread = -1;
  CHECK_THROWS_WITH(optimise_from_starts(pack, planar_path(4), options), Contains("stray by -1 rad"));
  options = planar_options();
  options.search.steps = 0;
  CHECK_THROWS_WITH(optimise_from_starts(pack, planar_path(4), options), Contains("0 time steps"));
  const MultiStartResult beyond = optimise_from_starts(pack, JointPath({degrees({0, 60}), degrees({0, 200})}), planar_options());
  CHECK(beyond.status == Status::infeasible);
  CHECK_THAT(beyond.message, Contains("joint_2"));
  const MultiStartResult none = optimise_from_starts(pack, planar_path(2), planar_options());
  CHECK(none.ok());
  CHECK(none.starts.size() == 1);
}
