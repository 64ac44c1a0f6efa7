// The six-axis robot's bodies and files.
#include <catch2/catch.hpp>
#include <cstring>

#include "engine_bay/bay.h"
#include "six_axis/arm.h"

using namespace tendril;
using Catch::Matchers::Contains;

TEST_CASE("the six-axis robot: one clean mesh a link", "[assets]") {
  const auto bodies = six_axis::bodies(six_axis::usual());
  REQUIRE(bodies.size() == six_axis::joints().size() + 1);
  CHECK(std::string(bodies[0].link) == "base");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    CAPTURE(bodies[i].link);
    if (i > 0) CHECK(std::string(bodies[i].link) == six_axis::joints()[i - 1].child);
    const engine_bay::Figures f = engine_bay::figures(bodies[i].mesh);
    CHECK(f.triangles >= 1000);
    CHECK(f.triangles <= 5000);
    CHECK(f.open_edges == 0);
    CHECK(f.crossed_edges == 0);
    CHECK(f.slivers == 0);
    CHECK(f.volume > 0);
  }
  // It stands on the ground, and nothing of the base goes below.
  CHECK(engine_bay::figures(bodies[0].mesh).low.z() == Approx(0).margin(1e-9));
}

TEST_CASE("the six-axis robot: STL in metres, a description that names every link", "[assets]") {
  const auto bodies = six_axis::bodies(six_axis::usual());
  const std::string file = six_axis::stl(bodies[6].mesh);
  CHECK(file.size() == 84 + 50 * bodies[6].mesh.triangles.size());
  std::uint32_t count;
  std::memcpy(&count, file.data() + 80, 4);
  CHECK(count == bodies[6].mesh.triangles.size());
  float corner[3];
  std::memcpy(corner, file.data() + 84 + 12, sizeof corner);
  CHECK((Vec3(corner[0], corner[1], corner[2]) - 1e-3 * bodies[6].mesh.points[bodies[6].mesh.triangles[0][0]]).norm() < 1e-7);
  for (const auto& body : bodies)
    CHECK_THAT(six_axis::urdf(), Contains("package://tendril_six_axis/meshes/" + std::string(body.link) + ".stl"));
  CHECK_THAT(six_axis::package_xml(), Contains("<name>tendril_six_axis</name>"));
}
