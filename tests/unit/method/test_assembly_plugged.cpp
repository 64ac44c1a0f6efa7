// Assembly verification: connectors in sockets are plugged in straight, one after the other, and need no hand from then on.
#include <catch2/catch.hpp>

#include <cmath>

#include "method/assembly/assembly.h"
#include "method/assembly/pull.h"
#include "unit/method/assembly_scenes.h"

using namespace tendril;
using namespace tendril::assembly;

namespace {

constexpr double plug_length = 0.03, gap = 0.012, overlap = 0.002;

/// A hose between two walls, with a plug at either end that reaches into its wall by `overlap`.
assembly_scenes::Case between_walls() {
  assembly_scenes::Case c;
  assembly_scenes::add_box(c.scene, "left wall", {0.02, 0.2, 0.2}, {-0.26, 0, 0});
  assembly_scenes::add_box(c.scene, "right wall", {0.02, 0.2, 0.2}, {0.26, 0, 0});
  assembly_scenes::add_hose(c.scene, 0.5, Frame::looking({-0.25 + gap, 0, 0}, {1, 0, 0}), Frame::looking({0.25 - gap, 0, 0}, {1, 0, 0}));
  const double middle = 0.5 * plug_length - gap - overlap;
  for (const bool at_start : {true, false}) {
    assembly::Connector plug = assembly_scenes::connector(at_start ? "plug" : "socket", at_start, {0.02, 0.02, plug_length});
    plug.body.pose.at.z() = at_start ? middle : -middle;
    c.options.connectors.push_back(plug);
  }
  return c;
}

Frame at(double x) { return {Vec3(x, 0, 0), Quat::Identity()}; }

}  // namespace

TEST_CASE("assembly: a connection at rest until the end needs no hand, a further grip does") {
  Manipulation m;
  m.grips = {{"a", 0, -1, 0, true}, {"b", 0, -1, 1, true}, {"c", 0, -1, 0.5, false}};
  m.times = {0, 0.25, 0.5, 1};
  m.poses = {{at(0), at(1), at(1), at(1)}, {at(0), at(0), at(0), at(2)}, {at(0), at(0), at(0), at(0)}};
  CHECK(m.rests_from(0) == 0.25);
  CHECK(m.rests_from(1) == 1);
  CHECK(m.rests_from(2) == 0);
  CHECK(m.hands(0) == 3);
  CHECK(m.hands(0.25) == 2);
  CHECK(m.hands(0.9) == 2);
  CHECK(m.hands(1) == 1);
}

TEST_CASE("assembly: connectors leave their sockets straight, by their depth and a radius, the farthest from the handle first") {
  const assembly_scenes::Case c = between_walls();
  const InstalledSystem system = installed_system(c.scene, c.options, 2);
  REQUIRE(system.routed.ok());
  REQUIRE(system.connectors.size() == 2);
  for (const ConnectorBody& body : system.connectors) {
    INFO(body.name());
    CHECK(body.is_plugged_in());
    const double depth = body.socket_depth(*system.surroundings, body.pose(system.routed));
    CHECK(depth == Approx(overlap).margin(0.001));
  }
  const auto handle = std::max_element(system.extra.begin(), system.extra.end(), [](const Grip& a, const Grip& b) { return a.at < b.at; });
  DriveOptions options;
  options.radius = system.radius;
  const Vec3 from = system.pose(system.routed, *handle).at;
  const Pulled pulled = pull(system, *handle, {from, from + Vec3(0, 0, 0.8)}, false, options, {});
  INFO(pulled.message);
  REQUIRE(pulled.ok);
  REQUIRE(pulled.unplugged.passed.size() > 2);
  bool second_rested = true;
  for (const Passed& passed : pulled.unplugged.passed) {
    const Frame start = system.pose(passed.equilibrium, system.connections[0]), finish = system.pose(passed.equilibrium, system.connections[1]);
    CHECK(std::hypot(start.at.y(), start.at.z()) < 1e-9);
    CHECK(std::hypot(finish.at.y(), finish.at.z()) < 1e-9);
    if (passed.t < 0.5) second_rested = second_rested && std::abs(finish.at.x() - (0.25 - gap)) < 1e-9;
  }
  CHECK(second_rested);
  const Frame start = system.pose(pulled.unplugged.passed.back().equilibrium, system.connections[0]);
  CHECK(start.at.x() + 0.25 - gap == Approx(overlap + system.radius).margin(0.001));
}

TEST_CASE("assembly: a hose with plugs in two walls is proven, and its first plug needs no hand while the second goes in") {
  assembly_scenes::Case c = between_walls();
  c.options.optimise = false;
  const Result result = run(c.scene, c.options);
  INFO(result.message);
  REQUIRE(result.ok);
  CHECK(result.proof.deviation <= 0.05 * assembly_scenes::radius);
  CHECK(result.hands == 3);
  CHECK(result.manipulation.hands(0.9999) < 3);
}
