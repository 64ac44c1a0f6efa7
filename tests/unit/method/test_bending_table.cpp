// Bending tables: by hand, there and back again, and the tube that they describe.
#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

#include "base/units.h"
#include "geometry/mesh_topology.h"
#include "method/preform/bending_table.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::preform;
using namespace tendril::testing;
using routing::PccPoints;

namespace {

/// 100 mm along x, up along z, then along y: two bends of 90 degrees with radii of 50 and 30 mm.
PccPoints up_and_aside() {
  return {{{0, 0, 0}, {0.15, 0, 0}, {0.15, 0, 0.2}, {0.15, 0.1, 0.2}}, {0.05, 0.03}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> all;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(std::strtod(cell.c_str(), nullptr));
  return all;
}

double off(const PccPoints& a, const PccPoints& b) {
  double most = a.points.size() == b.points.size() ? 0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.points.size(), b.points.size()); ++i)
    most = std::max(most, (a.points[i] - b.points[i]).norm());
  for (std::size_t i = 0; i < std::min(a.radii.size(), b.radii.size()); ++i)
    most = std::max(most, std::abs(a.radii[i] - b.radii[i]));
  return most;
}

}  // namespace

TEST_CASE("bending table: two bends by hand") {
  const std::vector<Bend> bends = bends_of(up_and_aside());
  REQUIRE(bends.size() == 2);
  CHECK(bends[0].straight_before == Approx(0.1));
  CHECK(bends[0].angle == Approx(0.5 * units::pi));
  CHECK(bends[0].plane == 0);
  CHECK(bends[0].begin == Approx(0.1));
  CHECK((bends[0].vertex - Vec3(0.15, 0, 0)).norm() < 1e-15);
  CHECK((bends[0].axis - Vec3(0, -1, 0)).norm() < 1e-15);
  CHECK(bends[1].straight_before == Approx(0.2 - 0.05 - 0.03));
  CHECK(bends[1].radius == 0.03);
  // Fed along z, the axis goes from -y to -x: a quarter turn the way from y to x, against the right hand about z.
  CHECK(bends[1].plane == Approx(-0.5 * units::pi));
  CHECK((bends[1].axis - Vec3(-1, 0, 0)).norm() < 1e-15);
  CHECK(last_straight_of(up_and_aside()) == Approx(0.07));
  CHECK((start_of(up_and_aside()).d3() - Vec3::UnitX()).norm() < 1e-15);
  CHECK((start_of(up_and_aside()).d1() - Vec3::UnitZ()).norm() < 1e-15);
}

TEST_CASE("bending table: CSV files to the letter") {
  CHECK(lra_csv(up_and_aside()) ==
        "bend,L_mm,R_deg,A_deg,radius_mm\n"
        "1,100.000000,0.000000,90.000000,50.000000\n"
        "2,120.000000,-90.000000,90.000000,30.000000\n"
        "end,70.000000,0,0,0\n");
  CHECK(xyz_csv(up_and_aside()) ==
        "point,x_mm,y_mm,z_mm,radius_mm\n"
        "start,0.000000,0.000000,0.000000,0\n"
        "1,150.000000,0.000000,0.000000,50.000000\n"
        "2,150.000000,0.000000,200.000000,30.000000\n"
        "end,150.000000,100.000000,200.000000,0\n");
  const PccPoints straight{{{0, 0, 0}, {0, -0.25, 0}}, {}};
  CHECK(lra_csv(straight) == "bend,L_mm,R_deg,A_deg,radius_mm\nend,250.000000,0,0,0\n");
  CHECK(xyz_csv(straight).find("end,0.000000,-250.000000,0.000000,0\n") != std::string::npos);
  CHECK(bends_of(straight).empty());
  // A vertex without a turn is no bend.
  const PccPoints through{{{0, 0, 0}, {0, -0.1, 0}, {0, -0.25, 0}}, {0.05}};
  CHECK(lra_csv(through) == lra_csv(straight));
}

TEST_CASE("bending table: points to table and back, over random hoses") {
  const unsigned seed = GENERATE(range(1u, 41u));
  CAPTURE(seed);
  Random random(seed);
  const PccPoints points = random_pcc(random, 1 + random.below(8), random.in(0.01, 0.1), 3.0);
  std::vector<Bend> bends = bends_of(points);
  CHECK(off(points_of(bends, last_straight_of(points), start_of(points)), points) < 1e-12);

  // Moved as a whole the table stays.
  const Quat turn = random.rotation();
  PccPoints moved = points;
  for (Vec3& p : moved.points) p = turn * p + Vec3(1, -2, 3);
  const std::vector<Bend> same = bends_of(moved);
  REQUIRE(same.size() == bends.size());
  for (std::size_t i = 0; i < bends.size(); ++i) {
    CHECK(same[i].plane == Approx(bends[i].plane).margin(1e-9));
    CHECK(same[i].angle == Approx(bends[i].angle).margin(1e-12));
    CHECK(same[i].straight_before == Approx(bends[i].straight_before).margin(1e-12));
    CHECK((same[i].axis - turn * bends[i].axis).norm() < 1e-9);
  }
  // Fed from the other end, the turns between planes stay as they are, in the other order.
  PccPoints reversed = points;
  std::reverse(reversed.points.begin(), reversed.points.end());
  const std::vector<Bend> back = bends_of(reversed);
  REQUIRE(back.size() == bends.size());
  for (std::size_t i = 1; i < bends.size(); ++i)
    CHECK(std::remainder(back[i].plane - bends[bends.size() - i].plane, 2 * units::pi) == Approx(0).margin(1e-9));
}

TEST_CASE("bending table: table to points and back, angles from 1e-8 to near pi, planes all around") {
  for (const double angle : {1e-8, 1e-5, 0.1, 1.0, 3.0, 3.14})
    for (const double plane : {-3.14, -1.0, -1e-9, 0.0, 1e-6, 0.5, units::pi}) {
      CAPTURE(angle, plane);
      const std::vector<Bend> bends{{0.05, 1.2, 0.1, 0}, {0.03, angle, 0.2, plane}, {0.04, 0.8, 0.05, -plane}};
      const PccPoints points = points_of(bends, 0.07, Frame::looking({1, 2, 3}, {1, 1, 0}));
      const std::vector<Bend> again = bends_of(points);
      REQUIRE(again.size() == 3);
      // The plane of a bend is known as well as its angle allows.
      const double sharp = 1e-12 / std::min({angle, units::pi - angle, 0.1});
      for (int i = 0; i < 3; ++i) {
        CHECK(again[i].angle == Approx(bends[i].angle).margin(1e-12 + 0.1 * sharp));
        CHECK(std::remainder(again[i].plane - bends[i].plane, 2 * units::pi) == Approx(0).margin(10 * sharp));
        CHECK(again[i].straight_before == Approx(bends[i].straight_before).margin(sharp));
      }
      CHECK(last_straight_of(points) == Approx(0.07).margin(1e-12));
    }
}

TEST_CASE("bending table: the table read from CSV gives the hose to a micrometre") {
  Random random(7);
  const PccPoints points = random_pcc(random, 6, 0.05, 2.5);
  std::vector<Bend> bends;
  double last = 0;
  const auto rows = lines(lra_csv(points));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<double> row = numbers(rows[i]);
    REQUIRE(row.size() == 5);
    if (i + 1 == rows.size()) last = row[1] * units::mm;
    else bends.push_back({row[4] * units::mm, row[3] * units::deg, row[1] * units::mm, row[2] * units::deg});
  }
  CHECK(off(points_of(bends, last, start_of(points)), points) < 1e-6);
}

TEST_CASE("centre line: places, tangents, bends' ends and spacing") {
  const PccPoints points = up_and_aside();
  const Curve curve = points.curve();
  const auto rows = lines(centre_line_csv(points, 7e-3));
  CHECK(rows[0] == "s_mm,x_mm,y_mm,z_mm,tx,ty,tz");
  double last = 0;
  std::vector<double> all;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<double> row = numbers(rows[i]);
    REQUIRE(row.size() == 7);
    const double s = std::min(row[0] * units::mm, curve.length());
    CHECK((curve.at(s).at - units::mm * Vec3(row[1], row[2], row[3])).norm() < 3e-9);
    CHECK((curve.at(s).d3() - Vec3(row[4], row[5], row[6])).norm() < 1e-6);
    CHECK(s - last <= 7e-3 * (1 + 1e-6));
    last = s;
    all.push_back(s);
  }
  CHECK(all.front() == 0);
  CHECK(last == Approx(points.length()).margin(1e-9));
  for (const double s : curve.breaks())
    CHECK(std::any_of(all.begin(), all.end(), [&](double x) { return std::abs(x - s) < 1e-9; }));
  CHECK_THROWS_WITH(centre_line_csv(points, 0), "centre line: the spacing is 0 m; above 0 expected");
  CHECK_THROWS_WITH(centre_line_csv(points, 1e-9), "centre line: the spacing of 1e-09 m is too small; 10^7 rows at most");
}

TEST_CASE("bending table: what is refused") {
  const Frame start;
  const auto refused = [&](const Bend& bend, const std::string& what) {
    CHECK_THROWS_WITH(points_of({Bend(), bend}, 0, start), "bending table: " + what + " expected");
  };
  const std::string length = "; a finite length of at least 0";
  refused({-1, 1, 0, 0}, "the radius of bend 2 is -1" + length);
  refused({0.1, 1, NAN, 0}, "the straight before of bend 2 is nan" + length);
  refused({0.1, 3.2, 0, 0}, "the angle of bend 2 is 3.2; 0 ... pi, without pi,");
  refused({0.1, -0.1, 0, 0}, "the angle of bend 2 is -0.1; 0 ... pi, without pi,");
  refused({0.1, 1, 0, INFINITY}, "the plane of bend 2 is inf; a finite angle");
  CHECK_THROWS_WITH(points_of({}, -0.1, start), "bending table: the last straight is -0.1 m" + length + " expected");
}

TEST_CASE("tube of a hose: closed, pi r^2 L, within the tolerance of the true surface") {
  const unsigned seed = GENERATE(range(1u, 9u));
  CAPTURE(seed);
  Random random(seed);
  const PccPoints points = random_pcc(random, random.below(5), 0.05);
  const double length = points.length(), r = 0.012;
  const Mesh fine = tube_mesh(points, 2 * r, 0, 1e-6);
  CHECK(topology_of(fine, weld_tolerance(fine)).watertight());
  CHECK(fine.volume() == Approx(units::pi * r * r * length).epsilon(1e-3));
  const Mesh hollow = tube_mesh(points, 2 * r, 0.016, 1e-6);
  CHECK(topology_of(hollow, weld_tolerance(hollow)).watertight());
  CHECK(hollow.volume() == Approx(units::pi * (r * r - 0.008 * 0.008) * length).epsilon(1e-3));
  CHECK(hollow.area() ==
        Approx(2 * units::pi * (r + 0.008) * length + 2 * units::pi * (r * r - 0.008 * 0.008)).epsilon(1e-3));

  // The middles of its triangles are off the true surface by no more than sides and sagitta allow, each the tolerance.
  const double tolerance = 0.05e-3;
  const Mesh drawn = tube_mesh(points, 2 * r, 0, tolerance);
  CHECK(drawn.triangles.size() < 20000);
  const std::vector<Vec3> line = points.curve().sampled(1e-4);
  double most = 0;
  for (std::size_t t = 0; t < drawn.triangles.size(); t += 17) {
    Vec3 middle = Vec3::Zero();
    for (const int v : drawn.triangles[t]) middle += drawn.vertices[v] / 3;
    double distance = 1;
    for (const Vec3& p : line) distance = std::min(distance, (p - middle).norm());
    if ((middle - line.front()).norm() > 1.01 * r && (middle - line.back()).norm() > 1.01 * r)
      most = std::max(most, std::abs(distance - r));
  }
  CHECK(most < 2.1 * tolerance);
}

TEST_CASE("tube of a hose: bends without straights between, tiny bends, and what is refused") {
  PccPoints joined{{{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.1, 0}, {0.1, 0.1, 0}}, {0.05, 0.05}};
  const Mesh mesh = tube_mesh(joined, 0.02, 0.01);
  CHECK(topology_of(mesh, weld_tolerance(mesh)).watertight());
  PccPoints tiny{{{0, 0, 0}, {0.5, 0, 0}, {1, 1e-7, 0}}, {0.05}};
  const Mesh nearly = tube_mesh(tiny, 0.02, 0, 1e-6);
  CHECK(topology_of(nearly, weld_tolerance(nearly)).watertight());
  CHECK(nearly.volume() == Approx(units::pi * 1e-4).epsilon(1e-3));
  CHECK_THROWS_WITH(tube_mesh(joined, 0.11),
                    "tube: a bend's radius of 50 mm is less than the tube's own radius of 55 mm");
  CHECK_THROWS_WITH(tube_mesh(joined, 0.02, 0, 0), "tube: the tolerance is 0 m; above 0 expected");
  CHECK_THROWS_WITH(tube_mesh(joined, 0.02, 0.03),
                    "tube: diameters of 0.02 m outside and 0.03 m inside; 0 <= inside < outside expected");
}
