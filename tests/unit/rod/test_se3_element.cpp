#include <catch2/catch.hpp>

#include <random>

#include "base/frame.h"
#include "base/units.h"
#include "rod/se3_element.h"

using namespace tendril;

namespace {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

V3<double> v3(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec(const V3<double>& v) { return {v.x, v.y, v.z}; }
Q4<double> q4(const Quat& q) { return {q.w(), {q.x(), q.y(), q.z()}}; }
Mat3 mat(const M3<double>& m) { return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.e); }

struct Case {
  Se3Segment<double> segment;
  Frame a, b;
};

Case random_case(std::mt19937& random, double angle, double h) {
  std::normal_distribution<double> normal;
  auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  Case c;
  c.segment = {h, h * h / 12, {1 / 3.0, 1 / 2.0, 1 / 5.0}, {1 / 0.7, 1 / 0.4, 1 / 0.5},
               v3(Vec3::UnitZ() + 0.1 * vector()), v3(0.3 * vector())};
  c.segment.slope_phi = v3(vector() / h);
  c.a = {vector(), exp_rotation(vector())};
  c.b.rotation = c.a.rotation * exp_rotation(vector().normalized() * angle);
  c.b.at = c.a.at + c.a.rotation * (h * (Vec3::UnitZ() + 0.2 * vector()));
  return c;
}

SegmentGradient<double> gradient_at(const Case& c, const Vec9& x) {
  const Quat qa = c.a.rotation * exp_rotation(x.segment<3>(3)), qb = c.b.rotation * exp_rotation(x.tail<3>());
  return se3_gradient<double>(c.segment, {q4(qa), q4(qb), v3(c.a.at), v3(c.b.at + x.head<3>())});
}

double energy_at(const Case& c, const Vec9& x) { return gradient_at(c, x).energy; }

Vec9 flat(const SegmentGradient<double>& g) {
  Vec9 x;
  x << vec(g.force), vec(g.theta_a), vec(g.theta_b);
  return x;
}

Mat9 flat(const SegmentHessian<double>& h) {
  Mat9 m;
  m << mat(h.dd), mat(h.da), mat(h.db), mat(h.da).transpose(), mat(h.aa), mat(h.ab), mat(h.db).transpose(),
      mat(h.ab).transpose(), mat(h.bb);
  return m;
}

}  // namespace

TEST_CASE("se3 element: gradient and second derivative against finite differences over angles", "[rod]") {
  std::mt19937 random(7);
  const bool varies = GENERATE(false, true);
  for (const double h : {0.1, 1.0})
    for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 0.3, 0.51, 0.53, 1.0, 2.0, 3.0, units::pi - 1e-2}) {
      Case c = random_case(random, angle, h);
      c.segment.varies = varies;
      CAPTURE(h, angle, varies);
      SegmentHessian<double> hessian;
      WrenchRate<double> rate;
      const Se3Ends<double> ends{q4(c.a.rotation), q4(c.b.rotation), v3(c.a.at), v3(c.b.at)};
      const SegmentGradient<double> g = se3_element<double>(c.segment, ends, nullptr, hessian, rate);
      const Mat9 exact = flat(hessian);
      CHECK((exact - exact.transpose()).norm() < 1e-12 * exact.norm());
      const double step = 1e-5;
      Vec9 numeric;
      Mat9 numeric_hessian;
      for (int i = 0; i < 9; ++i) {
        const Vec9 dx = Vec9::Unit(i) * step;
        numeric[i] = (8 * (energy_at(c, dx) - energy_at(c, -dx)) - (energy_at(c, 2 * dx) - energy_at(c, -2 * dx))) / (12 * step);
        for (int j = 0; j < 9; ++j) {
          const Vec9 dy = Vec9::Unit(j) * 1e-3, di = Vec9::Unit(i) * 1e-3;
          if (i == j)
            numeric_hessian(i, i) = (-energy_at(c, 2 * di) + 16 * energy_at(c, di) - 30 * energy_at(c, Vec9::Zero()) +
                                     16 * energy_at(c, -di) - energy_at(c, -2 * di)) / 12e-6;
          else
            numeric_hessian(i, j) = ((energy_at(c, di + dy) + energy_at(c, -di - dy) - energy_at(c, di - dy) - energy_at(c, -di + dy)) / 4e-6 * 4 -
                                     (energy_at(c, 2 * (di + dy)) + energy_at(c, -2 * (di + dy)) - energy_at(c, 2 * (di - dy)) - energy_at(c, 2 * (dy - di))) / 16e-6) / 3;
        }
      }
      CHECK((flat(g) - numeric).norm() < 2e-9 * (1 + numeric.norm()));
      CHECK((exact - numeric_hessian).norm() < 3e-6 * exact.norm());
    }
}

TEST_CASE("se3 element: the wrench's rate of change is that of the true wrench", "[rod]") {
  std::mt19937 random(11);
  for (const double angle : {1e-9, 0.1, 1.0, 2.5}) {
    Case c = random_case(random, angle, 0.4);
    c.segment.varies = angle > 0.5;
    SegmentHessian<double> hessian;
    WrenchRate<double> rate;
    se3_element<double>(c.segment, {q4(c.a.rotation), q4(c.b.rotation), v3(c.a.at), v3(c.b.at)}, nullptr, hessian, rate);
    for (int i = 0; i < 9; ++i) {
      const Vec9 dx = Vec9::Unit(i) * 1e-5;
      const auto plus = gradient_at(c, dx).wrench, minus = gradient_at(c, -dx).wrench;
      const auto change = rate.change(v3(Vec3(dx.head<3>())), v3(Vec3(dx.segment<3>(3))), v3(Vec3(dx.tail<3>())));
      CHECK((vec(change.n) - 0.5 * (vec(plus.n) - vec(minus.n))).norm() < 1e-12);
      CHECK((vec(change.m) - 0.5 * (vec(plus.m) - vec(minus.m))).norm() < 1e-12);
    }
  }
}

TEST_CASE("se3 element: four lanes give what one lane gives", "[rod]") {
  std::mt19937 random(3);
  Case cases[4];
  const double angles[4] = {1e-9, 0.2, 1.3, 3.0};
  Se3Segment<Pack> segment{};
  Se3Ends<Pack> ends{};
  auto put = [](auto& to, const auto& from, int i) {
    auto* target = reinterpret_cast<Pack*>(&to);
    const auto* source = reinterpret_cast<const double*>(&from);
    for (std::size_t k = 0; k < sizeof(from) / sizeof(double); ++k) lane(target[k], i) = source[k];
  };
  auto put_segment = [&](const Se3Segment<double>& from, int i) {
    lane(segment.h, i) = from.h;
    lane(segment.q, i) = from.q;
    put(segment.flexibility_v, from.flexibility_v, i);
    put(segment.flexibility_phi, from.flexibility_phi, i);
    put(segment.rate_v, from.rate_v, i);
    put(segment.rate_phi, from.rate_phi, i);
    put(segment.slope_phi, from.slope_phi, i);
    segment.varies = true;
  };
  for (int i = 0; i < 4; ++i) {
    cases[i] = random_case(random, angles[i], 0.4);
    cases[i].segment.varies = true;
    put_segment(cases[i].segment, i);
    put(ends, Se3Ends<double>{q4(cases[i].a.rotation), q4(cases[i].b.rotation), v3(cases[i].a.at), v3(cases[i].b.at)}, i);
  }
  SegmentHessian<Pack> packed;
  WrenchRate<Pack> packed_rate;
  const SegmentGradient<Pack> g = se3_element<Pack>(segment, ends, nullptr, packed, packed_rate);
  for (int i = 0; i < 4; ++i) {
    SegmentHessian<double> hessian;
    WrenchRate<double> rate;
    const Se3Ends<double> one{q4(cases[i].a.rotation), q4(cases[i].b.rotation), v3(cases[i].a.at), v3(cases[i].b.at)};
    const SegmentGradient<double> single = se3_element<double>(cases[i].segment, one, nullptr, hessian, rate);
    CHECK(lane(g.energy, i) == Approx(single.energy).epsilon(1e-13));
    for (int k = 0; k < 9; ++k) CHECK(lane(packed.ab.e[k], i) == Approx(hessian.ab.e[k]).epsilon(1e-12).margin(1e-12));
  }
}

namespace {

/// A short piece of a rod whose reference curvature is bent + s twisted, under a constant wrench, integrated by fine steps.
struct Piece {
  Frame reference, end;   ///< seen from the start: without load, and under it
  Vec3 force;             ///< on the piece at its end, in the start's axes
  double energy = 0;
};

constexpr double flex_v[3] = {1 / 3.0, 1 / 2.0, 1 / 5.0}, flex_phi[3] = {1 / 0.7, 1 / 0.4, 1 / 0.5};

Piece integrated(double h, const Vec3& curvature, const Vec3& slope, const Vec3& n0, const Vec3& m0) {
  constexpr int steps = 400;
  const Vec3 kv(flex_v[0], flex_v[1], flex_v[2]), kp(flex_phi[0], flex_phi[1], flex_phi[2]);
  Piece piece;
  const double ds = h / steps;
  // n is constant in the start's axes and m falls by r x n: only the frames need integration, by midpoints of midpoints.
  auto rate_of = [&](double s, const Frame& at) {
    const Vec3 moment = at.rotation.conjugate() * Vec3(m0 - at.at.cross(n0)), force = at.rotation.conjugate() * n0;
    return std::pair<Vec3, Vec3>(Vec3::UnitZ() + force.cwiseProduct(kv), curvature + s * slope + moment.cwiseProduct(kp));
  };
  for (int i = 0; i < steps; ++i) {
    const double s = -0.5 * h + i * ds;
    auto moved = [](const Frame& from, const std::pair<Vec3, Vec3>& rate, double by) {
      const Quat half = exp_rotation(0.5 * by * rate.second);
      return Frame{from.at + by * (from.rotation * (half * rate.first)), (from.rotation * exp_rotation(by * rate.second)).normalized()};
    };
    const Frame middle = moved(piece.end, rate_of(s, piece.end), 0.5 * ds);
    const auto rate = rate_of(s + 0.5 * ds, middle);
    const Vec3 moment = rate.second - curvature - (s + 0.5 * ds) * slope, stretch = rate.first - Vec3::UnitZ();
    piece.energy += 0.5 * ds * (moment.cwiseAbs2().cwiseQuotient(kp).sum() + stretch.cwiseAbs2().cwiseQuotient(kv).sum());
    piece.end = moved(piece.end, rate, ds);
    piece.reference = moved(piece.reference, {Vec3::UnitZ(), curvature + (s + 0.5 * ds) * slope}, ds);
  }
  piece.force = n0;
  return piece;
}

struct Deviation {
  double energy, force;  ///< relative
};

Deviation deviation(double h, bool varies) {
  const Vec3 curvature(0.8, -0.5, 0.6), slope(1.5, 2, -1.2), n(0.3, -0.2, 0.25), m(0.2, 0.3, -0.15);
  const Piece piece = integrated(h, curvature, slope, n, m);
  Se3Segment<double> s{h, h * h / 12, {flex_v[0], flex_v[1], flex_v[2]}, {flex_phi[0], flex_phi[1], flex_phi[2]}, {}, {}};
  JacobianCoefficients<double> k;
  const V3<double> phi = rotation_log<double>(q4(piece.reference.rotation), k);
  const V3<double> v = inverse_left_jacobian(phi, k.c) * v3(piece.reference.at);
  s.rate_v = (1 / h) * v;
  s.rate_phi = (1 / h) * phi;
  s.slope_phi = v3(slope);
  s.varies = varies;
  const auto g = se3_gradient<double>(s, {q4(Quat::Identity()), q4(piece.end.rotation), v3(Vec3::Zero()), v3(piece.end.at)});
  return {std::abs(g.energy - piece.energy) / piece.energy, (vec(g.force) - piece.force).norm() / piece.force.norm()};
}

}  // namespace

TEST_CASE("se3 element: a reference curvature that varies along the segment keeps the fourth order", "[rod]") {
  for (const double h : {0.4, 0.2}) {
    CAPTURE(h);
    const Deviation here = deviation(h, true), half = deviation(0.5 * h, true);
    CAPTURE(here.energy, half.energy, here.force, half.force);
    CHECK(std::log2(here.energy / half.energy) > 3.6);
    CHECK(std::log2(here.force / half.force) > 3.6);
    // Without it: two orders less.
    const Deviation plain = deviation(h, false), plain_half = deviation(0.5 * h, false);
    CHECK(std::log2(plain.force / plain_half.force) < 2.5);
    CHECK(plain.force > 10 * here.force);
  }
}
