// Local refinement: the optimum against scans, both solvers, local optimality, invariances, and what it says when it cannot.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "statics/solve.h"
#include "unit/method/refinement_cases.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

Equilibrium settled(const Scene& scene, const Design& design) {
  Scene alone(scene.gravity());
  for (const PlacedObstacle& obstacle : scene.obstacles()) alone.add(obstacle);
  PlacedRod rod("rod", design.rod, design.from, design.to);
  for (const Hold& clip : design.clips) rod.hold(clip);
  alone.add(std::move(rod));
  const SceneEquilibrium eq = alone.solve();
  REQUIRE(eq.ok());
  return eq.rods[0].equilibrium;
}

Scene floor_at(double height, double clearance = 0.02) {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid("floor", HalfSpace{}, {0, 0, height}, clearance));
  return scene;
}

RefinementOptions bend_and(double clearance, double radius = 0.08) {
  RefinementOptions options;
  options.min_bend_radius = radius;
  options.clearance = clearance;
  return options;
}

/// Where a function of one number changes sign, between a and b.
template <class F>
double root(F f, double a, double b) {
  const bool rising = f(a) < 0;
  for (int i = 0; i < 60; ++i) (f(0.5 * (a + b)) < 0) == rising ? a = 0.5 * (a + b) : b = 0.5 * (a + b);
  return 0.5 * (a + b);
}

/// As far from what is demanded as the share of the worst miss; the cost of the length.
std::pair<double, double> miss_and_length(const Scene& scene, const Design& design, const RefinementOptions& options) {
  const Equilibrium eq = settled(scene, design);
  double miss = options.min_bend_radius / eq.smallest_bend_radius() - 1;
  for (const PlacedObstacle& obstacle : scene.obstacles()) {
    Surroundings one;
    one.add(obstacle.body);
    const auto distance = [&](const Vec3& p) { return one.closest(p, 10); };
    const Clearance gap = clearance_of(design.rod, eq, distance, 0, design.rod.length);
    miss = std::max(miss, (std::max(options.clearance, obstacle.clearance) - gap.value) / 0.02);
  }
  return {miss, design.rod.length};
}

}  // namespace

TEST_CASE("refinement: the shortest hanging hose that keeps its bend radius is that of a scan over lengths", "[refinement]") {
  const Scene scene = floor_at(0);
  const double shortest = root(
      [&](double length) { return settled(scene, u_design(length)).smallest_bend_radius() - 0.08; }, 0.35, 0.6);
  for (const RefinementSolver solver : {RefinementSolver::gradient, RefinementSolver::gradient_free})
    for (const double start : {0.38, 0.6, 1.2}) {
      RefinementOptions options = bend_and(0.02);
      options.solver = solver;
      const RefinementResult result = refine(scene, u_design(start), options);
      INFO(result.message << ", from " << start);
      CHECK(result.ok);
      CHECK(result.status == Status::solved);
      CHECK(result.message == "solved");
      CHECK(result.design.rod.length == Approx(shortest).epsilon(3e-5));
      CHECK(result.objective == result.design.rod.length);
      CHECK(result.min_bend_radius >= 0.08);
      CHECK(result.min_bend_radius == Approx(0.08).epsilon(1e-4));
      CHECK(result.equilibrium->ok());
      CHECK(result.equilibrium->stable());
      REQUIRE(result.adjusted.size() == 1);
      CHECK(result.adjusted[0].name == "length");
      CHECK(result.adjusted[0].before == std::max(start, 0.3));
      CHECK(result.adjusted[0].after == result.design.rod.length);
      CHECK(result.evaluations == static_cast<int>(result.history.size()));
      // The answer is an equilibrium by itself.
      const Equilibrium alone = settled(scene, result.design);
      CHECK(alone.smallest_bend_radius() == Approx(result.min_bend_radius).epsilon(1e-6));
      CHECK(result.settled_length == Approx(alone.settled_length()).epsilon(1e-8));
    }
}

TEST_CASE("refinement: a hose that sags to a floor to keep near is as long as a scan says", "[refinement]") {
  Scene scene(Vec3(0, 0, -9.81));
  PlacedObstacle floor = solid("floor", HalfSpace{}, Vec3::Zero(), 0.02);
  floor.prefer = Preference::near;
  scene.add(floor);
  RefinementOptions options = bend_and(0, 0.05);
  options.preference_weight = 5;
  options.range = 0.35;
  const auto cost = [&](double length) {
    const Equilibrium eq = settled(scene, u_design(length));
    double sum = length;
    for (std::size_t i = 0; i < eq.s.size(); ++i) {
      const double share = 0.5 * (eq.s[std::min(i + 1, eq.s.size() - 1)] - eq.s[i > 0 ? i - 1 : 0]);
      const double x = std::max(0.0, 1 - (eq.points[i].z() - 0.01) / 0.35);
      sum += 5 * share * (1 - x * x);
    }
    return sum;
  };
  double best = INFINITY, at = 0;
  for (double length = 0.4; length < 0.86; length += 0.002)
    if (settled(scene, u_design(length)).smallest_bend_radius() >= 0.05 && cost(length) < best) best = cost(at = length);
  RefinementOptions near_best = options;
  const RefinementResult result = refine(scene, u_design(at + 0.05), near_best);
  INFO(result.message << "; scan: " << best << " at " << at);
  CHECK(result.ok);
  CHECK(result.objective <= best * (1 + 1e-6));
  CHECK(result.objective == Approx(cost(result.design.rod.length)).epsilon(1e-6));
}

TEST_CASE("refinement: nothing nearby is better, and both solvers agree", "[refinement]") {
  const Scene scene = floor_at(0.1);
  RefinementOptions options = bend_and(0.02, 0.09);
  options.adjust.from_tilt = options.adjust.to_tilt = true;
  options.max_tilt = 0.15;
  options.tolerance = 1e-8;
  const RefinementResult fast = refine(scene, u_design(0.7), options);
  options.solver = RefinementSolver::gradient_free;
  options.max_evaluations = 3000;
  const RefinementResult slow = refine(scene, u_design(0.7), options);
  INFO(fast.message << "; " << slow.message);
  REQUIRE(fast.ok);
  REQUIRE(slow.ok);
  CHECK(fast.objective <= slow.objective * (1 + 1e-5));
  CHECK(fast.evaluations * 3 < slow.evaluations);

  // Every design close by misses something or is longer.
  const auto tilted = [](const Frame& frame, double a, double b) {
    return Frame{frame.at, exp_rotation(a * frame.d1() + b * frame.d2()) * frame.rotation};
  };
  const Design first = u_design(0.7);
  std::vector<double> x;
  for (const Adjusted& a : fast.adjusted) x.push_back(a.after);
  REQUIRE(x.size() == 5);
  int looked_at = 0;
  for (std::size_t j = 0; j < x.size(); ++j)
    for (const double change : {-0.01, 0.01}) {
      std::vector<double> y = x;
      y[j] += change;
      if (j > 0 && std::abs(y[j]) > 0.15) continue;
      Design other = u_design(y[0]);
      other.from = tilted(first.from, y[1], y[2]);
      other.to = tilted(first.to, y[3], y[4]);
      const auto [miss, length] = miss_and_length(scene, other, options);
      INFO(fast.adjusted[j].name << " by " << change << ": misses " << miss << ", length " << length);
      CHECK((miss > 0 || length >= fast.objective * (1 - 1e-6)));
      ++looked_at;
    }
  CHECK(looked_at >= 5);
}

TEST_CASE("refinement: clearance and bend radius that cannot both be kept are told, with place and amount", "[refinement]") {
  const Scene scene = floor_at(0.25);
  const RefinementResult result = refine(scene, u_design(0.5), bend_and(0.03, 0.12));
  CHECK_FALSE(result.ok);
  CHECK(result.status == Status::infeasible);
  REQUIRE_FALSE(result.unmet.empty());
  const std::string text = result.message;
  INFO(text);
  bool bend = false, gap = false;
  for (const Unmet& u : result.unmet) {
    bend = bend || u.what == Unmet::What::bend_radius;
    gap = gap || u.what == Unmet::What::clearance;
    CHECK(u.value < u.demanded);
    CHECK(text.find(u.text) != std::string::npos);
  }
  CHECK((bend || gap));
  // As good a compromise as any length gives.
  double least = INFINITY;
  for (double length = 0.36; length < 0.8; length += 0.002)
    least = std::min(least, miss_and_length(scene, u_design(length), bend_and(0.03, 0.12)).first);
  CHECK(least > 0.05);
}

TEST_CASE("refinement: ends that are too near say that the connection is to blame", "[refinement]") {
  Scene scene = floor_at(0);
  scene.add(solid("wall", Box{{0.02, 1, 0.2}}, {-0.035, 0, 0.45}, 0.02));
  const RefinementResult blocked = refine(scene, u_design(0.5), bend_and(0.02));
  CHECK(blocked.status == Status::infeasible);
  CHECK_THAT(blocked.message, Catch::Contains("'wall'") && Catch::Contains("20 mm required") && Catch::Contains("free_ends"));
  RefinementOptions options = bend_and(0.02);
  options.free_ends = 0.2;
  CHECK(refine(scene, u_design(0.5), options).ok);
}

TEST_CASE("refinement: turned about the vertical and moved, everything turns and moves with it", "[refinement]") {
  const Vec3 by(0.3, -0.2, 0.15);
  const Quat turn(Eigen::AngleAxisd(0.8, Vec3::UnitZ()));
  const auto moved = [&](const Frame& f) { return Frame{by + turn * f.at, turn * f.rotation}; };
  RefinementOptions options = bend_and(0.02, 0.09);
  options.clearance_weight = 0.5;
  options.range = 0.3;
  options.adjust.to_tilt = true;
  const Scene scene = hall();
  Scene other(Vec3(0, 0, -9.81));
  for (PlacedObstacle obstacle : scene.obstacles()) {
    obstacle.body.pose = moved(obstacle.body.pose);
    other.add(obstacle);
  }
  const Design design = u_design(0.6);
  Design there = design;
  there.from = moved(design.from);
  there.to = moved(design.to);
  const RefinementResult a = refine(scene, design, options), b = refine(other, there, options);
  INFO(a.message << "; " << b.message);
  REQUIRE(a.ok);
  REQUIRE(b.ok);
  CHECK(b.objective == Approx(a.objective).epsilon(1e-6));
  for (std::size_t j = 0; j < a.adjusted.size(); ++j) CHECK(b.adjusted[j].after == Approx(a.adjusted[j].after).margin(2e-4));
}

TEST_CASE("refinement: the same bits for any number of threads and every time", "[refinement]") {
  RefinementOptions options = everything();
  options.min_bend_radius = 0.06;
  options.clearance_weight = 0.3;
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  const RefinementResult a = refine(hall(), u_design(0.7), options, one), b = refine(hall(), u_design(0.7), options, two);
  CHECK(a.objective == b.objective);
  REQUIRE(a.history.size() == b.history.size());
  for (std::size_t k = 0; k < a.history.size(); ++k) CHECK(a.history[k].objective == b.history[k].objective);
  const auto &p = a.equilibrium->rods[0].equilibrium.points, &q = b.equilibrium->rods[0].equilibrium.points;
  CHECK(p == q);
}

TEST_CASE("refinement: the route decides on which side of an obstacle the hose runs, a mesh as much as a solid", "[refinement]") {
  // A thin upright wall, open, halfway: over it, or to either side.
  const double w = 0.12, h = 0.5;
  PlacedObstacle wall;
  wall.name = "wall";
  wall.clearance = 0.015;
  wall.body.shape = std::make_shared<const TriangleSurface>(
      Mesh{"wall", {{0.4, -w, 0}, {0.4, w, 0}, {0.4, w, h}, {0.4, -w, h}}, {{0, 1, 2}, {0, 2, 3}}});
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(wall);
  std::vector<double> lengths;
  for (const double side : {-1.0, 1.0}) {
    Design design;
    design.rod = Rod::uniform(1.1, soft_hose(), 50);
    design.from = Frame::looking({0, 0, 0.4}, {1, 0.9 * side, 0}, {0, 0, 1});
    design.to = Frame::looking({0.8, 0, 0.4}, {1, -0.9 * side, 0}, {0, 0, 1});
    design.route = Curve::spline({design.from.at, {0.2, 0.15 * side, 0.4}, {0.4, 0.2 * side, 0.4}, {0.6, 0.15 * side, 0.4}, design.to.at},
                                 {design.from.d3(), design.to.d3()});
    const RefinementResult result = refine(scene, design, bend_and(0, 0.05));
    INFO(result.message << ", length " << result.design.rod.length);
    REQUIRE(result.ok);
    const Frame middle = result.equilibrium->rods[0].equilibrium.frame_at(0.5 * result.design.rod.length);
    CHECK(middle.at.y() * side > w + 0.01 + 0.015 - 1e-3);
    CHECK(result.clearance.value == Approx(0.015).margin(3e-5));
    CHECK(result.clearance.value >= 0.015);
    CHECK(result.clearance_to == "wall");
    // Not shorter than a string around the wall's edge, and not much longer.
    const double string = 2 * std::hypot(0.4, w + 0.025);
    CHECK(result.design.rod.length > string - 0.01);
    CHECK(result.design.rod.length < 1.1 * string);
    lengths.push_back(result.design.rod.length);
  }
  CHECK(lengths[0] == Approx(lengths[1]).epsilon(1e-5));
}

TEST_CASE("refinement: a preformed hose gets its length at the finish", "[refinement]") {
  Design design = preformed_design();
  const double before = design.rod.length;
  RefinementOptions options = bend_and(0.0, 0.06);
  options.max_tension = 1;
  const Scene scene = floor_at(0, 0);
  const RefinementResult result = refine(scene, design, options);
  INFO(result.message);
  REQUIRE(result.ok);
  const Curve* shape = curve_of(result.design.rod);
  REQUIRE(shape);
  CHECK(shape->length() == Approx(result.design.rod.length).epsilon(1e-12));
  CHECK((shape->at(0.3).at - curve_of(design.rod)->at(0.3).at).norm() < 1e-12);
  CHECK(result.design.rod.length < before);  // a shorter one does, and is held as well
  CHECK(result.equilibrium->rods[0].equilibrium.largest_tension() <= 1);
}

TEST_CASE("refinement: clips slide to where the hose may be short and clear", "[refinement]") {
  Scene scene = floor_at(0);
  RefinementOptions options = bend_and(0.02, 0.05);
  options.adjust.clips = true;
  const Design design = clipped_design();
  const RefinementResult fixed = refine(scene, design, bend_and(0.02, 0.05));
  const RefinementResult result = refine(scene, design, options);
  INFO(fixed.message << "; " << result.message);
  REQUIRE(result.ok);
  CHECK(result.objective <= fixed.objective + 1e-6);
  // No stretch is shorter than the straight way.
  std::vector<std::pair<double, Vec3>> holds = {{0, design.from.at}};
  for (const Hold& clip : result.design.clips) holds.push_back({clip.at, clip.frame.at});
  holds.push_back({result.design.rod.length, design.to.at});
  for (std::size_t k = 1; k < holds.size(); ++k)
    CHECK(holds[k].first - holds[k - 1].first >= (holds[k].second - holds[k - 1].second).norm() * (1 - 1e-5));
}

TEST_CASE("refinement: a clip is added where the hose hangs too low and something to fasten to is in reach", "[refinement]") {
  // A floor to keep clear of, a shelf beside that takes clips.
  Scene scene = floor_at(0, 0.06);
  scene.add(solid("shelf", Box{{1.2, 0.1, 0.01}}, {0.5, 0.08, 0.1}));
  Design design;
  design.rod = Rod::uniform(1.15, soft_hose(), 60);
  design.from = Frame::looking({0, 0, 0.2}, {1, 0, 0});
  design.to = Frame::looking({1, 0, 0.2}, {1, 0, 0});
  RefinementOptions options = bend_and(0, 0.05);
  options.min_length = 1.12;
  const RefinementResult without = refine(scene, design, options);
  CHECK(without.status == Status::infeasible);
  CHECK_THAT(without.message, Catch::Contains("'floor'"));
  options.most_clips = 2;
  options.clip_reach = 0.3;
  const RefinementResult with = refine(scene, design, options);
  INFO(without.message << "; " << with.message);
  CHECK(with.ok);
  REQUIRE_FALSE(with.added_clips.empty());
  CHECK(with.design.clips.size() == with.added_clips.size());
  for (const Hold& clip : with.added_clips) CHECK((clip.at > 0.05 && clip.at < 1.1));
  CHECK(with.history.size() > without.history.size());

  // Nothing in reach, and nothing that takes clips.
  Scene far_away = floor_at(0, 0.06);
  far_away.add(solid("shelf", Box{{1.2, 0.1, 0.01}}, {0.5, 0.9, 0.1}));
  options.clip_reach = 0.03;
  const RefinementResult far = refine(far_away, design, options);
  CHECK(far.status == Status::infeasible);
  CHECK(far.added_clips.empty());
  CHECK_THAT(far.message, Catch::Contains("no place for another clip within reach"));
  options.clip_reach = 0.3;
  Scene smooth(Vec3(0, 0, -9.81));
  for (PlacedObstacle obstacle : scene.obstacles()) {
    obstacle.clip = false;
    smooth.add(obstacle);
  }
  CHECK(refine(smooth, design, options).added_clips.empty());
}

TEST_CASE("refinement: ends early with the best so far", "[refinement]") {
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const RefinementResult cancelled = refine(hall(), u_design(0.7), bend_and(0.02), context);
  CHECK(cancelled.status == Status::cancelled);
  CHECK_FALSE(cancelled.ok);
  RunContext late;
  late.deadline = RunContext::Clock::now();
  CHECK(refine(hall(), u_design(0.7), bend_and(0.02), late).status == Status::timeout);
}

TEST_CASE("refinement: options that make no sense", "[refinement]") {
  const auto message = [](auto change) {
    RefinementOptions options;
    Design design = u_design(0.6);
    change(design, options);
    try {
      refine(hall(), design, options);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using O = RefinementOptions;
  const auto option = [&](auto set) { return message([&](Design&, O& o) { set(o); }); };
  CHECK(option([](O& o) { o.min_bend_radius = -1; }) == "refine: 'min_bend_radius' is -1, expected a number of at least 0");
  CHECK(option([](O& o) { o.clearance = NAN; }) == "refine: 'clearance' is nan, expected a number of at least 0");
  CHECK(option([](O& o) { o.range = 0; }) == "refine: 'range' is 0, expected a number above 0");
  CHECK(option([](O& o) { o.length_weight = 0; }) == "refine: all weights are 0; one above 0 expected");
  CHECK(option([](O& o) { o.max_turn = 3.2; }) == "refine: 'max_turn' is 3.2 rad, expected less than half a turn");
  CHECK(option([](O& o) { o.max_tilt = 2; }) == "refine: 'max_tilt' is 2 rad, expected less than a right angle");
  CHECK(option([](O& o) { o.most_clips = -1; }) == "refine: 'max_evaluations' and 'most_clips' must not be negative");
  CHECK(option([](O& o) { o.min_length = 1; o.max_length = 0.5; }) == "refine: 'min_length' is 1 m, above 'max_length' of 0.5 m");
  CHECK(option([](O& o) { o.max_length = 0.2; }) ==
        "refine: no length is possible: at most 0.2 m are asked for, at least 0.3 m are needed from hold to hold");
  CHECK(option([](O& o) { o.solve.element = Element::staggered; }) ==
        "refine: the rod must be one of se3 elements: staggered ones have no sensitivities");
  CHECK(message([](Design& d, O&) { d.clips = {Hold{0.7, d.from}}; }) ==
        "refine: a clip at 0.7 m is not inside the rod, which is 0.6 m long");
  CHECK(message([](Design& d, O&) { d.clips = {Hold{0.3, d.from, false}}; }) == "refine: a clip must hold the position of its section");
  CHECK(message([](Design& d, O&) { d.turns = INFINITY; }) == "refine: 'turns' is not a finite number");
}
