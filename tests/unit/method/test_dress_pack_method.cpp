// The whole method: given path, search, optimised path, and what is said of them.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/units.h"
#include "method/dress_pack/dress_pack.h"
#include "method/dress_pack/multi_start.h"
#include "robot/load_robot.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::dress_pack;
using namespace tendril::test;
using Catch::Matchers::Contains;

namespace {

/// A motion of one rod with two attachments, by hand.
PackMotion motion_of(const std::vector<std::array<double, 5>>& rows) {
  PackMotion motion;
  motion.status = Status::solved;
  for (const auto& [t, force, twist, bend_radius, clearance] : rows) {
    PackStep step;
    step.t = t;
    step.ends.resize(2);
    step.ends[0].force = {0.6 * force, 0, 0.8 * force};
    step.ends[1].force = {0, 1, 0};
    RodReport rod;
    rod.twist = twist;
    rod.bend_radius = bend_radius;
    rod.clearance = clearance;
    step.rods = {rod};
    motion.steps.push_back(std::move(step));
  }
  return motion;
}

/// builtin:six_axis with a hose of 1.6 m from its upper arm to its hand, and a path that pulls it taut on the way.
PackProblem upper_arm_pack() {
  PackProblem pack;
  pack.robot = load_robot("builtin:six_axis");
  pack.rods = {hose(1.6, 16)};
  pack.attachments = {{0, 0, pack.robot->link("link_2"), Frame::looking({0.05, 0.2, 0.75}, {1, 0, 1}, {0, 0, 1})},
                      {0, 1, pack.robot->link("link_6"), Frame::looking({0.05, 0, 0.15}, {1, 0, 0}, {0, 0, 1})}};
  return pack;
}
JointPath taut_path() {
  return JointPath({degrees({0, 0, 0, 0, 0, 0}), degrees({30, 10, -75, 20, 40, 0}), degrees({60, 0, 0, 0, 0, 0})}).resampled(8);
}

JointPath planar_path(int via) {
  return JointPath({degrees({-20, 60}), degrees({30, 10}), degrees({80, 60})}).resampled(via);
}

}  // namespace

TEST_CASE("unmet limits: the worst time and place of each, and between which times", "[dress_pack]") {
  PackProblem pack = planar_pack(8);
  pack.names = {"hose"};
  const PackMotion motion = motion_of({{0, 10, 0.5, 0.2, 0.1}, {0.25, 50, 3, 0.06, 0.02}, {0.5, 80, 1, 0.04, 0.004}, {0.75, 41, 1, 0.2, 0.03}, {1, 20, 4, 0.3, 0.1}});
  Limits limits;
  CHECK(unmet_of(pack, motion, limits).empty());
  limits.max_tension = 40;
  limits.max_twist = 2;
  limits.min_bend_radius = 0.05;
  limits.clearance = 0.005;
  const std::vector<Unmet> found = unmet_of(pack, motion, limits);
  REQUIRE(found.size() == 4);
  CHECK(found[0].what == Unmet::What::tension);
  CHECK(found[0].value == Approx(80));
  CHECK(found[0].demanded == 40);
  CHECK(found[0].t == 0.5);
  CHECK(found[0].from == 0.25);
  CHECK(found[0].to == 0.75);
  CHECK(found[0].where == "hose.start");
  CHECK_FALSE(found[0].at_end);
  CHECK(found[0].text == "a force of 80 N on 'hose.start' at t = 0.5, at most 40 N asked for");
  CHECK(found[1].what == Unmet::What::twist);
  CHECK(found[1].at_end);
  CHECK(found[1].text == "'hose' is twisted by 229.183 deg/m at t = 1, an end of the path, at most 114.592 asked for");
  CHECK(found[2].text == "'hose' is bent to a radius of 40 mm at t = 0.5, at least 50 mm asked for");
  CHECK(found[3].text == "a clearance of 'hose' of 4 mm at t = 0.5, 5 mm asked for");
  // A thousandth beyond is kept.
  limits = {};
  limits.max_tension = 80 / 1.0009;
  CHECK(unmet_of(pack, motion, limits).empty());
  limits.max_tension = 80 / 1.0011;
  CHECK(unmet_of(pack, motion, limits).size() == 1);
}

TEST_CASE("dress pack: a path is simulated, optimised and simulated again", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  Options options;
  options.steps = 12;
  options.checked_steps = 48;
  const Result found = run(pack, planar_path(5), options);
  INFO(found.message);
  REQUIRE(found.ok);
  CHECK(found.status == Status::solved);
  CHECK(found.before.steps.size() == 49);
  CHECK(found.after.steps.size() == 49);
  CHECK(found.objective < found.objective_before);
  double before = 0, after = 0;
  for (int k = 0; k <= 48; ++k) {
    before += found.before.steps[k].ends[0].force.squaredNorm();
    after += found.after.steps[k].ends[0].force.squaredNorm();
    CHECK(found.after.steps[k].residual < 1e-5);
    CHECK(pack.robot->within_limits({found.after.steps[k].q.data(), 2}, 1e-12));
  }
  CHECK(after < before);
  REQUIRE(found.steps.size() == 3);
  CHECK(found.steps[0].name == "simulation of the given path");
  CHECK(found.steps[1].name == "optimisation of the via points");
  CHECK(found.steps[2].name == "simulation of the optimised path");
  // The first and last configurations stand.
  CHECK(found.path.via().front() == found.given.via().front());
  CHECK(found.path.via().back() == found.given.via().back());
}

TEST_CASE("dress pack: a limit that can be kept is kept, whatever its first weight", "[dress_pack]") {
  const PackProblem pack = upper_arm_pack();
  Options options;
  options.checked_steps = 60;
  options.optimise = false;
  const JointPath path = taut_path();
  const Result given = run(pack, path, options);
  REQUIRE(given.before.ok());
  const double ends = std::max(given.before.steps.front().ends[0].force.norm(), given.before.steps.back().ends[0].force.norm());
  const double worst = given.before.largest_end_force();
  REQUIRE(worst > 4 * ends);
  options.optimise = true;
  options.limits.max_tension = 1.5 * ends;
  const Result found = run(pack, path, options);
  INFO(found.message);
  CHECK(found.ok);
  CHECK_FALSE(found.unmet_before.empty());
  CHECK(found.unmet.empty());
  CHECK(found.after.largest_end_force() <= 1.5 * ends * 1.001);
  // One that the first configuration breaks already: said, and that no via point changes it.
  options.limits = {};
  options.limits.max_tension = 0.5 * given.before.steps.front().ends[0].force.norm();
  const Result never = run(pack, path, options);
  CHECK_FALSE(never.ok);
  CHECK(never.status == Status::infeasible);
  REQUIRE_FALSE(never.unmet.empty());
  CHECK_THAT(never.message, Contains("the best path found has a force of") && Contains("an end of the path"));
  CHECK(never.unmet.front().at_end);
}

TEST_CASE("dress pack: without optimisation the given path is judged, no more", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  Options options;
  options.optimise = false;
  options.checked_steps = 20;
  options.via = 9;
  options.limits.max_tension = 1e-3;
  const Result found = run(pack, planar_path(3), options);
  CHECK(found.steps.size() == 1);
  CHECK(found.iterations == 0);
  CHECK(found.path.via() == found.given.via());
  CHECK(found.path.points() == 9);
  CHECK_FALSE(found.ok);
  CHECK_THAT(found.message, Contains("the path has a force of") && Contains("at most 0.001 N asked for"));
  CHECK(found.unmet.size() == found.unmet_before.size());
}

TEST_CASE("dress pack: a robot too near a fixed body is said, without optimisation as well", "[dress_pack]") {
  PackProblem pack = upper_arm_pack();
  Options options;
  options.optimise = false;
  options.checked_steps = 10;
  options.limits.robot_clearance = 0.05;
  // A ball that moves with the hand, and one 20 mm beside where it is at the start.
  const int hand = pack.robot->link("link_6");
  const JointPath path({degrees({0, 0, 0, 0, 0, 0}), degrees({-40, 0, 0, 0, 0, 0})});
  const JointVector start = path.at(0);
  const Frame at = pack.robot->link_frame(hand, {start.data(), 6});
  Mesh skin;
  skin.vertices = {{0.1, 0, 0}, {-0.1, 0, 0}, {0, 0.1, 0}, {0, -0.1, 0}, {0, 0, 0.1}, {0, 0, -0.1}};
  skin.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const auto body = std::make_shared<const TriangleSurface>(skin);
  pack.bodies = {{{body, {at.at + Vec3(0, 0.22, 0), at.rotation}, 0, "beside"}}, {{body, {}, 0, "hand"}, hand}};
  const Result near = run(pack, path, options);
  REQUIRE(near.before.ok());
  REQUIRE(near.unmet.size() == 1);
  CHECK(near.unmet[0].what == Unmet::What::robot_clearance);
  CHECK(near.unmet[0].at_end);
  CHECK(near.unmet[0].value == Approx(near.before.steps[0].robot.clearance));
  CHECK(near.unmet[0].value == Approx(0.02).margin(1e-9));
  CHECK_THAT(near.message, Contains("a clearance of the robot of 20 mm at t = 0, an end of the path, 50 mm asked for"));
  options.limits.robot_clearance = 0.015;
  CHECK(run(pack, path, options).unmet.empty());
}

TEST_CASE("dress pack: what cannot be is refused, with the reason", "[dress_pack]") {
  const PackProblem pack = planar_pack(8);
  const Result beyond = run(pack, JointPath({degrees({0, 60}), degrees({0, 200})}));
  CHECK(beyond.status == Status::infeasible);
  CHECK_FALSE(beyond.ok);
  CHECK_THAT(beyond.message, Contains("via point 1") && Contains("joint_2"));
  auto refuses = [&](auto change, const char* says) {
    Options options;
    change(options);
    CHECK_THROWS_WITH(run(pack, planar_path(3), options), Contains(says));
  };
  refuses([](Options& o) { o.limits.max_tension = 0; }, "a largest tension of 0");
  refuses([](Options& o) { o.limits.max_twist = -1; }, "a largest twist of -1");
  refuses([](Options& o) { o.limits.min_bend_radius = NAN; }, "a smallest bend radius of nan");
  refuses([](Options& o) { o.limits.clearance = INFINITY; }, "a clearance of inf");
  refuses([](Options& o) { o.checked_steps = 0; }, "0 checked steps");
  refuses([](Options& o) { o.starts = 0; }, "0 starts");
  refuses([](Options& o) { o.starts = 3; o.formulation = Formulation::direct; }, "3 starts by the direct formulation");
  refuses([](Options& o) { o.steps = 0; }, "0 time steps");
}

TEST_CASE("dress pack: interrupted, what was found stands", "[dress_pack]") {
  const PackProblem pack = six_axis_pack(12);
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  int calls = 0;
  context.progress = [&](double, const char* what) {
    if (std::string(what) == "optimisation" && ++calls == 2) cancel = true;
  };
  Options options;
  options.checked_steps = 40;
  const Result found = run(pack, problematic_path(), options, context);
  CHECK(found.status == Status::cancelled);
  CHECK_FALSE(found.ok);
  CHECK(found.objective < found.objective_before);
  CHECK(found.path.via() != found.given.via());
  CHECK(beyond_robot(found.path, *pack.robot) == "");
}

TEST_CASE("dress pack: of several starts the best", "[dress_pack]") {
  const PackProblem pack = six_axis_pack(8);
  Options options;
  options.steps = 10;
  options.checked_steps = 20;
  options.starts = 6;
  RunContext context;
  context.seed = 5;
  const JointPath path = problematic_path(4);
  const Result found = run(pack, path, options, context);
  INFO(found.message);
  MultiStartOptions several;
  several.starts = 6;
  several.search.steps = 10;
  several.search.demands = demands_of({}, found.before.largest_end_force(), 0);
  const MultiStartResult alone = optimise_from_starts(pack, path, several, context);
  REQUIRE(alone.best > 0);  // else this would say nothing
  CHECK(found.objective == alone.objective);
  CHECK(found.objective_before == alone.objective_before);
  CHECK(found.path.via()[1] == alone.path.via()[1]);
  options.starts = 1;
  CHECK(found.objective < run(pack, path, options, context).objective);
}
