// Paths of handles and grips: ways out whose width is known, travelled ways against sums, clearance between samples.
#include <catch2/catch.hpp>

#include <random>

#include "method/assembly/handle_path.h"
#include "method/assembly/path_smoothing.h"
#include "unit/method/assembly_scenes.h"

using namespace tendril;
using namespace tendril::assembly;
using tendril::assembly_scenes::add_box;
using tendril::assembly_scenes::add_hose;
using tendril::assembly_scenes::obstacle;
using tendril::assembly_scenes::radius;

namespace {

std::shared_ptr<const routing::FreeSpace> space_of(const Scene& scene, const Vec3& from, double reach) {
  routing::SpaceDemands demands;
  demands.radius = radius;
  return std::make_shared<const routing::FreeSpace>(scene, demands, std::vector<Vec3>{from}, reach, RunContext{});
}

/// A box of 0.6 m whose top has a square window; 0: closed.
Scene box_with_window(double window) {
  Scene scene;
  const double half = 0.3, wall = 0.02, out = half + wall, strip = out - 0.5 * window;
  add_box(scene, "bottom", {2 * out, 2 * out, wall}, {0, 0, -half - 0.5 * wall});
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0 ? "low " : "high ";
    add_box(scene, which + "wall x", {wall, 2 * out, 2 * half}, {side * (half + 0.5 * wall), 0, 0});
    add_box(scene, which + "wall y", {2 * out, wall, 2 * half}, {0, side * (half + 0.5 * wall), 0});
    add_box(scene, "top " + which + "x", {strip, 2 * out, wall}, {side * (0.5 * window + 0.5 * strip), 0, half + 0.5 * wall});
    if (window > 0) add_box(scene, "top " + which + "y", {window, strip, wall}, {0, side * (0.5 * window + 0.5 * strip), half + 0.5 * wall});
  }
  return scene;
}

Manipulation random_walk(std::mt19937_64& random, int grips, int times) {
  std::uniform_real_distribution<double> u(-1, 1);
  Manipulation walk;
  for (int i = 0; i < times; ++i) walk.times.push_back(double(i) / (times - 1));
  for (int g = 0; g < grips; ++g) {
    walk.grips.push_back({"grip " + std::to_string(g), 0, -1, 0.1 * g});
    walk.poses.emplace_back();
    for (int i = 0; i < times; ++i) walk.poses.back().push_back({Vec3(u(random), u(random), u(random)), Quat(u(random), u(random), u(random), 0.1).normalized()});
  }
  return walk;
}

}  // namespace

TEST_CASE("assembly: the way out of a box is as wide as its window") {
  const Vec3 from(0.05, -0.08, -0.1);
  for (const double window : {0.03, 0.05, 0.1}) {
    const Scene scene = box_with_window(window);
    const auto space = space_of(scene, from, 1.2);
    HandlePaths paths(*space, from, {radius, 0.4, 0, std::nullopt});
    INFO("window " << window << ", " << paths.why());
    // Places of the grid miss the middle of the window by half a step at most, either way.
    CHECK(paths.widest().radius < 0.5 * window + 0.01 * radius);
    CHECK(paths.widest().radius > 0.5 * window - 0.8 * radius);
    CHECK((paths.widest().narrow - Vec3(0, 0, 0.3)).norm() < 0.04);
    const auto path = paths.next();
    if (paths.widest().radius < radius) {
      CHECK_FALSE(path);
      CHECK_THAT(paths.why(), Catch::Contains("narrowest at top"));
      continue;
    }
    REQUIRE(path);
    CHECK(path->points.front() == from);
    CHECK(path->clearance >= 0.99 * radius);
    CHECK(space->gap(path->points.back(), 1).value + radius >= 0.4 - radius);
    double length = 0;
    for (std::size_t i = 1; i < path->points.size(); ++i) length += (path->points[i] - path->points[i - 1]).norm();
    CHECK(path->length == Approx(length));
    // No way is shorter than that to the window and on until there is room for the arm.
    CHECK(length > 0.4 + 0.3);
    CHECK(length < 1.2 * (0.4 + 0.45));
  }
}

TEST_CASE("assembly: out of a closed box there is no way of any width") {
  const Scene scene = box_with_window(0);
  const auto space = space_of(scene, Vec3::Zero(), 1.2);
  HandlePaths paths(*space, Vec3::Zero(), {radius, 0.4, 0, std::nullopt});
  CHECK(paths.widest().radius == 0);
  CHECK_FALSE(paths.next());
  CHECK_THAT(paths.why(), Catch::Contains("enclosed"));
}

TEST_CASE("assembly: without obstacles a handle goes straight to its exit") {
  const Scene scene;
  const auto space = space_of(scene, Vec3::Zero(), 1);
  HandlePaths paths(*space, Vec3::Zero(), {radius, 0.4, 0, Vec3(0.1, 0.2, 0.2)});
  const auto path = paths.next();
  REQUIRE(path);
  CHECK(path->length == Approx(0.3));
  CHECK_FALSE(paths.next());
  CHECK_THROWS_WITH(HandlePaths(*space, Vec3::Zero(), {0, 0.4, 0, std::nullopt}), Catch::Contains("radius"));
  CHECK_THROWS_WITH(HandlePaths(*space, Vec3::Zero(), {radius, NAN, 0, std::nullopt}), Catch::Contains("arm"));
  CHECK_THROWS_WITH(HandlePaths(*space, Vec3(NAN, 0, 0), {radius, 0.4, 0, std::nullopt}), Catch::Contains("finite"));
}

TEST_CASE("assembly: travelled ways are sums over small pieces") {
  std::mt19937_64 random(20);
  for (int trial = 0; trial < 10; ++trial) {
    const Manipulation walk = random_walk(random, 3, 7);
    const Travelled travelled(walk);
    const double from = 0.07 * trial, to = from + 0.3;
    double way = 0;
    constexpr int pieces = 6000;
    for (int i = 0; i < pieces; ++i) {
      double farthest = 0;
      for (int g = 0; g < 3; ++g) farthest = std::max(farthest, travel(walk.pose(g, from + (to - from) * i / pieces), walk.pose(g, from + (to - from) * (i + 1) / pieces)));
      way += farthest;
    }
    INFO("seed 20, trial " << trial);
    CHECK(travelled(from, to) == Approx(way).epsilon(2e-3));
    CHECK(walk.moved(from, to) == travelled(from, to));
    CHECK(travelled(from, from) == 0);
  }
}

TEST_CASE("assembly: grips that cut into an obstacle are moved out, between samples too") {
  Scene scene(Vec3::Zero());
  scene.add(obstacle("post", Cylinder{0.03, 0.6}));
  add_hose(scene, 0.5, Frame::looking({0.2, 0, 0}, {1, 0, 0}), Frame::looking({0.7, 0, 0}, {1, 0, 0}));
  const InstalledSystem system = installed_system(scene, {}, 2);
  // Past the post in one straight, 5 mm into where the hose has room.
  Manipulation raw;
  raw.grips = {system.connections.front()};
  raw.times = {0, 0.5, 1};
  raw.poses = {{Frame{{-0.2, 0.033, 0}, Quat::Identity()}, Frame{{0.1, 0.033, 0}, Quat::Identity()}, Frame{{0.2, 0, 0}, Quat::Identity()}}};
  for (const bool smooth : {false, true}) {
    Manipulation clear = kept_clear(system, raw);
    if (smooth) clear = smoothed(system, clear, 0.1);
    double nearest = INFINITY;
    for (int i = 0; i <= 5000; ++i) nearest = std::min(nearest, clear.pose(0, i / 5000.0).at.head<2>().norm() - 0.03);
    CHECK(nearest > 0.98 * radius);
    CHECK(nearest < 1.02 * radius);
    CHECK((clear.poses[0].front().at - raw.poses[0].front().at).norm() == 0);
    CHECK((clear.poses[0].back().at - raw.poses[0].back().at).norm() == 0);
  }
}

TEST_CASE("assembly: a grip that is fastened nearer than its radius may get there") {
  Scene scene(Vec3::Zero());
  scene.add(obstacle("wall", Box{{0.02, 1, 1}}));
  add_hose(scene, 0.5, Frame::looking({0.012, 0, 0}, {1, 0, 0}), Frame::looking({0.512, 0, 0}, {1, 0, 0}));
  const InstalledSystem system = installed_system(scene, {}, 2);
  Manipulation raw;
  raw.grips = {system.connections.front()};
  raw.times = {0, 1};
  raw.poses = {{Frame{{0.212, 0, 0}, Quat::Identity()}, Frame{{0.012, 0, 0}, Quat::Identity()}}};
  const Manipulation clear = kept_clear(system, raw);
  CHECK((clear.poses[0].back().at - Vec3(0.012, 0, 0)).norm() == 0);
  for (double t = 0; t <= 1; t += 0.01) CHECK((clear.pose(0, t).at - raw.pose(0, t).at).norm() < 0.2 * radius);
}
