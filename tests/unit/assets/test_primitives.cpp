// The shapes that parts are made of: closed where they should be, of the right size.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "engine_bay/bay.h"
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/loft.h"
#include "engine_bay/sheet.h"

using namespace tendril;
using namespace tendril::engine_bay;


namespace {

const Detail very_fine{2.0, 2 * units::deg, true};

void check_closed(const Mesh& mesh) {
  const Figures f = figures(mesh);
  CHECK(f.open_edges == 0);
  CHECK(f.crossed_edges == 0);
  CHECK(f.volume > 0);
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm() / 2;
  return sum;
}

}  // namespace

TEST_CASE("a rounded box has the volume of a box less its edges", "[assets]") {
  const double a = 60, b = 40, c = 30, r = 8;
  const Mesh mesh = box({0, 0, 0}, {a, b, c}, r, very_fine);
  check_closed(mesh);
  const double A = a - 2 * r, B = b - 2 * r, C = c - 2 * r;
  const double exact = A * B * C + 2 * r * (A * B + B * C + C * A) + units::pi * r * r * (A + B + C) + 4.0 / 3 * units::pi * r * r * r;
  CHECK(figures(mesh).volume == Approx(exact).epsilon(1e-3));
  CHECK((figures(mesh).high - Vec3(a, b, c)).norm() < 1e-9);
}

TEST_CASE("a sharp box is twelve triangles", "[assets]") {
  const Mesh mesh = box({1, 2, 3}, {4, 6, 8}, 0, light());
  CHECK(mesh.triangles.size() == 12);
  check_closed(mesh);
  CHECK(figures(mesh).volume == Approx(60));
}

TEST_CASE("turned bodies, rings and cylinders are closed and hold their volume", "[assets]") {
  const Mesh rod = cylinder(10, 50, 0, very_fine);
  check_closed(rod);
  CHECK(figures(rod).volume == Approx(units::pi * 100 * 50).epsilon(1e-3));

  const Mesh ring = turned({{8, 0}, {10, 0}, {10, 5}, {8, 5}, {8, 0}}, very_fine);
  check_closed(ring);
  CHECK(figures(ring).volume == Approx(units::pi * (100 - 64) * 5).epsilon(1e-3));

  const Mesh cone = turned({{0, 0}, {12, 0}, {0, 20}}, very_fine);
  check_closed(cone);
  CHECK(figures(cone).volume == Approx(units::pi * 144 * 20 / 3).epsilon(2e-3));
}

TEST_CASE("a bent pipe has the volume of its section times its length (Pappus)", "[assets]") {
  const double R = 60;
  const Path line = rounded_path({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}}, R, very_fine);
  const double length = 2 * (100 - R) + R * units::pi / 2;
  CHECK(arc_lengths(line).back() == Approx(length).epsilon(1e-3));
  const Mesh mesh = pipe(line, 10, 7, very_fine);
  check_closed(mesh);
  CHECK(figures(mesh).volume == Approx(units::pi * (100 - 49) * length).epsilon(3e-3));
}

TEST_CASE("a joined sweep is a ring", "[assets]") {
  Path loop;
  for (int k = 0; k < 90; ++k) loop.emplace_back(50 * std::cos(k * 4 * units::deg), 50 * std::sin(k * 4 * units::deg), 0);
  const Mesh mesh = sweep(loop, circle(5, very_fine), Ends::joined, very_fine, Vec3::UnitZ());
  check_closed(mesh);
  CHECK(figures(mesh).volume == Approx(2 * units::pi * units::pi * 25 * 50).epsilon(5e-3));
}

TEST_CASE("bolts and clamps are closed at any detail", "[assets]") {
  for (const Detail& detail : {light(), fine(), very_fine}) {
    check_closed(bolt(8, detail));
    check_closed(hose_clamp(12, 10, detail));
    check_closed(strap({{0, 0, 0}, {30, 0, 0}, {30, 0, 20}, {60, 0, 20}}, 15, 3, Vec3::UnitY(), detail));
  }
}

TEST_CASE("a sheet has its rim and its holes as open edges, and their area taken out", "[assets]") {
  const std::vector<Hole> holes = {{{30, 40}, 10}, {{120, 30}, 15}};
  const Mesh mesh = sheet(200, 80, holes, very_fine);
  const Figures f = figures(mesh);
  CHECK(f.open_edges > 0);
  CHECK(f.crossed_edges == 0);
  CHECK(f.slivers == 0);
  CHECK(area(mesh) == Approx(200 * 80 - units::pi * (100 + 225)).epsilon(2e-3));
  // Euler's number of a disc with two holes is -1.
  std::size_t used = mesh.points.size(), edges = (3 * mesh.triangles.size() + f.open_edges) / 2;
  CHECK(static_cast<long>(used) - static_cast<long>(edges) + static_cast<long>(mesh.triangles.size()) == -1);
}

TEST_CASE("a sheet says which hole does not fit", "[assets]") {
  CHECK_THROWS_WITH(sheet(100, 100, {{{5, 50}, 10}}, light()), Catch::Contains("too near to the rim"));
  CHECK_THROWS_WITH(sheet(100, 100, {{{40, 50}, 10}, {{55, 50}, 10}}, light()), Catch::Contains("too near to each other"));
}

TEST_CASE("mirroring keeps the outside outside", "[assets]") {
  const Mesh mesh = mirrored(box({10, 0, 0}, {30, 5, 5}, 1, fine()), 100);
  check_closed(mesh);
  CHECK(figures(mesh).low.x() == Approx(170));
}
