// Sampling and optimisation of preformed hoses: known optima, brute force, invariances, threads.
#include <catch2/catch.hpp>
#include <thread>

#include "base/units.h"
#include "method/preform/end_seeds.h"
#include "method/preform/pcc_optimization.h"
#include "unit/method/pcc_cases.h"

using namespace tendril;
using namespace tendril::preform;
using namespace tendril::routing;

namespace {

Options options_for(const Ends& ends, double radius, double straight = 0) {
  Options options;
  options.ends = ends;
  options.curve.radii = {radius};
  options.curve.min_straight = options.curve.end_straight = straight;
  options.same = 0.5 * radius;
  options.max_bends = 6;
  return options;
}

/// The best feasible result of the seeds from the ends and of paths, polished; nothing feasible: infinite.
Optimized best_of(const FreeSpace& space, const Options& options, const GlobalPaths& paths = {}, int threads = 1) {
  RunContext context;
  context.threads = threads;
  std::vector<Optimized> all = pcc_optimization(space, options, pcc_sampling(space, options, paths, context), context);
  polish(space, options, all, context);
  Optimized best;
  best.objective = best.length = std::numeric_limits<double>::infinity();
  for (const Optimized& one : all)
    if (one.violations.empty() && one.objective < best.objective) best = one;
  return best;
}

Ends random_ends(std::mt19937& random, double apart) {
  return {Vec3::Zero(), random_direction(random), apart * random_direction(random), random_direction(random)};
}

Ends moved(const Ends& ends, const Quat& turn, const Vec3& by, double scale) {
  return {scale * (turn * ends.start) + by, turn * ends.start_along, scale * (turn * ends.finish) + by, turn * ends.finish_along};
}

/// Around a ball or upright cylinder at the origin, in the plane z = 0, from tangent to tangent: the bend is as wide as the obstacle with
/// the hose's radius and clearance.
struct AroundCase {
  double obstacle = 0.06, reach = 0.02, turn = 1.8, before = 0.03, after = 0.05;
  double radius() const { return obstacle + reach; }
  double length() const { return before + radius() * turn + after; }
  Ends ends() const {
    const Vec3 in(1, 0, 0), out(std::cos(turn), std::sin(turn), 0);
    const Vec3 touch = radius() * Vec3(std::sin(turn), -std::cos(turn), 0);
    return {Vec3(0, -radius(), 0) - before * in, in, touch + after * out, out};
  }
  Scene scene(const Solid& solid) const {
    Scene scene;
    PlacedObstacle obstacle{"round", {}, 0};
    obstacle.body.shape = solid;
    scene.add(obstacle);
    return scene;
  }
  /// A path of small steps, farther out.
  GlobalPaths path() const {
    GlobalPaths paths;
    const Ends e = ends();
    std::vector<Vec3> path{e.start};
    for (int i = 0; i <= 20; ++i) {
      const double angle = -M_PI / 2 + turn * i / 20;
      path.push_back(1.2 * radius() * Vec3(std::cos(angle), std::sin(angle), 0));
    }
    path.push_back(e.finish);
    paths.paths.push_back(path);
    return paths;
  }
};

}  // namespace

TEST_CASE("preform: without obstacles, in a plane, the shortest of Dubins' words") {
  const double radius = 0.05;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const FreeSpace space = empty_space();
  for (int trial = 0; trial < 12; ++trial) {
    const double x = 10 * any(random), y = 10 * any(random), heading = M_PI * any(random);
    if (std::hypot(x, y) < 4.5) continue;
    double shortest = std::numeric_limits<double>::infinity();
    std::string word;
    for (const std::string name : {"LSL", "RSR", "LSR", "RSL", "LRL", "RLR"}) {
      DubinsPath path;
      if (!dubins(name, x, y, heading, path) || path.length() >= shortest) continue;
      shortest = path.length();
      word = name;
    }
    const Ends ends{Vec3::Zero(), Vec3::UnitX(), radius * Vec3(x, y, 0), Vec3(std::cos(heading), std::sin(heading), 0)};
    const Optimized best = best_of(space, options_for(ends, radius));
    INFO(word << " to " << x << " " << y << " heading " << heading);
    CHECK(best.length == Approx(radius * shortest).epsilon(1e-6));
  }
}

TEST_CASE("preform: without obstacles, in space, as short as the best of many random descents") {
  const double radius = 0.05;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(-1, 1);
  const FreeSpace space = empty_space();
  for (int trial = 0; trial < 6; ++trial) {
    const Ends ends = random_ends(random, radius * (trial % 2 ? 8 : 3));
    const double straight = trial % 3 ? 0.02 : 0;
    const Options options = options_for(ends, radius, straight);
    double brute = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 600; ++i) {
      const int bends = 2 + i % 4;
      PccPoints seed{{ends.start}, std::vector<double>(bends, radius)};
      for (int k = 1; k <= bends; ++k)
        seed.points.push_back(k / (bends + 1.0) * ends.finish + 0.25 * Vec3(any(random), any(random), any(random)));
      seed.points.push_back(ends.finish);
      const DescentResult result = descend(space, options.curve, ends, seed);
      if (result.length < brute && violations(space, options.curve, ends, result.curve, 1e-4).empty()) brute = result.length;
    }
    INFO("seed 17, trial " << trial << ", " << 100 * (ends.finish - ends.start).norm() << " cm apart");
    REQUIRE(std::isfinite(brute));
    CHECK(best_of(space, options).length <= brute * (1 + 2e-4));
  }
}

TEST_CASE("preform: tight around a cylinder and a ball, as by hand") {
  const AroundCase round;
  const Options options = options_for(round.ends(), round.radius());
  for (const Solid& solid : {Solid(Cylinder{round.obstacle, 2}), Solid(Sphere{round.obstacle})}) {
    const FreeSpace space(round.scene(solid), {0.5 * round.reach, 0.5 * round.reach, {}, {}, 0, 0.1}, {round.ends().start, round.ends().finish}, 0.2);
    const Optimized best = best_of(space, options, round.path());
    // The certificate lets 10 um pass, the samples' margin keeps off by a little.
    CHECK(best.length == Approx(round.length()).epsilon(2e-4));
    // Farther than the surface's distance everywhere, by samples of its own.
    for (const PccPiece& piece : pieces_of(best.points))
      for (double share = 0; share <= 1; share += 0.01) {
        const Vec3 p = piece.at(share);
        const double off = solid.index() == Solid(Sphere{1}).index() ? p.norm() : p.head<2>().norm();
        CHECK(off >= round.radius() - 1.1e-5);
      }
  }
}

TEST_CASE("preform: of several tools the one that fits closest around") {
  const AroundCase round;
  Options options = options_for(round.ends(), 0.5 * round.radius());
  options.curve.radii = {0.5 * round.radius(), 0.8 * round.radius(), round.radius(), 1.5 * round.radius()};
  options.max_bends = 1;
  const FreeSpace space(round.scene(Sphere{round.obstacle}), {0.5 * round.reach, 0.5 * round.reach, {}, {}, 0, 0.1},
                        {round.ends().start, round.ends().finish}, 0.2);
  const Optimized best = best_of(space, options);
  REQUIRE(best.points.bends() == 1);
  CHECK(best.points.radii[0] == round.radius());
  CHECK(best.length == Approx(round.length()).epsilon(1e-6));
}

TEST_CASE("preform: the same hose backwards, moved, turned and at another size") {
  const AroundCase round;
  const Ends ends = round.ends();
  const GlobalPaths paths = round.path();
  SpaceDemands demands{0.01, 0.01, {}, {}, 0, 0.1};
  const double radius = 0.05;
  const Options options = options_for(ends, radius, 0.01);
  const FreeSpace space(round.scene(Cylinder{round.obstacle, 1}), demands, {ends.start, ends.finish}, 0.2);
  const Optimized best = best_of(space, options, paths);
  REQUIRE(std::isfinite(best.length));

  GlobalPaths back = paths;
  std::reverse(back.paths[0].begin(), back.paths[0].end());
  const Ends reversed{ends.finish, -ends.finish_along, ends.start, -ends.start_along};
  CHECK(best_of(space, options_for(reversed, radius, 0.01), back).length == Approx(best.length).epsilon(1e-5));

  const Quat turn(Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()));
  const auto length_at = [&](double scale, double fewer_bends) {
    const Vec3 by(0.3, -2, 0.7);
    PlacedObstacle post{"round", {}, 0};
    post.body.shape = Cylinder{scale * round.obstacle, scale * 1};
    post.body.pose = Frame{by, turn};
    Scene scene;
    scene.add(post);
    const Ends there = moved(ends, turn, by, scale);
    GlobalPaths path = paths;
    for (Vec3& p : path.paths[0]) p = scale * (turn * p) + by;
    Options scaled = options_for(there, scale * radius, scale * 0.01);
    scaled.grid *= scale;
    scaled.fewer_bends = fewer_bends;
    const FreeSpace around(scene, {scale * 0.01, scale * 0.01, {}, {}, 0, 0.1 * scale}, {there.start, there.finish}, 0.2 * scale);
    return best_of(around, scaled, path).length;
  };
  for (const double scale : {1.0, 20.0}) CHECK(length_at(scale, options.fewer_bends) == Approx(scale * best.length).epsilon(1e-5));
  // The certificate lets 10 um pass at any size: around half a turn that is pi times as much, which in a small scene may decide
  // whether a bend is worth its length. So the optima are compared, whatever their bends.
  const double loss = units::pi * 1e-5;
  CHECK(length_at(0.1, 0) == Approx(0.1 * length_at(1, 0)).margin(loss).epsilon(0));
}

TEST_CASE("preform: the same bits for one and two threads, progress from the calling thread") {
  const AroundCase round;
  const Options options = options_for(round.ends(), 0.05, 0.01);
  const FreeSpace space(round.scene(Sphere{round.obstacle}), {0.01, 0.01, {}, {}, 0, 0.1}, {round.ends().start, round.ends().finish}, 0.2);
  std::vector<Optimized> results[2];
  for (int threads = 1; threads <= 2; ++threads) {
    RunContext context;
    context.threads = threads;
    double share = 0;
    const auto caller = std::this_thread::get_id();
    bool elsewhere = false;
    context.progress = [&](double now, const char*) {
      elsewhere = elsewhere || std::this_thread::get_id() != caller || now > 1;
      share = now;
    };
    const std::vector<Candidate> candidates = pcc_sampling(space, options, round.path(), context);
    results[threads - 1] = pcc_optimization(space, options, candidates, context);
    CHECK(results[threads - 1].size() == candidates.size());
    if (threads == 1) CHECK(share == 1);
    CHECK_FALSE(elsewhere);
    polish(space, options, results[threads - 1], context);
  }
  REQUIRE(results[0].size() == results[1].size());
  for (std::size_t i = 0; i < results[0].size(); ++i) {
    CHECK(results[0][i].length == results[1][i].length);
    CHECK(results[0][i].points.points == results[1][i].points.points);
  }
}

TEST_CASE("preform: sampling gives each number of bends once, on the ends' directions, without repetitions") {
  const AroundCase round;
  Options options = options_for(round.ends(), 0.04, 0.01);
  const FreeSpace space(round.scene(Sphere{round.obstacle}), {0.01, 0.01, {}, {}, 0, 0.1}, {round.ends().start, round.ends().finish}, 0.2);
  GlobalPaths paths = round.path();
  paths.paths.push_back(paths.paths[0]);
  const std::vector<Candidate> candidates = pcc_sampling(space, options, paths);
  int of_path[2] = {0, 0};
  for (const Candidate& c : candidates) {
    CHECK(c.points.points.front() == options.ends.start);
    CHECK(c.points.points.back() == options.ends.finish);
    CHECK(c.points.points.size() == c.points.radii.size() + 2);
    if (c.path < 0) continue;
    REQUIRE(c.path < 2);
    ++of_path[c.path];
    CHECK((c.points.points[1] - options.ends.start).cross(options.ends.start_along).norm() < 1e-12);
    CHECK((c.points.points[c.points.bends()] - options.ends.finish).cross(options.ends.finish_along).norm() < 1e-12);
  }
  CHECK(of_path[0] == options.max_bends - 1);
  CHECK(of_path[1] == 0);
  options.max_bends = 0;
  CHECK(pcc_sampling(space, options, paths).size() == 1);
}

TEST_CASE("preform: what cannot be is said, and a stop ends it early") {
  // A hose through a wall: from one side of a large slab to the other.
  Scene scene;
  PlacedObstacle slab{"slab", {}, 0};
  slab.body.shape = Box{Vec3(4, 4, 0.1)};
  scene.add(slab);
  const Ends ends{Vec3(0, 0, -0.3), Vec3::UnitX(), Vec3(0.4, 0, 0.3), Vec3::UnitX()};
  const Options options = options_for(ends, 0.05, 0.01);
  const FreeSpace space(scene, {0.01, 0.01, {}, {}, 0, 0.1}, {ends.start, ends.finish}, 0.2);
  const std::vector<Candidate> candidates = pcc_sampling(space, options, {});
  const std::vector<Optimized> all = pcc_optimization(space, options, candidates);
  REQUIRE(all.size() == candidates.size());
  for (const Optimized& one : all) {
    REQUIRE_FALSE(one.violations.empty());
    CHECK(one.points.points.size() >= 2);
  }
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  CHECK(pcc_optimization(space, options, candidates, context).empty());
}
