// Tubes around curves: closed, of the right volume and area, at the right distance.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/units.h"
#include "geometry/mesh_topology.h"
#include "geometry/tube_surface.h"

using namespace tendril;

namespace {

std::vector<double> every(const Curve& curve, int count) {
  std::vector<double> rings;
  for (int i = 0; i <= count; ++i) rings.push_back(curve.length() * i / count);
  return rings;
}

}  // namespace

TEST_CASE("tube surface: a prism by hand") {
  const Curve line = Curve::polyline({{0, 0, 0}, {0, 0, 0.5}});
  const int sides = GENERATE(3, 8, 64);
  const double area = 0.5 * sides * std::sin(2 * units::pi / sides);  // of a polygon of radius 1
  const Mesh solid = tube_surface(line, {0, 0.5}, 0.02, 0, sides);
  CHECK(topology_of(solid, weld_tolerance(solid)).watertight());
  CHECK(solid.volume() == Approx(area * 1e-4 * 0.5).epsilon(1e-12));
  CHECK(solid.area() ==
        Approx(2 * area * 1e-4 + 0.5 * sides * 2 * 0.01 * std::sin(units::pi / sides)).epsilon(1e-12));
  const Mesh hollow = tube_surface(line, {0, 0.2, 0.5}, 0.02, 0.01, sides);
  CHECK(topology_of(hollow, weld_tolerance(hollow)).watertight());
  CHECK(hollow.volume() == Approx(area * 0.75e-4 * 0.5).epsilon(1e-12));
  CHECK(hollow.triangles.size() == std::size_t(sides) * (2 * 2 * 2 + 2 * 2));
}

TEST_CASE("tube surface: a torus' volume and the distance of every vertex") {
  const Curve arc = Curve::pcc({{-0.5, 0, 0}, {0, 0, 0}, {0, 0.5, 0}}, 0.1);
  double last = 1;
  for (const int count : {50, 100, 200, 400}) {
    const Mesh mesh = tube_surface(arc, every(arc, count), 0.05, 0, count);
    const double error = 1 - mesh.volume() / (units::pi * 0.025 * 0.025 * arc.length());  // Pappus
    CHECK(error > 0);
    CHECK(error < 0.3 * last);
    last = error;
    CHECK(topology_of(mesh, weld_tolerance(mesh)).watertight());
    // The middles of the ends come last; all other vertices are 25 mm from the centre line.
    for (const Vec3& p : mesh.vertices) {
      const double bend = 0.1 - std::hypot(p.x() + 0.1, p.y() - 0.1);
      const double off = p.x() < -0.1 ? p.y() : p.y() > 0.1 ? p.x() : bend;
      const double radius = std::hypot(off, p.z());
      CHECK((radius == Approx(0.025).epsilon(1e-9) || radius < 1e-9));
    }
  }
  CHECK(last < 1e-4);
}

TEST_CASE("tube surface: sides for a tolerance") {
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const int sides = sides_for(0.01, tolerance);
    CHECK(0.01 * (1 - std::cos(units::pi / sides)) <= tolerance * (1 + 1e-12));
    if (sides > 8) CHECK(0.01 * (1 - std::cos(units::pi / (sides - 1))) > tolerance);
  }
  CHECK(sides_for(0.01, 1) == 8);
  CHECK(sides_for(0.01, 1e-300) == 512);
  CHECK(sides_for(1e300, 1e-9) == 512);
}

TEST_CASE("tube surface: what is refused") {
  const Curve line = Curve::polyline({{0, 0, 0}, {0, 0, 0.5}});
  const std::string diameters = "; 0 <= inside < outside expected";
  CHECK_THROWS_WITH(tube_surface(line, {0, 0.5}, 0.01, 0.01, 8),
                    "tube: diameters of 0.01 m outside and 0.01 m inside" + diameters);
  CHECK_THROWS_WITH(tube_surface(line, {0, 0.5}, NAN, 0, 8), "tube: diameters of nan m outside and 0 m inside" + diameters);
  CHECK_THROWS_WITH(tube_surface(line, {0, 0.5}, 0.01, -1, 8), "tube: diameters of 0.01 m outside and -1 m inside" + diameters);
  CHECK_THROWS_WITH(tube_surface(line, {0, 0.5}, 0.01, 0, 2), "tube: 2 sides; at least 3 expected");
  const std::string rise = "tube: the rings' arc lengths do not rise; at least 2, each above the last, expected";
  CHECK_THROWS_WITH(tube_surface(line, {0}, 0.01, 0, 8), rise);
  CHECK_THROWS_WITH(tube_surface(line, {0, 0.3, 0.3}, 0.01, 0, 8), rise);
  CHECK_THROWS_AS(tube_surface(line, {0, 0.6}, 0.01, 0, 8), UsageError);
}
