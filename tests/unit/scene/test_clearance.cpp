#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "statics/solve.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;

namespace {

/// Brute force: the gap at many places of the rod.
double scanned(const SceneEquilibrium& eq, const SolvedRod& rod, int to, int count) {
  double least = std::numeric_limits<double>::infinity();
  const Rod& design = rod.problem.rod;
  for (int i = 0; i <= count; ++i) {
    const double s = design.length * i / count;
    const ClosestPoint closest = eq.closest(rod.equilibrium.frame_at(s).at, to);
    least = std::min(least, closest.distance - design.section_at(s).radius());
  }
  return least;
}

SceneEquilibrium with_obstacles(const PlacedRod& rod, std::initializer_list<PlacedObstacle> obstacles) {
  Scene scene(earth);
  scene.add(PlacedRod(rod));
  SceneEquilibrium eq = scene.solve();  // free of obstacles: measured against them afterwards
  Scene measured;
  for (const PlacedObstacle& obstacle : obstacles) measured.add(obstacle);
  eq.obstacles = measured.obstacles();
  eq.surroundings = measured.surroundings();
  return eq;
}

}  // namespace

TEST_CASE("the clearance to a plane is that of the lowest point, between vertices too", "[scene][clearance]") {
  for (const int segments : {3, 5, 40}) {
    CAPTURE(segments);
    const SceneEquilibrium eq = with_obstacles(sagging_hose("hose", segments), {solid("floor", HalfSpace{}, {0, 0, 0})});
    const SolvedRod& hose = eq.rods.front();
    const Clearance gap = eq.clearance(hose);
    CHECK(gap.value <= scanned(eq, hose, 0, 100000) + 1e-12);
    CHECK(gap.value == Approx(scanned(eq, hose, 0, 100000)).margin(1e-9));
    CHECK(gap.s == Approx(0.6).margin(1e-6));  // it is symmetric
    CHECK(gap.obstacle == 0);
    CHECK(gap.on.z() == Approx(0).margin(1e-12));
    CHECK(gap.at.z() - 0.01 == Approx(gap.value));
  }
}

TEST_CASE("the clearance goes on through penetration with its sign", "[scene][clearance]") {
  double last = std::numeric_limits<double>::infinity();
  for (const double height : {0.5, 0.6, 0.65, 0.7, 0.75}) {
    const SceneEquilibrium eq = with_obstacles(sagging_hose(), {solid("floor", HalfSpace{}, {0, 0, height})});
    const double gap = eq.clearance(eq.rods.front()).value;
    if (std::isfinite(last)) CHECK(last - gap == Approx(height == 0.6 ? 0.1 : 0.05).margin(1e-9));
    last = gap;
  }
  CHECK(last < -0.01);
}

TEST_CASE("clearances to small and sharp things agree with a brute-force scan", "[scene][clearance]") {
  std::uint32_t state = 12345;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return state / 4294967296.0;
  };
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const Vec3 at(random() * 0.8, 0.2 * random() - 0.1, 0.5 + 0.5 * random());
    const SceneEquilibrium eq = with_obstacles(
        sagging_hose("hose", 12), {solid("ball", Sphere{0.001 + 0.05 * random()}, at),
                                   solid("post", Cylinder{0.005, 0.3}, at + Vec3(0.1, 0.05, 0)), sheet("sheet", at, 0.03)});
    for (const int to : {-1, 0, 1, 2}) {
      const Clearance gap = eq.clearance(eq.rods.front(), to);
      const double scan = scanned(eq, eq.rods.front(), to, 30000);
      CHECK(gap.value <= scan + 1e-10);
      CHECK(gap.value > scan - 2e-5);  // the scan itself is no finer
    }
  }
}

TEST_CASE("each part of a rod counts with its own radius", "[scene][clearance]") {
  Rod rod = Rod::uniform(1, soft_section());
  Section thick = soft_section();
  thick.outer = 0.06;
  rod.parts = {{0.4, rod.parts[0].section}, {0.6, thick}, {1.0, rod.parts[0].section}};
  Scene scene;
  scene.add(PlacedRod("rod", rod, Frame::looking({0, 0, 1}, {1, 0, 0}), Frame::looking({1, 0, 1}, {1, 0, 0})));
  scene.add(solid("floor", HalfSpace{}, {0, 0, 0}));
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& solved = eq.rods.front();
  CHECK(eq.clearance(solved).value == Approx(1 - 0.03));
  CHECK(eq.clearance(solved).s >= 0.4);
  CHECK(eq.clearance(solved).s <= 0.6);
  CHECK(eq.clearance(solved, 0, 0, 0.3).value == Approx(1 - 0.01));
}

TEST_CASE("without obstacles the clearance is infinite and names none", "[scene][clearance]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  const SceneEquilibrium eq = scene.solve();
  const Clearance gap = eq.clearance(eq.rods.front());
  CHECK(std::isinf(gap.value));
  CHECK(gap.obstacle == -1);
}

TEST_CASE("touching is allowed where no clearance is required", "[scene][clearance]") {
  CHECK_FALSE(too_close(-1e-5, 0, 0.01));
  CHECK(too_close(-2e-4, 0, 0.01));
  CHECK_FALSE(too_close(0.008, 0.008, 0.01));
  CHECK(too_close(0.0079, 0.008, 0.01));
}

TEST_CASE("an obstacle that asks for more room is judged even when another is nearer", "[scene][clearance]") {
  const SceneEquilibrium eq = with_obstacles(
      sagging_hose(), {solid("near", HalfSpace{}, {0, 0, 0.5}), solid("hot", HalfSpace{}, {0, 0, 0.4}, 0.5),
                       solid("wide", HalfSpace{}, {0, 0, 0.3}, 0.1), solid("far", HalfSpace{}, {0, 0, -1})});
  const auto gaps = eq.judged_gaps(eq.rods.front());
  REQUIRE(gaps.size() == 3);
  CHECK(gaps[0].gap.obstacle == 0);
  CHECK_FALSE(gaps[0].too_close);
  CHECK(gaps[1].gap.obstacle == 1);
  CHECK(gaps[1].too_close);
  CHECK(gaps[1].gap.value == Approx(gaps[0].gap.value + 0.1));
  CHECK(gaps[2].gap.obstacle == 2);
  CHECK_FALSE(gaps[2].too_close);
}
