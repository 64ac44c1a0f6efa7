// What a harness is measured by, against lengths and volumes worked by hand.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/quantities.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

namespace {

/// 1 m along x from the origin at height z, without load: it stays straight.
PlacedRod straight(const char* name, double z = 0) {
  return PlacedRod(name, Rod::uniform(1, soft_section(), 20), Frame::looking({0, 0, z}, {1, 0, 0}), Frame::looking({1, 0, z}, {1, 0, 0}));
}

}  // namespace

TEST_CASE("quantities: lengths, volume, mass, clips and branch points") {
  Scene scene;
  PlacedRod& a = scene.add(straight("a"));
  a.hold({0.25, Frame::looking({0.25, 0, 0}, {1, 0, 0})});
  a.hold({0.5, Frame::looking({0.5, 0, 0}, {1, 0, 0}), true, false});
  Rod two = Rod::uniform(0.6, soft_section(), 20);
  two.parts = {{0.2, soft_section()}, {0.6, Section::round(0.01, 0, Material::from_poisson(6e6, 0.45, 1000))}};
  PlacedRod& b = scene.add(PlacedRod("b", two, std::nullopt, Frame::looking({1.6, 0, 0}, {1, 0, 0})));
  a.release(1);
  scene.join("joint", {{&a, 1, std::nullopt}, {&b, 0, std::nullopt}}, std::nullopt);
  const Quantities q = quantities_of(scene.solve());
  REQUIRE(q.rods.size() == 2);
  CHECK(q.branches == 1);
  CHECK(q.rods[0].rod == "a");
  CHECK(q.rods[0].length == Approx(1).epsilon(1e-9));
  CHECK(q.rods[0].unstressed_length == 1);
  CHECK(q.rods[0].clips == 2);
  CHECK(q.rods[0].held_ends == 1);
  CHECK(q.rods[1].clips == 0);
  CHECK(q.rods[1].held_ends == 1);
  const double disc = units::pi / 4 * 0.02 * 0.02;
  CHECK(q.rods[0].volume == Approx(disc));
  CHECK(q.rods[1].volume == Approx(0.2 * disc + 0.4 * disc / 4));
  CHECK(q.rods[0].mass == Approx(1150 * 0.75 * disc));
  CHECK(q.total.length == Approx(1.6).epsilon(1e-9));
  CHECK(q.total.clips == 2);
  CHECK(q.total.volume == Approx(1.2 * disc + 0.1 * disc));
  CHECK(q.total.mass == Approx(q.rods[0].mass + q.rods[1].mass));
  CHECK(q.total.length_in_collision == 0);
  CHECK(q.total.cost == Approx(q.total.length));
  CHECK(q.wire_lengths.empty());
}

TEST_CASE("quantities: a loaded rod is as long as it is stretched") {
  Scene scene;
  PlacedRod& rod = scene.add(straight("a"));
  rod.release(1);
  rod.load({1, {5, 0, 0}, Vec3::Zero()});
  const Quantities q = quantities_of(scene.solve());
  CHECK(q.total.length == Approx(1 + 5 / soft_section().EA).epsilon(1e-6));
  CHECK(q.total.unstressed_length == 1);
}

TEST_CASE("quantities: length in collision") {
  Scene scene;
  scene.add(straight("through"));
  scene.add(straight("above", 1));
  // The hold at the start lies in the box, which contact cannot push it out of: cut the contact off by soft penetration.
  SceneEquilibrium eq = scene.solve();
  Scene walls;
  walls.add(solid("box", Box{{0.4, 0.4, 0.4}}, {0.5, 0, 0}));
  eq.obstacles = walls.bodies();
  eq.surroundings = walls.surroundings();
  const Quantities q = quantities_of(eq);
  // The rod's surface enters the box a radius before its centre line does.
  CHECK(q.rods[0].length_in_collision == Approx(0.4 + 2 * 0.0099).margin(0.011));
  CHECK(q.rods[1].length_in_collision == 0);
  CHECK(q.total.length_in_collision == q.rods[0].length_in_collision);
  CHECK(quantities_of(eq, {.free_ends = 0.4}).rods[0].length_in_collision == Approx(0.2).margin(0.011));
  CHECK(quantities_of(eq, {.free_ends = 0.6}).rods[0].length_in_collision == 0);
}

TEST_CASE("quantities: what the run costs by clearance and preference") {
  Scene scene;
  scene.add(straight("a"));
  SceneEquilibrium eq = scene.solve();
  Scene walls;
  PlacedObstacle floor = solid("floor", HalfSpace{}, {0, 0, -0.05});
  walls.add(floor);
  eq.obstacles = walls.bodies();
  eq.surroundings = walls.surroundings();
  // The gap is 0.04 m all along.
  const double f = std::pow(1 - 0.04 / 0.1, 2);
  CHECK(quantities_of(eq, {.clearance = 3}).total.cost == Approx(1 + 3 * f));
  CHECK(quantities_of(eq, {.preference = 3}).total.cost == Approx(1));
  eq.obstacles[0].prefer = Preference::avoid;
  CHECK(quantities_of(eq, {.clearance = 1, .preference = 3}).total.cost == Approx(1 + f + 3 * f));
  CHECK(quantities_of(eq, {.preference = 3, .range = 0.03}).total.cost == Approx(1));
  eq.obstacles[0].prefer = Preference::near;
  CHECK(quantities_of(eq, {.clearance = 1, .preference = 3}).total.cost == Approx(1 + 3 * (1 - f)));
  CHECK(quantities_of(eq, {.preference = 3, .range = 0.03}).total.cost == Approx(4));
}

TEST_CASE("quantities: wires by the rods that they run through") {
  Scene scene;
  scene.add(straight("a"));
  scene.add(PlacedRod("b", Rod::uniform(0.5, soft_section(), 20), Frame::looking({0, 1, 0}, {1, 0, 0}), Frame::looking({0.5, 1, 0}, {1, 0, 0})));
  const SceneEquilibrium eq = scene.solve();
  const Quantities q = quantities_of(eq, {.wires = {{"W1", {"a", "b"}}, {"W2", {"b"}}, {"W3", {}}}});
  CHECK(q.wire_lengths.at("W1") == Approx(1.5).epsilon(1e-9));
  CHECK(q.wire_lengths.at("W2") == Approx(0.5).epsilon(1e-9));
  CHECK(q.wire_lengths.at("W3") == 0);
  CHECK(q.cable_length == Approx(2).epsilon(1e-9));
  CHECK_THROWS_WITH(quantities_of(eq, {.wires = {{"W1", {"a", "a"}}}}), Contains("wire 'W1' runs through 'a' twice"));
  CHECK_THROWS_WITH(quantities_of(eq, {.wires = {{"W1", {"c"}}}}), Contains("'c'"));
}

TEST_CASE("quantities: options that make no sense are refused by name") {
  Scene scene;
  scene.add(straight("a"));
  const SceneEquilibrium eq = scene.solve();
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), double(INFINITY)}) {
    CHECK_THROWS_WITH(quantities_of(eq, {.clearance = bad}), Contains("'clearance' is"));
    CHECK_THROWS_WITH(quantities_of(eq, {.preference = bad}), Contains("'preference' is"));
    CHECK_THROWS_WITH(quantities_of(eq, {.range = bad}), Contains("'range' is"));
    CHECK_THROWS_WITH(quantities_of(eq, {.free_ends = bad}), Contains("'free_ends' is"));
  }
}
