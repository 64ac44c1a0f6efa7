// Centre curves of harness files against curves whose length and shape are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "harness/centre_line.h"
#include "harness/line_frames.h"
#include "harness/settled_curves.h"

using namespace tendril;

namespace {

constexpr double mm = 1e-3;

HarnessFile file_of(const HarnessCurve& curve, const Vec3& from, const Vec3& to, double stated) {
  HarnessFile file;
  file.nodes = {{"a", "a", from, 0, {}}, {"b", "b", to, 0, {}}};
  HarnessSegment segment;
  segment.id = "segment";
  segment.start = 0;
  segment.finish = 1;
  segment.curves = {curve};
  segment.virtual_length = stated;
  file.segments = {segment};
  return file;
}

CentreLine line_of(const HarnessFile& file) { return CentreLine(file, file.segments[0]); }

/// A quarter of a circle of radius r as a rational quadratic.
HarnessCurve quarter(double r) {
  return {2, {{r, 0, 0}, {r, r, 0}, {0, r, 0}}, {1, std::sqrt(0.5), 1}, {0, 0, 0, 1, 1, 1}};
}

Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  return {uniform(random), uniform(random), uniform(random)};
}

/// A Bezier point by de Casteljau, the textbook way.
Vec3 bezier_at(std::vector<Vec3> points, double t) {
  for (std::size_t level = points.size() - 1; level > 0; --level)
    for (std::size_t k = 0; k < level; ++k) points[k] = (1 - t) * points[k] + t * points[k + 1];
  return points[0];
}

double length_of_polyline(const std::vector<Vec3>& bezier, int pieces) {
  double sum = 0;
  for (int k = 0; k < pieces; ++k) sum += (bezier_at(bezier, double(k + 1) / pieces) - bezier_at(bezier, double(k) / pieces)).norm();
  return sum;
}

/// Control points of the same cubic as a uniform B-spline of one span, from the basis functions' own values at both ends.
std::vector<Vec3> as_unclamped(const std::vector<Vec3>& b) {
  Eigen::Matrix4d to_bezier;
  to_bezier << 1, 4, 1, 0, 0, 4, 2, 0, 0, 2, 4, 0, 0, 1, 4, 1;
  to_bezier /= 6;
  Eigen::Matrix<double, 4, 3> bezier;
  for (int k = 0; k < 4; ++k) bezier.row(k) = b[k];
  const Eigen::Matrix<double, 4, 3> control = to_bezier.partialPivLu().solve(bezier);
  return {control.row(0), control.row(1), control.row(2), control.row(3)};
}

}  // namespace

TEST_CASE("a rational quarter of a circle has its length, places and curvature") {
  const double r = 80 * mm, length = r * std::numbers::pi / 2;
  const CentreLine line = line_of(file_of(quarter(r), {r, 0, 0}, {0, r, 0}, length));
  CHECK(line.sound());
  CHECK(line.length() == Approx(length).epsilon(1e-10));
  CHECK(line.min_bend_radius() == Approx(r).epsilon(1e-9));
  for (const double share : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0}) {
    const double angle = share * std::numbers::pi / 2;
    const CentreLine::Place place = line.place(share * line.length());
    CHECK((place.at - r * Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-11);
    CHECK((place.tangent - Vec3(-std::sin(angle), std::cos(angle), 0)).norm() < 1e-9);
  }
}

TEST_CASE("clamped and unclamped curves are told apart by their nodes and length") {
  const unsigned seed = 20261123;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> bezier;
    for (int k = 0; k < 4; ++k) bezier.push_back(random_point(random));
    const double length = length_of_polyline(bezier, 20000);
    const CentreLine clamped = line_of(file_of({3, bezier, {}, {}}, bezier.front(), bezier.back(), length));
    const CentreLine unclamped = line_of(file_of({3, as_unclamped(bezier), {}, {}}, bezier.front(), bezier.back(), length));
    CHECK(clamped.reading() == KnotReading::clamped);
    CHECK(unclamped.reading() == KnotReading::unclamped);
    for (const CentreLine* line : {&clamped, &unclamped}) {
      CHECK(line->sound());
      CHECK(line->length() == Approx(length).epsilon(1e-7));
      CHECK((line->at(0) - bezier.front()).norm() < 1e-12);
      CHECK((line->at(line->length()) - bezier.back()).norm() < 1e-9);
    }
  }
}

TEST_CASE("places lie at their arc lengths") {
  const unsigned seed = 7;
  std::mt19937 random(seed);
  std::vector<Vec3> points;
  for (int k = 0; k < 9; ++k) points.push_back(random_point(random));
  const HarnessCurve curve{4, points, {}, {}};
  const CentreLine line = line_of(file_of(curve, points.front(), points.back(), 0));
  REQUIRE(line.reading() == KnotReading::clamped);
  const int pieces = 4000;
  double run = 0;
  for (int k = 0; k < pieces; ++k) run += (line.at(line.length() * (k + 1) / pieces) - line.at(line.length() * k / pieces)).norm();
  CHECK(run == Approx(line.length()).epsilon(1e-5));
  double before = -1;
  for (const CentreLine::Place& place : line.places(10)) {
    CHECK(place.s > before);
    CHECK((line.at(place.s) - place.at).norm() < 1e-9);
    before = place.s;
  }
}

TEST_CASE("a curve that goes on beyond the nodes is cut to the part of the stated length") {
  const double r = 100 * mm, whole = r * std::numbers::pi / 2;
  const auto on_arc = [&](double angle) { return Vec3(r * std::cos(angle), r * std::sin(angle), 0); };
  HarnessFile file = file_of(quarter(r), on_arc(0.4), on_arc(1.1), 0.7 * r);
  const CentreLine part = line_of(file);
  CHECK(part.sound());
  CHECK(part.length() == Approx(0.7 * r).epsilon(1e-9));
  CHECK(part.cut_off == Approx(whole - 0.7 * r).epsilon(1e-9));
  CHECK((part.at(0) - on_arc(0.4)).norm() < 1e-9);
  CHECK((part.at(0.3 * r) - on_arc(0.7)).norm() < 1e-9);

  file.segments[0].virtual_length = 0.5 * r;  // no part between the nodes is as long
  const CentreLine unsound = line_of(file);
  CHECK_FALSE(unsound.sound());
  CHECK(unsound.complaint().find("157.08 mm long, stated are 50 mm") != std::string::npos);
  CHECK(unsound.complaint().find("begins 39.7339 mm from its start node") != std::string::npos);
}

TEST_CASE("a segment without curves is straight between its nodes") {
  HarnessFile file = file_of({}, {0, 0, 0}, {0.3, 0.4, 0}, 0.5);
  file.segments[0].curves.clear();
  CHECK(line_of(file).sound());
  CHECK(line_of(file).length() == Approx(0.5));
  CHECK(std::isinf(line_of(file).min_bend_radius()));
  file.nodes[1].at = file.nodes[0].at;
  file.segments[0].virtual_length = 0;
  CHECK(line_of(file).complaint() == "its centre line has no length");
}

TEST_CASE("frames along a plane line do not turn about it; along a helix they do by its torsion") {
  const double r = 50 * mm;
  const LineFrames plane(line_of(file_of(quarter(r), {r, 0, 0}, {0, r, 0}, 0)));
  const double out = plane.start().d1().z();
  for (const double share : {0.2, 0.5, 0.8, 1.0}) CHECK(plane.at(share * plane.line().length()).d1().z() == Approx(out).margin(1e-9));
}

TEST_CASE("settled curves keep to the rod in either reading") {
  Equilibrium rod;
  const double r = 60 * mm;
  for (int k = 0; k <= 20; ++k) {
    const double angle = 0.1 * k;
    rod.s.push_back(r * angle);
    rod.points.push_back({r * std::sin(angle), 0, r * std::cos(angle)});
    rod.rotations.push_back(Frame::looking(Vec3::Zero(), {std::cos(angle), 0, -std::sin(angle)}, {0, 1, 0}).rotation);
  }
  for (const KnotReading reading : {KnotReading::clamped, KnotReading::unclamped}) {
    const std::vector<HarnessCurve> curves = settled_curves(rod, reading, 0.01 * mm);
    CHECK(curves.size() < 10);
    double length = 0, off = 0;
    Vec3 before = rod.points.front();
    for (const HarnessCurve& curve : curves) {
      const std::vector<SplineSpan> spans = spans_of(curve, reading);
      REQUIRE(spans.size() == 1);
      length += spans[0].length();
      CHECK((spans[0].values(0).at - before).norm() < 1e-12);
      before = spans[0].values(1).at;
      for (int k = 0; k <= 50; ++k) off = std::max(off, std::abs(spans[0].values(k / 50.0).at.norm() - r));
    }
    CHECK((before - rod.points.back()).norm() < 1e-12);
    CHECK(off < 0.012 * mm);
    CHECK(length == Approx(2 * r).margin(0.02 * mm));
  }
}
