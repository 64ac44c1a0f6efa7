// Routes in equilibrium: nominal route, refinement, restarts and clips together.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/units.h"
#include "method/route/design_space.h"
#include "method/route/route.h"
#include "statics/solve.h"
#include "unit/method/refinement_cases.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

route::Options between(const Frame& from, const Frame& to) {
  route::Options options;
  options.from = from;
  options.to = to;
  options.section = soft_hose();
  options.space.radius = options.section.radius();
  options.space.clearance = 0.01;
  options.curve.radii = {0.06};
  options.segments = 60;
  return options;
}

/// A table round whose pillar a hose has to run; both take clips.
Scene table(const Frame& place = {}, bool clip = true) {
  Scene scene(Vec3(0, 0, -9.81));
  const auto add = [&](const char* name, const Solid& shape, const Vec3& at) {
    PlacedObstacle obstacle = solid(name, shape, Vec3::Zero());
    obstacle.body.pose = place * Frame{at, Quat::Identity()};
    obstacle.clip = clip;
    scene.add(obstacle);
  };
  add("table", Box{{2, 1.4, 0.1}}, {0.72, 0, -0.05});
  add("pillar", Box{{0.25, 0.5, 0.8}}, {0.72, 0, 0.3});
  return scene;
}
route::Options over_table(const Frame& place = {}) {
  return between(place * Frame::looking({0.08, 0.04, 0.04}, {1, 0, 0}), place * Frame::looking({1.36, 0.04, 0.04}, {1, 0, 0}));
}

/// Whether the design, as it stands, keeps all, and what it costs.
RefinementResult as_it_stands(const Scene& scene, const Design& design, RefinementOptions options) {
  options.adjust = {false, false, false, false, false, false};
  options.most_clips = 0;
  options.min_length.reset();
  options.max_length.reset();
  return refine(scene, design, options);
}

/// A rod is never shorter than the straight ways between its holds.
bool long_enough(const Design& design) {
  std::vector<std::pair<double, Vec3>> held = {{0, design.from.at}};
  for (const Hold& clip : design.clips) held.push_back({clip.at, clip.frame.at});
  held.push_back({design.rod.length, design.to.at});
  for (std::size_t k = 1; k < held.size(); ++k)
    if (held[k].first - held[k - 1].first < (held[k].second - held[k - 1].second).norm()) return false;
  return true;
}

/// What route::run asks of the refinement.
RefinementOptions demands_of(const route::Options& options) {
  RefinementOptions demands = options.refinement;
  demands.clearance_weight = options.weights.front().clearance;
  demands.preference_weight = options.space.preference;
  demands.range = options.space.preference_range;
  demands.min_bend_radius = options.curve.radii.front();
  demands.clearance = options.space.clearance;
  demands.free_ends = options.curve.free_ends;
  return demands;
}

}  // namespace

TEST_CASE("refined route: the length of a hose that sags to a floor to keep near is that of a scan over lengths", "[route]") {
  const double height = 0.09, apart = 0.9, weight = 4, range = 0.1, clearance = 0.01;
  Scene scene(Vec3(0, 0, -9.81));
  PlacedObstacle floor = solid("floor", HalfSpace{}, Vec3::Zero());
  floor.prefer = Preference::near;
  scene.add(floor);
  route::Options options = between(Frame::looking({0, 0, height}, {1, 0, 0}), Frame::looking({apart, 0, height}, {1, 0, 0}));
  options.space.preference = weight;
  options.space.preference_range = range;
  options.space.clearance = clearance;
  const route::Result result = route::run(scene, options);
  INFO(result.message);
  REQUIRE(result.ok);
  const route::Route& found = result.routes.front();

  // Scanned without any of the refinement: equilibria of rods of many lengths, the integral over their vertices.
  const double radius = options.section.radius();
  double best = INFINITY, best_length = 0;
  const auto try_length = [&](double length) {
    RodProblem problem;
    problem.gravity = scene.gravity();
    problem.rod = Rod::uniform(length, options.section, options.segments);
    problem.holds = {{0, options.from}, {length, options.to}};
    const Equilibrium rod = solve(problem);
    if (!rod.ok() || rod.smallest_bend_radius() < options.curve.radii.front()) return;
    double cost = length, lowest = INFINITY;
    for (std::size_t i = 0; i < rod.s.size(); ++i) {
      const double gap = rod.points[i].z() - radius, near = std::max(0.0, 1 - gap / range);
      const double share = 0.5 * (rod.s[std::min(i + 1, rod.s.size() - 1)] - rod.s[i > 0 ? i - 1 : 0]);
      cost += share * weight * (1 - near * near);
      lowest = std::min(lowest, gap);
    }
    if (lowest < clearance || cost >= best) return;
    best = cost;
    best_length = length;
  };
  const double step = 2.5e-4, fine = step / 100;
  for (double length = apart + step; length < 1.15 * apart; length += step) try_length(length);
  const double coarse = best_length;
  for (int k = -100; k <= 100; ++k) try_length(coarse + k * fine);
  INFO("scan: " << best << " at " << best_length << ", found " << found.objective << " at " << found.design.rod.length);
  REQUIRE(std::isfinite(best));
  CHECK(best_length > apart + 10 * step);
  CHECK(std::abs(found.design.rod.length - best_length) < 3 * fine);
  CHECK(found.objective == Approx(best).epsilon(1e-4));
}

TEST_CASE("refined route: held by clips round a pillar, and nothing nearby is better", "[route]") {
  const Scene scene = table();
  route::Options options = over_table();
  options.refinement.adjust = {true, false, false, true, true, true};
  options.max_clips = 8;
  const route::Result result = route::run(scene, options);
  INFO(result.message);
  REQUIRE(result.ok);
  const route::Route& found = result.routes.front();
  REQUIRE_FALSE(found.design.clips.empty());
  const RefinementOptions demands = demands_of(options);
  const RefinementResult here = as_it_stands(scene, found.design, demands);
  REQUIRE(here.ok);
  CHECK(here.objective == Approx(found.refined.objective).epsilon(1e-6));

  RefinementOptions wide = demands;
  wide.max_shift = 0.1;
  const DesignSpace space(found.design, wide);
  int compared = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const double size = std::pow(10.0, std::uniform_real_distribution<>(-4.5, -1)(random));
    Eigen::VectorXd x(space.size());
    for (int j = 0; j < space.size(); ++j) {
      const DesignSpace::Variable& v = space.variables()[j];
      x[j] = v.start + size * v.scale * std::uniform_real_distribution<>(-1, 1)(random);
      // Tilts are counted from the connection that was given.
      const auto known = std::find_if(found.refined.adjusted.begin(), found.refined.adjusted.end(),
                                      [&](const Adjusted& a) { return a.name == v.name; });
      REQUIRE(known != found.refined.adjusted.end());
      if (v.unit == "rad") x[j] = std::clamp(x[j], -wide.max_tilt - known->after, wide.max_tilt - known->after);
    }
    const Design design = space.design(x);
    const RefinementResult there = as_it_stands(scene, design, demands);
    if (!there.ok || !long_enough(design)) continue;
    ++compared;
    CHECK(there.objective >= found.refined.objective * (1 - 1e-5));
  }
  CHECK(compared >= 10);
}

TEST_CASE("refined route: more weight on clearance never gives less of it in equilibrium", "[route]") {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid("post", Cylinder{0.05, 2}, {0.5, 0.03, 0.3}));
  double last = 0, last_length = 0;
  for (const double weight : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    route::Options options = between(Frame::looking({0, 0, 0.3}, {1, 0, 0}), Frame::looking({1, 0, 0.3}, {1, 0, 0}));
    options.section = Section::round(0.020, 0.012, Material::from_poisson(60e6, 0.45, 1150));
    options.preformed = true;
    options.curve.end_straight = 0.03;
    options.weights = {{1, weight}};
    const route::Result result = route::run(scene, options);
    INFO("weight " << weight << ": " << result.message);
    REQUIRE(result.ok);
    const RefinementResult& refined = result.routes.front().refined;
    CHECK(refined.clearance.value >= 0.01);
    CHECK(refined.clearance.value >= last - 2e-4);
    CHECK(refined.design.rod.length >= last_length - 1e-4);
    last = refined.clearance.value;
    last_length = refined.design.rod.length;
  }
  CHECK(last > 0.02);
}

TEST_CASE("refined route: the same bits for one thread and two", "[route]") {
  const Scene scene = table();
  route::Options options = over_table();
  options.max_clips = 8;
  route::Result results[2];
  for (int k = 0; k < 2; ++k) {
    RunContext context;
    context.threads = k + 1;
    results[k] = route::run(scene, options, context);
  }
  REQUIRE(results[0].routes.size() == results[1].routes.size());
  REQUIRE_FALSE(results[0].routes.empty());
  CHECK(results[0].ok == results[1].ok);
  CHECK(results[0].message == results[1].message);
  const route::Route &a = results[0].routes.front(), &b = results[1].routes.front();
  CHECK(a.objective == b.objective);
  CHECK(a.design.rod.length == b.design.rod.length);
  REQUIRE(a.design.clips.size() == b.design.clips.size());
  for (std::size_t k = 0; k < a.design.clips.size(); ++k) {
    CHECK(a.design.clips[k].at == b.design.clips[k].at);
    CHECK(a.design.clips[k].frame.at == b.design.clips[k].frame.at);
  }
  REQUIRE(a.refined.equilibrium);
  CHECK(a.refined.equilibrium->rods.front().equilibrium.points == b.refined.equilibrium->rods.front().equilibrium.points);
}

TEST_CASE("refined route: turned about the vertical and moved, the same objective", "[route]") {
  route::Options options = over_table();
  options.max_clips = 8;
  const route::Result result = route::run(table(), options);
  const Frame place{{0.4, -0.2, 0.6}, Quat(Eigen::AngleAxisd(units::pi / 2, Vec3::UnitZ()))};
  route::Options turned = over_table(place);
  turned.max_clips = 8;
  const route::Result moved = route::run(table(place), turned);
  INFO(result.message << "; " << moved.message);
  REQUIRE(result.ok);
  REQUIRE(moved.ok);
  CHECK(moved.routes.front().objective == Approx(result.routes.front().objective).epsilon(1e-3));
  CHECK(moved.routes.front().design.clips.size() == result.routes.front().design.clips.size());
}

TEST_CASE("refined route: what cannot be kept is told", "[route]") {
  // No clips: the hose lies on the table.
  const route::Result bare = route::run(table(), over_table());
  CHECK_FALSE(bare.ok);
  CHECK(bare.status == Status::infeasible);
  CHECK_THAT(bare.message, Catch::StartsWith("no route keeps all that is demanded in equilibrium: "));
  CHECK_THAT(bare.message, Catch::Contains("10 mm required") || Catch::Contains("60 mm required"));
  REQUIRE(bare.routes.size() == 1);
  CHECK_FALSE(bare.routes.front().refined.unmet.empty());

  // Too few.
  route::Options options = over_table();
  options.max_clips = 1;
  const route::Result few = route::run(table(), options);
  CHECK_FALSE(few.ok);
  CHECK_THAT(few.message, Catch::Contains("clips would do, at most 1 may be added"));

  // Nothing that takes clips.
  options.max_clips = 8;
  const route::Result smooth = route::run(table({}, false), options);
  CHECK_FALSE(smooth.ok);
  CHECK_THAT(smooth.message, Catch::Contains("nothing to fasten a clip to is in reach of the route"));
}
