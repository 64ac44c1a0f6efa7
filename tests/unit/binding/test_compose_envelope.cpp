#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "binding/compose_envelope.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;

namespace {

std::shared_ptr<const TriangleSurface> box(const Vec3& half, const Vec3& at, int n = 4) {
  return std::make_shared<const TriangleSurface>(welded(test::box_mesh(half, n).moved(at, Quat::Identity()), 1e-9).mesh);
}

PlacedObstacle obstacle(const std::string& name, decltype(Obstacle::shape) shape, const Frame& pose, double clearance = 0) {
  PlacedObstacle placed;
  placed.name = name;
  placed.body.shape = std::move(shape);
  placed.body.pose = pose;
  placed.clearance = clearance;
  return placed;
}

double least(const std::vector<double>& values) {
  double smallest = INFINITY;
  for (const double v : values) smallest = std::isnan(v) ? smallest : std::min(smallest, v);
  return smallest;
}

}  // namespace

TEST_CASE("a shell's clearance is signed", "[compose_envelope]") {
  const auto shell = box({0.1, 0.1, 0.1}, {0, 0, 0});
  SECTION("apart") {
    const ShellClearance c = shell_clearance(shell->mesh(), {obstacle("a", box({0.1, 0.1, 0.1}, {0, 0, 0}), {{0.25, 0, 0}, Quat::Identity()}, 0.06)});
    CHECK(c.least == Approx(0.05));
    CHECK(c.nearest == 0);
    CHECK(c.overlaps.empty());
    CHECK(least(c.values) == Approx(50));
    for (std::size_t v = 0; v < c.values.size(); ++v)  // from the plane x = 0.15
      CHECK(c.values[v] == Approx(1e3 * (0.15 - shell->mesh().vertices[v].x())));
  }
  SECTION("into each other: negative within the obstacle, which is turned") {
    const Frame pose{{0.25, 0, 0}, exp_rotation({0, 0, 0.5 * units::pi})};
    const ShellClearance c = shell_clearance(shell->mesh(), {obstacle("a", box({0.2, 0.18, 0.3}, {0, 0, 0}), pose)});
    CHECK(least(c.values) == Approx(-30));  // 0.25 - 0.18 = 0.07
    CHECK(c.least == Approx(-0.03));
    CHECK(c.overlaps == std::vector<int>{0});
  }
  SECTION("an obstacle wholly within the shell") {
    const ShellClearance c = shell_clearance(shell->mesh(), {obstacle("bolt", box({0.01, 0.01, 0.01}, {0, 0, 0}), {})});
    CHECK(c.overlaps == std::vector<int>{0});
    CHECK(c.least == 0);
    CHECK(least(c.values) > 0);
  }
  SECTION("solids, and margins where requirements differ") {
    const ShellClearance c = shell_clearance(
        shell->mesh(), {obstacle("floor", HalfSpace{}, {{0, 0, -0.12}, Quat::Identity()}, 0.05),
                        obstacle("ball", Sphere{0.1}, {{0, 0, 0.23}, Quat::Identity()}, 0.01)});
    CHECK(least(c.values) == Approx(20 - 50));
    CHECK(c.nearest == 0);
    CHECK(c.least == Approx(0.02));
  }
  SECTION("nothing near") {
    const ShellClearance c = shell_clearance(shell->mesh(), {obstacle("a", box({0.1, 0.1, 0.1}, {0, 0, 0}), {{5, 0, 0}, Quat::Identity()})});
    CHECK(c.nearest == -1);
    CHECK(std::isinf(c.least));
    CHECK(std::isinf(least(c.values)));
  }
}

TEST_CASE("what a picture says of its envelope", "[compose_envelope]") {
  const auto shell = box({0.1, 0.1, 0.1}, {0, 0, 0});
  const auto wall = obstacle("wall", box({0.1, 0.1, 0.1}, {0, 0, 0}), {{0.25, 0, 0}, Quat::Identity()}, 0.06);
  Picture picture;
  picture.card.rows = {{"status", "solved", false}, {"tendril", "1", false}};
  add_envelope(shell, {wall}, true, picture);
  REQUIRE(picture.surfaces.size() == 1);
  CHECK(picture.surfaces[0].values.size() == shell->mesh().vertices.size());
  CHECK(picture.surfaces[0].style == SurfaceStyle::veil);
  CHECK(picture.scale.name == "envelope: clearance");
  CHECK(picture.scale.limit == Approx(60));
  REQUIRE(picture.card.rows.size() == 4);
  CHECK(picture.card.rows[1].value == "8 dm^3");
  CHECK(picture.card.rows[2].value == "50 mm (required 60 mm)");
  CHECK(picture.card.rows[2].alarm);
  CHECK(picture.card.rows[3].label == "tendril");
  Picture plain;
  add_envelope(shell, {}, false, plain);
  CHECK(plain.surfaces[0].values.empty());
  CHECK(plain.card.rows.size() == 1);
  Picture far;
  add_envelope(shell, {obstacle("far", box({0.1, 0.1, 0.1}, {0, 0, 0}), {{5, 0, 0}, Quat::Identity()}), wall}, false, far);
  CHECK(far.card.rows.back().value == "50 mm to wall (required 60 mm)");
}
