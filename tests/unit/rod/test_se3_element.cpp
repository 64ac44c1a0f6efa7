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
  for (const double h : {0.1, 1.0})
    for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 0.3, 0.51, 0.53, 1.0, 2.0, 3.0, units::pi - 1e-2}) {
      const Case c = random_case(random, angle, h);
      CAPTURE(h, angle);
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
    const Case c = random_case(random, angle, 0.4);
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
  for (int i = 0; i < 4; ++i) {
    cases[i] = random_case(random, angles[i], 0.4);
    put(segment, cases[i].segment, i);
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
