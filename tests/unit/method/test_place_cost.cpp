// What a metre costs: by fields, interpolated, and integrated along curves, against exact distances and integrals by hand.
#include <catch2/catch.hpp>

#include <cmath>
#include <thread>

#include "method/free_space/free_space.h"
#include "method/pcc/cost_integral.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using tendril::test::triangle_soup;
using tendril::testing::obstacle_of;
using tendril::testing::Random;
using tendril::testing::solid_of;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::AlignedBox3d cube(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

SpaceDemands weighted(double clearance_weight, double preference, double range = 0.1) {
  SpaceDemands demands;
  demands.radius = 0.012;
  demands.clearance = 0.008;
  demands.clearance_weight = clearance_weight;
  demands.preference = preference;
  demands.preference_range = range;
  return demands;
}

/// A soup of more triangles than are asked without a field, to keep away from, and a block to keep near.
Scene soup_and_block(Random& random, Preference soup = Preference::avoid) {
  Scene scene;
  PlacedObstacle first = obstacle_of("soup", triangle_soup(1500, 0.1, random).moved(Vec3::Zero(), Quat::Identity(), 0.25));
  first.prefer = soup;
  scene.add(first);
  PlacedObstacle second = solid_of("block", Box{{0.1, 0.1, 0.1}}, {0.3, 0, 0});
  second.prefer = Preference::near;
  scene.add(second);
  return scene;
}

double f(double gap, double range) {
  const double x = std::max(0.0, 1 - gap / range);
  return x * x;
}

}  // namespace

TEST_CASE("costs by fields lie between those of distances that are off by what the field may be off", "[place_cost]") {
  Random random(7);
  const Scene scene = soup_and_block(random);
  const SpaceDemands demands = weighted(2, 0);
  const double spacing = 0.01, off = 1.7322 * spacing + 1e-5, range = demands.preference_range;
  const PlaceCost cost(scene, demands, cube(0.9), cube(0.9), spacing);
  const Surroundings& all = *scene.surroundings();
  double farthest = 0, largest = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = random.point(0.6);
    const double gap = all.closest_on(0, p, infinity).distance - demands.radius, value = cost.by_field(p);
    CAPTURE(i, p.transpose(), gap);
    REQUIRE(value <= 1 + 2 * f(gap - off, range) + 1e-9);
    REQUIRE(value >= 1 + 2 * f(gap + off, range) - 1e-9);
    farthest = std::max(farthest, std::abs(value - cost.exact(p)));
    largest = std::max(largest, value);
  }
  CHECK(farthest > 0.01);
  CHECK(largest > 2);
  // Outside its box exact.
  const Vec3 outside(1.5, 0, 0);
  CHECK(cost.by_field(outside) == cost.exact(outside));
}

TEST_CASE("single obstacles to keep near or away from have fields of their own", "[place_cost]") {
  Random random(11);
  const Scene scene = soup_and_block(random);
  const SpaceDemands demands = weighted(0, 1.5);
  const PlaceCost cost(scene, demands, cube(0.9), cube(0.9), 0.005);
  const Surroundings& all = *scene.surroundings();
  const double off = 1.7322 * 0.01 + 1e-5, range = demands.preference_range;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random.point(0.6);
    const double soup = all.closest_on(0, p, infinity).distance - demands.radius, block = all.closest_on(1, p, infinity).distance - demands.radius;
    const double near = 1 + 1.5 * std::max(0.0, 1 - f(block, range));
    REQUIRE(cost.exact(p) == Approx(near + 1.5 * f(soup, range)).epsilon(1e-9));
    REQUIRE(cost.by_field(p) <= near + 1.5 * f(soup - off, range) + 1e-9);
    REQUIRE(cost.by_field(p) >= near + 1.5 * f(soup + off, range) - 1e-9);
  }
}

TEST_CASE("what the field knows does not change exact costs", "[place_cost]") {
  Random random(13);
  const Scene scene = soup_and_block(random, Preference::neutral);
  const SpaceDemands demands = weighted(1, 0);
  RunContext stopped;
  const std::atomic<bool> yes = true;
  stopped.cancel = &yes;
  const PlaceCost without(scene, demands, cube(0.9), cube(0.9), 0.01, stopped), with(scene, demands, cube(0.9), cube(0.9), 0.01);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = random.point(1.0);
    Vec3 a, b;
    REQUIRE(with.exact(p, &a) == without.exact(p, &b));
    REQUIRE(a == b);
    REQUIRE(without.by_field(p) == without.exact(p));
  }
}

TEST_CASE("interpolated costs: their gradients are their own, kinks and cells' borders included", "[place_cost]") {
  for (const bool fine : {false, true}) {
    Random random(3);
    const Scene scene = soup_and_block(random);
    const FreeSpace space(scene, weighted(2, 1), {Vec3(0, 0, 0)}, 0.1);
    const double h = 1e-6;
    int sloping = 0;
    for (int i = 0; i < 3000; ++i) {
      Vec3 p = random.point(0.45);
      if (i % 3 == 0) p = 0.005 * (p / 0.005).array().round().matrix();
      Vec3 gradient, expected, nothing;
      const double value = space.cost_interpolated(p, &gradient, fine);
      REQUIRE(value >= 1);
      REQUIRE(space.cost_interpolated(p, nullptr, fine) == value);
      for (int k = 0; k < 3; ++k)
        expected[k] = (space.cost_interpolated(p + h * Vec3::Unit(k), nullptr, fine) - space.cost_interpolated(p - h * Vec3::Unit(k), nullptr, fine)) / (2 * h);
      CAPTURE(i, p.transpose(), gradient.transpose(), expected.transpose());
      // Second derivatives are below the largest slope (some 100 / m) over half a cell.
      REQUIRE((gradient - expected).norm() < 1e-4 * (1 + expected.norm()) + h * 1e5);
      sloping += expected.norm() > 0.5;
    }
    CHECK(sloping > 800);
  }
}

TEST_CASE("interpolated costs are near the exact ones, the finer ones nearer", "[place_cost]") {
  // Beside a wall: linear or quadratic in one coordinate, known to be off by h^2 / 8 of the second derivative.
  Scene wall;
  wall.add(solid_of("wall", Box{{0.8, 0.8, 0.2}}, {0, 0, -0.1}));
  const SpaceDemands demands = weighted(1, 0);
  const FreeSpace beside(wall, demands, {Vec3(0, 0, 0.1)}, 0.2);
  for (const double z : {0.02, 0.031, 0.05, 0.077}) {
    const double exact = 1 + f(z - demands.radius, 0.1), second = 2 / (0.1 * 0.1);
    CHECK(beside.cost({0.1, 0, z}) == Approx(exact).epsilon(1e-12));
    CHECK(beside.cost_interpolated({0.1, 0, z}) == Approx(exact + 0.01 * 0.01 / 8 * second).epsilon(1e-6));
    CHECK(beside.cost_interpolated({0.1, 0, z}, nullptr, true) == Approx(exact + 0.004 * 0.004 / 8 * second).epsilon(1e-6));
  }
  // Anywhere, with kinks.
  Random random(5);
  const Scene scene = soup_and_block(random);
  const FreeSpace space(scene, weighted(1, 0), {Vec3(0, 0, 0)}, 0.1);
  double coarse = 0, fine = 0;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    Vec3 p = random.point(0.4);
    if (!space.is_free(p)) continue;
    const double exact = space.cost(p);
    coarse += std::abs(space.cost_interpolated(p) - exact) / count;
    fine += std::abs(space.cost_interpolated(p, nullptr, true) - exact) / count;
  }
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.01);
  CHECK(fine < 0.5 * coarse);
}

TEST_CASE("interpolated costs are the same for any threads and in any order", "[place_cost]") {
  Random random(19);
  const Scene scene = soup_and_block(random);
  const SpaceDemands demands = weighted(1, 0.5);
  const FreeSpace one(scene, demands, {Vec3(0, 0, 0)}, 0.1), many(scene, demands, {Vec3(0, 0, 0)}, 0.1);
  std::vector<Vec3> places;
  for (int i = 0; i < 2000; ++i) places.push_back(random.point(0.4));
  std::vector<std::thread> threads;
  std::vector<std::vector<double>> found(4, std::vector<double>(places.size()));
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t at = t % 2 ? i : places.size() - 1 - i;
        found[t][at] = many.cost_interpolated(places[at]);
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int t = 0; t < 4; ++t) REQUIRE(found[t][i] == one.cost_interpolated(places[i]));
}

TEST_CASE("interpolated costs far away, for short ranges and in large scenes are exact or nearly", "[place_cost]") {
  Scene scene;
  scene.add(solid_of("ball", Sphere{0.1}, {0, 0, 0}));
  const FreeSpace space(scene, weighted(1, 0), {Vec3(0, 0, 0)}, 0.1);
  for (const Vec3& far : {Vec3(5, 0, 0), Vec3(0, -1e6, 0), Vec3(0.3, 0.3, 0.3), Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)}) {
    Vec3 gradient(1, 1, 1);
    CHECK(space.cost_interpolated(far, &gradient) == 1);
    CHECK(gradient.norm() < 1e-12);
  }
  const FreeSpace narrow(scene, weighted(1, 0, 1e-3), {Vec3(0, 0, 0)}, 0.1);
  CHECK(narrow.cost_interpolated({0.1125, 0, 0}) == Approx(narrow.cost({0.1125, 0, 0})).epsilon(0.01));
  const FreeSpace wide(scene, weighted(1, 0), {Vec3(-500, 0, 0), Vec3(500, 300, 200)}, 0.1);
  CHECK(wide.cost_interpolated({0.15, 0, 0}) == wide.cost({0.15, 0, 0}));
}

TEST_CASE("cost of a curve: integrals by hand", "[cost_integral]") {
  const SpaceDemands demands = weighted(3, 0);
  const double range = demands.preference_range;
  Scene scene;
  scene.add(solid_of("wall", Box{{4, 4, 0.2}}, {0, 0, -0.1}));
  const FreeSpace space(scene, demands, {Vec3(0, 0, 0.1)}, 0.2);
  // Along the wall, and with a bend beside it.
  const PccPoints along{{Vec3(-0.5, 0, 0.04), Vec3(0.5, 0, 0.04)}, {}};
  CHECK(cost_integral(space, along) == Approx(1 + 3 * f(0.028, range)).epsilon(1e-12));
  const PccPoints bent{{Vec3(-0.5, 0, 0.04), Vec3(0, 0, 0.04), Vec3(0, 0.5, 0.04)}, {0.05}};
  CHECK(cost_integral(space, bent) == Approx(bent.length() * (1 + 3 * f(0.028, range))).epsilon(1e-12));
  // Straight away from it, through the end of the range: integral of (1 - g / r)^2 from g0 on is r (1 - g0 / r)^3 / 3.
  const PccPoints away{{Vec3(0, 0, 0.032), Vec3(0, 0, 0.9)}, {}};
  CHECK(cost_integral(space, away) == Approx(0.868 + 3 * range * std::pow(0.8, 3) / 3).epsilon(1e-6));
  // A hundred ranges of nothing, and one of something in between.
  Scene ball;
  ball.add(solid_of("ball", Sphere{0.01}, {0, 0, 0}));
  const FreeSpace around(ball, weighted(1, 0, 0.01), {Vec3(-1, 0, 0), Vec3(1, 0, 0)}, 0.1);
  const double off = 0.025;
  double by_hand = 0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) by_hand += f(std::hypot(2.0 * (i + 0.5) / count - 1, off) - 0.022, 0.01) * 2 / count;
  const PccPoints past{{Vec3(-1, off, 0), Vec3(1, off, 0)}, {}};
  CHECK(cost_integral(around, past) - 2 == Approx(by_hand).epsilon(1e-3));
  CHECK(cost_integral(FreeSpace(Scene(), weighted(1, 1), {Vec3(0, 0, 0)}, 0.1), past) == 2.0);
}

TEST_CASE("cost of a curve: random curves among triangles against many samples", "[cost_integral]") {
  Random random(23);
  const Scene scene = soup_and_block(random);
  const FreeSpace space(scene, weighted(1, 2), {Vec3(0, 0, 0)}, 0.1);
  for (int trial = 0; trial < 20; ++trial) {
    const PccPoints curve = testing::random_pcc(random, 3, 0.05);
    double sum = 0;
    for (const PccPiece& piece : pieces_of(curve)) {
      const int count = 4000;
      for (int i = 0; i < count; ++i) sum += space.cost(piece.at((i + 0.5) / count)) * piece.length / count;
    }
    CAPTURE(trial);
    CHECK(cost_integral(space, curve) == Approx(sum).epsilon(1e-4));
  }
}
