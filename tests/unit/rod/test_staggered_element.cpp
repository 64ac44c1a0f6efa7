#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>
#include <random>

#include "base/units.h"
#include "rod/staggered_element.h"

using namespace tendril;

namespace {

using Vec6d = Eigen::Matrix<double, 6, 1>;
using Mat6d = Eigen::Matrix<double, 6, 6>;

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

/// Central differences of fourth order.
template <class F>
auto slope(const F& f, double h) -> decltype(f(h)) {
  return decltype(f(h))((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

const double angles[] = {0, 1e-9, 1e-5, 1e-2, 1, 3, units::pi - 1e-2, units::pi - 1e-3};

}  // namespace

TEST_CASE("stretch segment: gradient, second derivative and stress rates against finite differences") {
  std::mt19937 random(5);
  for (const double angle : angles) {
    StretchSegment segment{0.3, {3, 2, 5}, Vec3::UnitZ() + 0.1 * random_vector(random)};
    const Quat q = exp_rotation(angle * random_vector(random).normalized());
    const Vec3 way = 0.3 * (q * Vec3::UnitZ()) + 0.1 * random_vector(random);
    auto terms_at = [&](const Vec6d& x) {
      return segment.evaluate(way + x.head<3>(), q * exp_rotation(x.tail<3>()), nullptr);
    };
    const auto t = terms_at(Vec6d::Zero());
    Vec6d gradient;
    gradient << t.force, t.theta;
    Mat6d hessian;
    hessian << t.rr, t.rt, t.rt.transpose(), t.tt;
    CAPTURE(angle);
    for (int i = 0; i < 6; ++i) {
      const Vec6d unit = Vec6d::Unit(i);
      CHECK(gradient[i] == Approx(slope([&](double h) { return terms_at(h * unit).energy; }, 1e-3)).margin(1e-9));
      const Vec3 rate = i < 3 ? Vec3(t.rate_r.col(i)) : Vec3(t.rate_theta.col(i - 3));
      CHECK((rate - slope([&](double h) { return Vec3(segment.stress(terms_at(h * unit).strain)); }, 1e-3)).norm() < 1e-8);
      for (int j = 0; j < 6; ++j) {
        const Vec6d other = Vec6d::Unit(j);
        const double mixed = slope(
            [&](double a) { return slope([&](double b) { return terms_at(a * unit + b * other).energy; }, 3e-3); }, 3e-3);
        // Rotations about two axes do not commute: the mixed difference along one exponential is the symmetric part.
        CHECK(hessian(i, j) == Approx(mixed).margin(2e-6));
      }
    }
  }
}

TEST_CASE("bend cell: gradient, second derivative and moment rates against finite differences over angles") {
  std::mt19937 random(6);
  for (const double angle : angles) {
    const BendCell cell{0.4, {3, 2, 5}, 0.3 * random_vector(random)};
    const Quat a = exp_rotation(random_vector(random));
    const Quat b = a * exp_rotation(angle * random_vector(random).normalized());
    auto terms_at = [&](const Vec6d& x) {
      return cell.evaluate(a * exp_rotation(x.head<3>()), b * exp_rotation(x.tail<3>()), nullptr);
    };
    const auto t = terms_at(Vec6d::Zero());
    Vec6d gradient;
    gradient << t.theta_a, t.theta_b;
    Mat6d hessian;
    hessian << t.aa, t.ab, t.ab.transpose(), t.bb;
    const double scale = hessian.norm();
    const double h = angle > 3.13 ? 1e-4 : 1e-3;
    CAPTURE(angle);
    for (int i = 0; i < 6; ++i) {
      const Vec6d unit = Vec6d::Unit(i);
      CHECK(gradient[i] == Approx(slope([&](double x) { return terms_at(x * unit).energy; }, h)).margin(1e-8 * scale));
      const Vec3 rate = i < 3 ? Vec3(t.rate_a.col(i)) : Vec3(t.rate_b.col(i - 3));
      CHECK((rate - slope([&](double x) { return Vec3(cell.moment(terms_at(x * unit).curvature)); }, h)).norm() < 1e-7 * scale);
      for (int j = 0; j < 6; ++j) {
        const Vec6d other = Vec6d::Unit(j);
        const double mixed = slope(
            [&](double x) { return slope([&](double y) { return terms_at(x * unit + y * other).energy; }, h); }, h);
        CHECK(hessian(i, j) == Approx(mixed).margin((angle > 3.13 ? 1e-4 : 1e-5) * scale));
      }
    }
  }
}

TEST_CASE("staggered element: a given stress replaces the actual one in the geometric terms only") {
  std::mt19937 random(8);
  const BendCell cell{0.4, {3, 2, 5}, Vec3::Zero()};
  const Quat a = exp_rotation(random_vector(random)), b = a * exp_rotation(Vec3(0.3, -0.2, 0.5));
  const auto actual = cell.evaluate(a, b, nullptr);
  const Vec3 same = cell.moment(actual.curvature), none = Vec3::Zero();
  CHECK((cell.evaluate(a, b, &same).aa - actual.aa).norm() < 1e-15);
  const auto without = cell.evaluate(a, b, &none);
  CHECK(without.theta_a == actual.theta_a);
  // Without stress what is left is the material part: positive semidefinite.
  Mat6d hessian;
  hessian << without.aa, without.ab, without.ab.transpose(), without.bb;
  CHECK(Eigen::SelfAdjointEigenSolver<Mat6d>(hessian).eigenvalues().minCoeff() > -1e-12);
}
