#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/units.h"
#include "geometry/curve.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::Random;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// What holds for every curve: unit speed, tangents along the way, frames that do not turn about the tangent, curvature
// as the derivative of the tangent, ends where they belong.
void check_curve(const Curve& curve, double frame_tolerance) {
  const double length = curve.length(), h = 1e-5 * length;
  CHECK((curve.at(0).at - curve.points().front()).norm() < 1e-12 * length);
  CHECK((curve.at(length).at - curve.points().back()).norm() < 1e-9 * length);
  for (int i = 1; i < 400; ++i) {
    const double s = length * (i + 0.4) / 401;
    bool near_break = false;
    for (double b : curve.breaks()) near_break |= std::abs(b - s) < 2 * h;
    if (near_break) continue;
    const Frame before = curve.at(s - h), here = curve.at(s), after = curve.at(s + h);
    CHECK(here.rotation.norm() == Approx(1));
    CHECK(((after.at - before.at) / (2 * h) - here.d3()).norm() < 1e-4);
    const Vec3 bend = (after.d3() - before.d3()) / (2 * h);
    CHECK((bend - curve.curvature(s)).norm() < 1e-4 * (1 / length + bend.norm()) + 1e-9 / h);
    const double twist = (after.d1() - before.d1()).dot(here.d2()) / (2 * h);
    CHECK(std::abs(twist) * length < frame_tolerance);
    CHECK(curve.bend_radius(s) >= curve.min_bend_radius() * (1 - 1e-9));
  }
}

}  // namespace

TEST_CASE("a polyline: length, places, corners", "[curve]") {
  const Curve curve = Curve::polyline({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {3, 9, 0}, {3, 9, 2}});
  CHECK(curve.length() == Approx(14));
  CHECK(curve.at(5).at.isApprox(Vec3(3, 2, 0)));
  CHECK(curve.at(5).d3().isApprox(Vec3::UnitY()));
  CHECK(curve.at(3).d3().isApprox(Vec3::UnitY()));
  CHECK(curve.breaks() == std::vector<double>{3, 12});  // (3, 4, 0) lies on a line
  CHECK(curve.min_bend_radius() == 0);
  CHECK(curve.min_bend_radius_at() == Approx(3));
  CHECK(curve.bend_radius(4) == infinity);
  const Curve line = Curve::polyline({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}});
  CHECK(line.min_bend_radius() == infinity);
  CHECK(line.breaks().empty());
  CHECK(std::string(line.kind()) == "polyline");
  // The frame turns at a corner by no more than the tangent does.
  const Quat turn = curve.at(3.1).rotation * curve.at(2.9).rotation.conjugate();
  CHECK(log_rotation(turn).isApprox(Vec3(0, 0, units::pi / 2)));
  const auto samples = curve.sampled(1);
  CHECK(samples.size() == 15);
  CHECK(samples[4].isApprox(Vec3(3, 1, 0)));
  check_curve(curve, 1e-6);
}

TEST_CASE("constant curvature: a square corner rounded", "[curve]") {
  const double r = 0.25;
  const Curve curve = Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, r);
  CHECK(curve.length() == Approx(2 - 2 * r + r * units::pi / 2).epsilon(1e-14));
  CHECK(curve.min_bend_radius() == Approx(r));
  CHECK(curve.min_bend_radius_at() == Approx(0.75));
  REQUIRE(curve.breaks().size() == 2);
  CHECK(curve.breaks()[0] == Approx(0.75));
  CHECK(curve.breaks()[1] == Approx(0.75 + r * units::pi / 2));
  const double middle = 0.5 * curve.length();
  CHECK(curve.at(middle).at.isApprox(Vec3(0.75 + r * std::sqrt(0.5), 0.25 - r * std::sqrt(0.5), 0)));
  CHECK(curve.at(middle).d3().isApprox(Vec3(1, 1, 0).normalized()));
  CHECK(curve.curvature(middle).isApprox(Vec3(-1, 1, 0).normalized() / r));
  CHECK(curve.bend_radius(0.1) == infinity);
  check_curve(curve, 1e-6);
}

TEST_CASE("constant curvature: bends that use up their straights, without a bend, and in space", "[curve]") {
  // Two quarter turns of radius 1 meet in the middle: half a circle.
  const Curve half = Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}, 1);
  CHECK(half.length() == Approx(units::pi));
  CHECK(half.breaks().empty());
  CHECK(half.at(units::pi / 2).at.isApprox(Vec3(1, 1, 0)));
  check_curve(half, 1e-6);
  const Curve straight = Curve::pcc({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 100);
  CHECK(straight.length() == Approx(2));
  CHECK(straight.min_bend_radius() == infinity);
  Random random(7);
  for (int n = 0; n < 20; ++n) {
    std::vector<Vec3> points{random.point(1)};
    std::vector<double> radii;
    Vec3 way = random.direction();
    for (int i = 0; i < 8; ++i) {
      points.push_back(points.back() + random.in(0.5, 1) * way);
      way = (way + 0.9 * random.direction()).normalized();
      radii.push_back(random.in(0.05, 0.12));
    }
    radii.pop_back();
    const Curve curve = Curve::pcc(points, radii);
    check_curve(curve, 1e-6);
    CHECK(curve.min_bend_radius() >= 0.05);
    CHECK(curve.breaks().size() == 14);
  }
}

TEST_CASE("constant curvature: a bend that does not fit is named", "[curve]") {
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 0.2, 0}}, 0.25),
                    "curve.pcc: the bend at point 2 does not fit: a radius of 0.25 m and a turn of 90 degrees take 0.25 m of "
                    "the straight between points 2 and 3, of which 0.2 m are free; a radius of at most 0.2 m fits");
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 0.4, 0}, {2, 0.4, 0}}, {0.1, 0.35}),
                    Catch::Contains("the bend at point 3 does not fit") && Catch::Contains("of which 0.3 m are free"));
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 0.25),
                    Catch::Contains("the bend at point 2 does not fit") && Catch::Contains("180 degrees"));
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 0),
                    "curve.pcc: the radius at point 2 is 0; a finite length above 0 expected (m)");
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, std::vector<double>{1, 2}),
                    "curve.pcc: 2 radii for 3 points; one for each inner point expected");
}

TEST_CASE("a spline through points of a circle, a helix and at random", "[curve]") {
  std::vector<Vec3> circle;
  const double radius = 0.4;
  for (int i = 0; i <= 64; ++i) {
    const double a = units::pi * i / 64;
    circle.push_back(radius * Vec3(std::cos(a), std::sin(a), 0));
  }
  const Curve arc = Curve::spline(circle, {Vec3(0, 3, 0), Vec3(0, -1, 0)});
  CHECK(arc.length() == Approx(units::pi * radius).epsilon(1e-7));
  CHECK(arc.min_bend_radius() == Approx(radius).epsilon(2e-3));
  CHECK(arc.at(arc.length() / 2).at.isApprox(Vec3(0, radius, 0), 1e-7));
  CHECK(arc.breaks().empty());
  check_curve(arc, 1e-5);
  Random random(13);
  for (int n = 0; n < 10; ++n) {
    std::vector<Vec3> points;
    for (int i = 0; i < 7; ++i) points.push_back(Vec3(i, 0, 0) + random.point(0.6));
    const Curve curve = Curve::spline(points);
    check_curve(curve, 1e-3);
    for (const Vec3& p : points) {
      double nearest = 9;
      for (const Vec3& q : curve.sampled(1e-3)) nearest = std::min(nearest, (p - q).norm());
      CHECK(nearest < 6e-4);
    }
    CHECK(curve.bend_radius(0) > 1e6);
    CHECK(curve.bend_radius(curve.length()) > 1e6);
    CHECK(curve.bend_radius(curve.min_bend_radius_at()) == Approx(curve.min_bend_radius()).epsilon(1e-9));
  }
}

TEST_CASE("frames of a spline do not flip where its points are straight but for rounding", "[curve]") {
  for (int seed = 0; seed < 50; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<> noise(-1, 1);
    std::vector<Vec3> points;
    for (int i = 0; i <= 160; ++i) points.push_back({-0.2 + 0.4 * i / 160, 1e-17 * noise(random), 1e-17 * noise(random)});
    const Curve curve = Curve::spline(points, {Vec3(1, 0, 0), Vec3(1, 0, 0)});
    for (int i = 0; i <= 500; ++i) CHECK((curve.at(curve.length() * i / 500.0).d1() - Vec3(0, 0, 1)).norm() < 1e-9);
  }
}

TEST_CASE("the arc length of a spline is good to 1e-9", "[curve]") {
  // A plane curve with the ends' directions given; its length by a fine sum of chords, extrapolated.
  const Curve curve = Curve::spline({{0, 0, 0}, {1, 0.8, 0.2}, {1.5, -0.4, 0.5}, {2.5, 0.1, 0}}, {Vec3(1, 0, 0), {}});
  const auto chords = [&](int n) {
    double sum = 0;
    Vec3 last = curve.at(0).at;
    for (int i = 1; i <= n; ++i) {
      const Vec3 now = curve.at(curve.length() * i / n).at;
      sum += (now - last).norm();
      last = now;
    }
    return sum;
  };
  const double coarse = chords(2000), fine = chords(4000);
  CHECK(fine + (fine - coarse) / 3 == Approx(curve.length()).epsilon(1e-9));
  // And equal steps of arc length are equal ways, all along.
  const double quarter = curve.length() / 4000;
  for (int i = 0; i < 4000; i += 37) {
    const double chord = (curve.at((i + 1) * quarter).at - curve.at(i * quarter).at).norm();
    const double kappa = curve.curvature((i + 0.5) * quarter).norm();
    CHECK(chord == Approx(quarter * (1 - std::pow(kappa * quarter, 2) / 24)).epsilon(1e-8));
  }
}

TEST_CASE("frames of a helix turn back against the torsion", "[curve]") {
  // A rotation-minimising frame turns against the normal of the helix by the torsion times the length.
  const double a = 0.3, b = 0.1, speed = std::hypot(a, b), torsion = b / (speed * speed);
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) {
    const double t = 4 * units::pi * i / 400;
    points.push_back({a * std::cos(t), a * std::sin(t), b * t});
  }
  const Curve curve = Curve::spline(points, {Vec3(0, a, b), Vec3(0, a, b)});
  CHECK(curve.length() == Approx(4 * units::pi * speed).epsilon(1e-8));
  const auto angle = [&](double s) {
    const Frame frame = curve.at(s);
    const Vec3 normal = curve.curvature(s).normalized();
    return std::atan2(normal.dot(frame.d2()), normal.dot(frame.d1()));
  };
  const double s0 = 0.5, s1 = 3.0;
  const double turned = std::remainder(angle(s1) - angle(s0) - torsion * (s1 - s0), 2 * units::pi);
  CHECK(std::abs(turned) < 1e-3);
}

TEST_CASE("curves refuse what cannot be", "[curve]") {
  CHECK_THROWS_WITH(Curve::polyline({}), "curve.polyline: 0 points; at least 2 expected");
  CHECK_THROWS_WITH(Curve::spline({{0, 0, 0}}), "curve.spline: 1 point; at least 2 expected");
  CHECK_THROWS_WITH(Curve::polyline({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}),
                    "curve.polyline: points 2 and 3 are in one place, (1 0 0)");
  CHECK_THROWS_WITH(Curve::pcc({{0, 0, 0}, {std::nan(""), 0, 0}}, 1), Catch::StartsWith("curve.pcc: point 2 is ("));
  CHECK_THROWS_WITH(Curve::spline({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), Catch::Contains("turns back on itself"));
  CHECK_THROWS_WITH(Curve::spline({{0, 0, 0}, {1, 0, 0}}, {Vec3(0, 0, 0), {}}),
                    "curve.spline: the direction at the start is not a finite vector other than zero");
  const Curve line = Curve::polyline({{0, 0, 0}, {1, 0, 0}});
  CHECK_THROWS_WITH(line.at(1.5), "curve.polyline: arc length 1.5 m is outside 0 ... 1 m");
  CHECK_THROWS_AS(line.at(-1e-6), UsageError);
  CHECK_THROWS_AS(line.at(std::nan("")), UsageError);
  CHECK_NOTHROW(line.at(1 + 1e-12));
  CHECK_THROWS_AS(line.sampled(0), UsageError);
  CHECK_THROWS_AS(line.sampled(1e-12), UsageError);
  const Curve spline = Curve::spline({{0, 0, 0}, {2, 0, 0}});
  CHECK(spline.length() == Approx(2));
  CHECK(spline.min_bend_radius() == infinity);
}

TEST_CASE("a helix: closed forms, frames with a constant curvature and torsion, either hand", "[curve]") {
  const double radius = 0.03, pitch = 0.02, turns = 2.5, rise = pitch / (2 * units::pi);
  const double around = radius * radius + rise * rise;
  for (const bool left : {false, true}) {
    CAPTURE(left);
    const Curve curve = Curve::helix(radius, pitch, turns, left);
    CHECK(curve.length() == Approx(2 * units::pi * turns * std::sqrt(around)));
    CHECK(curve.at(0).at.isApprox(Vec3(radius, 0, 0)));
    CHECK(curve.at(curve.length()).at.isApprox(Vec3(-radius, 0, pitch * turns)));
    CHECK(curve.points().size() == 2);
    CHECK(curve.points().back().isApprox(curve.at(curve.length()).at));
    CHECK(curve.min_bend_radius() == Approx(around / radius));
    CHECK(curve.at(1e-3).at.y() * (left ? -1 : 1) > 0);
    CHECK(curve.breaks().empty());
    CHECK(std::string(curve.kind()) == "helix");
    const double h = 1e-6;
    for (const double s : {0.01, 0.1, 0.3}) {
      const Frame here = curve.at(s), before = curve.at(s - h), after = curve.at(s + h);
      CHECK(((after.at - before.at) / (2 * h)).isApprox(here.d3(), 1e-7));
      CHECK(((after.d3() - before.d3()) / (2 * h)).isApprox(curve.curvature(s), 1e-6));
      CHECK(here.d1().isApprox(-Vec3(here.at.x(), here.at.y(), 0).normalized(), 1e-9));
      // Curvature about d2 towards the axis, torsion about d3: the same at every place.
      const Vec3 rates = log_rotation(before.rotation.conjugate() * after.rotation) / (2 * h);
      CHECK((rates - Vec3(0, radius / around, (left ? -1 : 1) * rise / around)).norm() < 1e-5);
    }
  }
  CHECK(Curve::helix(1, 0, 1).length() == Approx(2 * units::pi));  // a circle
  CHECK(Curve::helix(1, -1, 1).at(0.1).at.z() < 0);
  CHECK_THROWS_WITH(Curve::helix(0, 1, 1), "curve.helix: 'radius' is 0; a finite number above 0 expected");
  CHECK_THROWS_WITH(Curve::helix(1, infinity, 1), Catch::Matchers::Contains("'pitch' is inf; a finite number expected"));
  CHECK_THROWS_WITH(Curve::helix(1, 1, -2), Catch::Matchers::Contains("'turns' is -2"));
  CHECK_THROWS_WITH(Curve::helix(1e300, 1, 1e300), Catch::Matchers::Contains("longer than a number can tell"));
}
