// The space that rods sweep from state to state.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "geometry/inside_test.h"
#include "method/envelope/collector.h"
#include "method/envelope/envelope.h"
#include "scene/scene.h"

using namespace tendril;

namespace {

constexpr double length = 0.5, radius = 0.01, way = 0.2, voxel = 2e-3;

/// A straight rod along x at a place beside it.
std::shared_ptr<SceneEquilibrium> straight_at(double y, double z) {
  Section section;
  section.outer = 2 * radius;
  section.EA = 1e4;
  section.GA1 = section.GA2 = 4e3;
  section.EI1 = section.EI2 = 0.5;
  section.GJ = 0.4;
  Scene scene;
  scene.add(PlacedRod("rod", Rod::uniform(length, section, 4), Frame::looking({0, y, z}, {1, 0, 0}), Frame::looking({length, y, z}, {1, 0, 0})));
  auto state = std::make_shared<SceneEquilibrium>(scene.solve());
  REQUIRE(state->ok());
  return state;
}

Envelope built(const EnvelopeOutcomes& outcomes) {
  EnvelopeOptions options;
  options.voxel = voxel;
  return EnvelopeBuilder().build(outcomes, options);
}

}  // namespace

TEST_CASE("swept space: ways round a corner do not fill what lies between them", "[envelope]") {
  // First sideways, then upwards.
  const std::vector<std::shared_ptr<SceneEquilibrium>> states{straight_at(0, 0), straight_at(way, 0), straight_at(way, way)};
  Status status = Status::stalled;
  const Envelope swept = built(swept_space(states, voxel, {}, status));
  REQUIRE(status == Status::solved);
  REQUIRE(swept.status == Status::solved);
  // A cross section of two slabs with round ends that share a corner, and half a ball's worth at either end of the rod.
  const double section = 2 * (2 * radius * way) + units::pi * radius * radius - (radius * radius - units::pi * radius * radius / 4);
  const double least = section * length, most = section * (length + 2 * radius) + 2.2 * voxel * (2 * (2 * way + 2 * radius) * length);
  CHECK(swept.volume > least);
  CHECK(swept.volume < most);
  CHECK(swept.volume < 0.7 * (least + 0.5 * way * way * length));  // the hull of all three has the triangle between as well
  const InsideTest inside(swept.mesh);
  for (double t = 0; t <= 1; t += 0.1)
    for (double x = 0; x <= length; x += 0.05) {
      CHECK(inside.inside({x, t * way, radius}));
      CHECK(inside.inside({x, way + radius, t * way}));
    }
  CHECK_FALSE(inside.inside({0.25, 0.3 * way, 0.3 * way}));
}

TEST_CASE("swept space: of one state it is the rod itself", "[envelope]") {
  const std::vector<std::shared_ptr<SceneEquilibrium>> states{straight_at(0.1, 0.2)};
  Status status = Status::stalled;
  const Envelope alone = built(swept_space(states, voxel, {}, status));
  REQUIRE(alone.status == Status::solved);
  EnvelopeCollector collector(*states.front(), voxel, EnvelopeOutcomes::Keep::hull);
  CHECK(collector.add(*states.front(), {}) == Status::solved);
  CHECK(collector.finish({}) == Status::solved);
  CHECK(alone.volume == Approx(built(collector.outcomes()).volume).epsilon(1e-6));
}
