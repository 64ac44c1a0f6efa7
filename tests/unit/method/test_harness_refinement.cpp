// What a harness is built to so that it keeps at rest what its route keeps: derivatives, known answers, clips.
#include <bit>
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/route/harness_clips.h"
#include "method/route/harness_model.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

namespace {

Section cable() { return Section::round(0.012, 0, Material::from_poisson(2e7, 0.4, 1500)); }

/// Connections in a plane z = 0, `out` from each other along x, two branches spread by `wide` along y.
HarnessOptions wye(double out, double wide) {
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(out, wide, 0), -Vec3::UnitX()),
                         Frame::looking(Vec3(out, -wide, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.03;
  options.end_straight = 0.01;
  options.bundling = 1;
  return options;
}

Scene over_floor(double depth) {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid_of("floor", Box{Vec3(1.6, 0.8, 0.4)}, Vec3(0.6, 0, -depth - 0.2)));
  return scene;
}

HarnessResult only_routed(const Scene& scene, HarnessOptions options) {
  options.equilibrium = false;
  HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  return r;
}

}  // namespace

TEST_CASE("slopes of a harness at rest are those of differences", "[harness]") {
  Scene scene = over_floor(0.03);
  scene.add(solid_of("post", Cylinder{0.03, 0.4}, Vec3(0.3, 0.1, 0)));
  HarnessOptions options = wye(0.6, 0.15);
  options.space.clearance = 0.005;
  options.space.clearance_weight = 0.5;
  options.space.preference_range = 0.15;
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.4), Vec3(1, 0.5, 0.4));
  const HarnessResult r = only_routed(scene, options);
  HarnessDesign design = design_as_routed(r);
  const bool clipped = GENERATE(false, true);
  if (clipped) {
    const Curve curve = r.branches[0].points.curve();
    design.clips = {{0, 0.4 * curve.length(), 0.4 * curve.length(), curve.at(0.4 * curve.length()), "post", 0}};
  }
  const HarnessSurroundings around(scene, r);
  const HarnessVariables variables(scene, r, design);
  CHECK(variables.size() == static_cast<int>(r.branches.size()) + 2 + (clipped ? 1 : 0));
  const RunContext context;
  HarnessModel model(around, r, variables, context);
  Eigen::VectorXd x = model.start();
  // Away from where it began, tilts and all.
  for (int v = 0; v < x.size(); ++v)
    x[v] += variables.variables()[v].kind == HarnessVariables::Variable::Kind::tilt ? 0.4 - 0.3 * (v % 2) : 0.3 + 0.1 * v;
  for (const Eigen::VectorXd& at : {model.start(), x}) {
    const bool found = model.evaluate(at).valid;
    INFO(model.candidate().equilibrium->message());
    REQUIRE(found);
    model.accept();
  }
  ConstrainedProblem::Linear linear;
  REQUIRE(model.linearise({}, linear));
  REQUIRE(linear.tags.size() > 5);
  constexpr double step = 1e-3;
  for (int v = 0; v < x.size(); ++v) {
    Eigen::VectorXd more = x, less = x;
    more[v] += step;
    less[v] -= step;
    const double cost_more = model.evaluate(more).cost;
    const Eigen::VectorXd up = model.slacks(linear.tags);
    const double cost_less = model.evaluate(less).cost;
    const Eigen::VectorXd down = model.slacks(linear.tags);
    CHECK(linear.cost[v] == Approx((cost_more - cost_less) / (2 * step)).epsilon(2e-3).margin(1e-6));
    for (std::size_t i = 0; i < linear.tags.size(); ++i) {
      INFO("variable " << v << ", constraint " << linear.tags[i].kind << " at " << linear.tags[i].place);
      CHECK(linear.slopes(static_cast<int>(i), v) == Approx((up[i] - down[i]) / (2 * step)).epsilon(5e-3).margin(2e-4));
    }
  }
}

TEST_CASE("two connections under a ceiling: the length of least cost is that of a scan", "[harness]") {
  // The shorter, the less it costs by length and the nearer it comes to the ceiling.
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid_of("ceiling", Box{Vec3(1, 0.4, 0.4)}, Vec3(0.4, 0, 0.23)));
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(0.8, 0, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.02;
  options.space.clearance_weight = 1.5;
  options.space.preference_range = 0.2;
  const HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  CHECK(r.settled_misses.empty());
  const double weight = options.space.clearance_weight, range = options.space.preference_range, radius = options.section.radius();
  const auto cost_of = [&](double length) {
    HarnessResult other = r;
    other.design.lengths[0] = length;
    const SceneEquilibrium eq = scene_of(scene, other).solve({}, {}, r.equilibrium.get());
    REQUIRE(eq.ok());
    const Equilibrium& rod = eq.rods[0].equilibrium;
    double cost = length;
    for (std::size_t i = 0; i + 1 < rod.s.size(); ++i)
      for (const std::size_t end : {i, i + 1}) {
        const double share = std::max(0.0, 1 - (0.03 - rod.points[end].z() - radius) / range);
        cost += 0.5 * (rod.s[i + 1] - rod.s[i]) * weight * share * share;
      }
    return cost;
  };
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (double length = 0.8; length < 1.0; length += 0.5e-3)
    if (const double cost = cost_of(length); cost < least) least = cost, best = length;
  INFO("scan " << best << " of " << least << ", refined " << r.design.lengths[0]);
  CHECK(best > 0.802);  // inside the range
  CHECK(r.design.lengths[0] == Approx(best).margin(1e-3));
  CHECK(cost_of(r.design.lengths[0]) <= least * (1 + 1e-5));
}

TEST_CASE("a taut harness is as short as its stretch allows", "[harness]") {
  Scene scene(Vec3(0, 0, -9.81));
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(0.6, 0, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.03;
  const HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  CHECK(r.settled_misses.empty());
  CHECK(r.branches[0].settled_length <= r.design.lengths[0] * (1 + options.max_stretch + 1e-6));
  CHECK(r.design.lengths[0] >= 0.6 - 1e-9);  // never shorter than the straight way
}

TEST_CASE("a Y over a floor is shortened until it keeps clear of it, and no neighbour is better", "[harness]") {
  const Scene scene = over_floor(0.028);
  HarnessOptions options = wye(0.7, 0.12);
  options.space.clearance = 0.008;
  HarnessOptions unrefined = options;
  unrefined.refine = false;
  const HarnessResult slack = route_harness(scene, unrefined), r = route_harness(scene, options);
  INFO(slack.message << "; " << r.message);
  REQUIRE((slack.ok && r.ok));
  CHECK_FALSE(slack.settled_misses.empty());
  CHECK(slack.design.lengths[0] == slack.branches[0].length);
  REQUIRE(r.settled_misses.empty());
  for (const HarnessBranch& branch : r.branches) {
    CHECK(branch.settled_clearance.value >= options.space.clearance - 2e-5);
    CHECK(branch.settled_bend_radius >= options.min_bend_radius * (1 - 1e-6));
  }
  const HarnessSurroundings around(scene, r);
  const HarnessVariables variables(scene, r, r.design);
  const RunContext context;
  HarnessModel model(around, r, variables, context);
  model.begin_from(r.equilibrium);
  const Eigen::VectorXd x = model.start();
  const auto merit = [&](const Eigen::VectorXd& at) {
    const ConstrainedProblem::Value value = model.evaluate(at);
    REQUIRE(value.valid);
    return value.cost + 10 * value.violation;
  };
  const double here = merit(x);
  Random random(11);
  for (int run = 0; run < 40; ++run) {
    Eigen::VectorXd other = x;
    for (double& v : other) v += random.in(-0.02, 0.02);
    CHECK(merit(other.cwiseMax(model.lower()).cwiseMin(model.upper())) >= here * (1 - 1e-4));
  }
  SECTION("the same bits for any number of threads") {
    RunContext one;
    one.threads = 1;
    const HarnessResult again = route_harness(scene, options, one);
    CHECK(again.design.lengths == r.design.lengths);
    CHECK(again.equilibria == r.equilibria);
  }
}

TEST_CASE("of few places the fewest clips are as many as trying all subsets finds", "[harness]") {
  const double depth = GENERATE(0.016, 0.02, 0.03);
  const Scene scene = over_floor(depth);
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(1, 0, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.03;
  options.space.clearance = 0.008;
  const HarnessResult r = only_routed(scene, options);
  const HarnessSurroundings around(scene, r);
  std::vector<HarnessClip> places;
  const std::vector<HarnessClip> all = harness_clip_places(around, r);
  for (std::size_t k = 1; k < all.size(); k += 2) places.push_back(all[k]);
  REQUIRE(places.size() >= 5);
  if (places.size() > 7) places.resize(7);
  constexpr double least = -3e-3;
  const HarnessClips choice = fewest_harness_clips(scene, around, r, places, 100, least, {});
  REQUIRE(choice.status == Status::solved);
  const RunContext context;
  const auto missed = [&](unsigned subset) {
    HarnessDesign design = design_as_routed(r);
    for (std::size_t k = 0; k < places.size(); ++k)
      if (subset >> k & 1) design.clips.push_back(places[k]);
    const HarnessVariables variables(scene, r, design);
    HarnessModel model(around, r, variables, context);
    const auto value = model.evaluate(model.start());
    return value.valid ? value.violation : std::numeric_limits<double>::infinity();
  };
  const double with_all = std::max(-least, missed((1u << places.size()) - 1));
  int fewest = static_cast<int>(places.size());
  for (unsigned subset = 0; subset < 1u << places.size(); ++subset)
    if (std::popcount(subset) < fewest && missed(subset) <= with_all) fewest = std::popcount(subset);
  INFO("floor " << depth << ", " << places.size() << " places, with all " << with_all);
  CHECK(static_cast<int>(choice.clips.size()) == fewest);
  CHECK(choice.enough == fewest);
  if (fewest > 1) {
    const HarnessClips less = fewest_harness_clips(scene, around, r, places, fewest - 1, least, {});
    CHECK(static_cast<int>(less.clips.size()) == fewest - 1);
    CHECK(less.enough == fewest);
  }
}

TEST_CASE("clips hold a harness where it would lie on the floor", "[harness]") {
  const Scene scene = over_floor(0.03);
  HarnessOptions options = wye(1.4, 0.3);
  options.space.clearance = 0.005;
  const HarnessResult without = route_harness(scene, options);
  REQUIRE(without.ok);
  REQUIRE_FALSE(without.settled_misses.empty());
  CHECK(without.design.clips.empty());
  CHECK(without.message.find("; at rest not all is kept: ") != std::string::npos);

  options.max_clips = 20;
  const HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  CHECK(r.settled_misses.empty());
  REQUIRE_FALSE(r.design.clips.empty());
  CHECK(r.design.clips.size() < 10);
  CHECK(r.message.find(std::to_string(r.design.clips.size()) + " of 20 clips") != std::string::npos);
  const Scene built = scene_of(scene, r);
  for (const HarnessClip& clip : r.design.clips) {
    const Frame on_route = r.branches[clip.branch].points.curve().at(clip.route_at);
    CHECK((clip.frame.at - on_route.at).norm() < 1e-12);
    CHECK(clip.obstacle == "floor");
    CHECK(clip.force > 0);
    // Where the rod is held in the scene that is built from it, and where it rests.
    const PlacedRod& rod = *built.rods()[clip.branch];
    CHECK(std::any_of(rod.holds().begin(), rod.holds().end(), [&](const Hold& h) { return h.at == clip.at && (h.frame.at - clip.frame.at).norm() < 1e-12; }));
    CHECK((r.equilibrium->rods[clip.branch].equilibrium.frame_at(clip.at).at - clip.frame.at).norm() < 1e-9);
  }
  const SceneEquilibrium again = built.solve({}, {}, r.equilibrium.get());
  REQUIRE(again.ok());
  for (std::size_t b = 0; b < r.branches.size(); ++b)
    CHECK(again.rods[b].equilibrium.settled_length() == Approx(r.branches[b].settled_length).epsilon(1e-9));

  SECTION("fewer than it needs") {
    options.max_clips = 1;
    const HarnessResult few = route_harness(scene, options);
    CHECK(few.design.clips.size() <= 1);
    INFO(few.message);
    REQUIRE_FALSE(few.settled_misses.empty());
    CHECK(few.message.find("clips that would help only 1 are allowed") != std::string::npos);
  }
  SECTION("nothing to fasten them to") {
    Scene smooth(Vec3(0, 0, -9.81));
    PlacedObstacle floor = scene.obstacles().front();
    floor.clip = false;
    smooth.add(floor);
    const HarnessResult none = route_harness(smooth, options);
    CHECK(none.design.clips.empty());
    CHECK(none.message.find("(nothing that takes clips is within 50 mm of the route)") != std::string::npos);
  }
}

TEST_CASE("zones and walls are kept at rest, or said", "[harness]") {
  Scene scene(Vec3(0, 0, -9.81));
  HarnessOptions options = wye(1.2, 0.2);
  options.restarts = 0;
  options.space.keep_out = {Eigen::AlignedBox3d(Vec3(0.4, -0.1, -0.3), Vec3(0.8, 0.1, -0.02))};
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-1, -1, -0.03), Vec3(2, 1, 1));
  HarnessOptions unrefined = options;
  unrefined.refine = false;
  const HarnessResult r = route_harness(scene, unrefined);
  INFO(r.message);
  REQUIRE(r.ok);
  std::string all;
  for (const std::string& miss : r.settled_misses) all += miss + "\n";
  INFO(all);
  CHECK(all.find("keep_out 1") != std::string::npos);
  CHECK(all.find("mm outside of keep_in") != std::string::npos);
  const HarnessResult refined = route_harness(scene, options);
  CHECK(refined.missed_share < r.missed_share);
}
