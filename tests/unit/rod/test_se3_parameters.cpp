#include <catch2/catch.hpp>

#include <random>

#include "base/frame.h"
#include "base/units.h"
#include "rod/se3_parameters.h"

using namespace tendril;

namespace {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Vec13 = Eigen::Matrix<double, 13, 1>;

V3<double> v3(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Q4<double> q4(const Quat& q) { return {q.w(), {q.x(), q.y(), q.z()}}; }

struct Case {
  Se3Segment<double> segment;
  Frame a, b;
  bool fourth_order = true;
  Se3Ends<double> ends() const { return {q4(a.rotation), q4(b.rotation), v3(a.at), v3(b.at)}; }
};

Case random_case(std::mt19937& random, double angle, double h, bool preformed, bool fourth_order) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> stiffness(0.3, 5);
  auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  Case c;
  c.fourth_order = fourth_order;
  c.segment.h = h;
  c.segment.q = fourth_order ? h * h / 12 : 0;
  for (int i = 0; i < 3; ++i) c.segment.flexibility_v[i] = 1 / stiffness(random);
  for (int i = 0; i < 3; ++i) c.segment.flexibility_phi[i] = 1 / stiffness(random);
  c.segment.rate_v = v3(Vec3(Vec3::UnitZ() + (preformed ? 0.1 : 0.0) * vector()));
  c.segment.rate_phi = v3(Vec3((preformed ? 0.5 : 0.0) * vector()));
  c.segment.slope_phi = v3(vector() / h);
  c.segment.varies = preformed;
  c.a = {vector(), exp_rotation(vector())};
  c.b.rotation = c.a.rotation * exp_rotation(vector().normalized() * angle);
  c.b.at = c.a.at + c.a.rotation * (h * (Vec3::UnitZ() + 0.2 * vector()));
  return c;
}

Vec13 flat(const Se3Parameters<double>& p) {
  Vec13 x;
  x << p.h, p.flexibility_v.x, p.flexibility_v.y, p.flexibility_v.z, p.flexibility_phi.x, p.flexibility_phi.y,
      p.flexibility_phi.z, p.rate_v.x, p.rate_v.y, p.rate_v.z, p.rate_phi.x, p.rate_phi.y, p.rate_phi.z;
  return x;
}

Se3Parameters<double> parameters(const Vec13& x) {
  return {x[0], {x[1], x[2], x[3]}, {x[4], x[5], x[6]}, {x[7], x[8], x[9]}, {x[10], x[11], x[12]}};
}

Case changed(Case c, const Vec13& x) {
  const Se3Parameters<double> p = parameters(x);
  Se3Segment<double>& s = c.segment;
  s.slope_phi = (s.h / (s.h + p.h)) * (s.h / (s.h + p.h)) * s.slope_phi;  // the turn of the slope stays
  s.h += p.h;
  s.q = c.fourth_order ? s.h * s.h / 12 : 0;
  s.flexibility_v = s.flexibility_v + p.flexibility_v;
  s.flexibility_phi = s.flexibility_phi + p.flexibility_phi;
  s.rate_v = s.rate_v + p.rate_v;
  s.rate_phi = s.rate_phi + p.rate_phi;
  return c;
}

Case moved(Case c, const Vec9& x) {
  c.b.at += x.head<3>();
  c.a.rotation = c.a.rotation * exp_rotation(x.segment<3>(3));
  c.b.rotation = c.b.rotation * exp_rotation(x.tail<3>());
  return c;
}

Vec9 flat(const SegmentGradient<double>& g) {
  Vec9 x;
  x << g.force.x, g.force.y, g.force.z, g.theta_a.x, g.theta_a.y, g.theta_a.z, g.theta_b.x, g.theta_b.y, g.theta_b.z;
  return x;
}

Vec9 gradient_of(const Case& c) { return flat(se3_gradient<double>(c.segment, c.ends())); }
double energy_of(const Case& c) { return se3_gradient<double>(c.segment, c.ends()).energy; }

/// Central difference of the fourth order.
template <class F>
auto slope(F f, double step) {
  const auto near_plus = f(step), near_minus = f(-step), far_plus = f(2 * step), far_minus = f(-2 * step);
  return decltype(f(step))((8 * (near_plus - near_minus) - (far_plus - far_minus)) / (12 * step));
}

template <class Check>
void over_states(unsigned seed, Check check) {
  std::mt19937 random(seed);
  for (const double h : {0.1, 1.0})
    for (const bool preformed : {false, true})
      for (const bool fourth_order : {true, false})
        for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 0.3, 0.51, 0.53, 1.0, 2.0, 3.0, units::pi - 1e-2}) {
          const Case c = random_case(random, angle, h, preformed, fourth_order);
          CAPTURE(seed, h, preformed, fourth_order, angle);
          check(c, random);
        }
}

Vec9 random_step(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec9 x;
  for (double& value : x) value = normal(random);
  return x;
}

Se3Step<double> step_of(const Vec9& x) {
  return {v3(Vec3(x.head<3>())), v3(Vec3(x.segment<3>(3))), v3(Vec3(x.tail<3>()))};
}

}  // namespace

TEST_CASE("se3 parameters: derivatives of a step's work against finite differences", "[rod]") {
  over_states(101, [](const Case& c, std::mt19937& random) {
    const Vec9 step = random_step(random);
    const Vec13 exact = flat(Se3Slopes<double>(c.segment, c.ends()).of_work(step_of(step)));
    Vec13 numeric;
    for (int i = 0; i < 13; ++i)
      numeric[i] = slope([&](double t) { return step.dot(gradient_of(changed(c, Vec13::Unit(i) * t))); }, 1e-4 * c.segment.h);
    CHECK((exact - numeric).norm() < 1e-7 * (1 + numeric.norm()));
  });
}

TEST_CASE("se3 parameters: change of gradient, energy and wrench against finite differences", "[rod]") {
  over_states(102, [](const Case& c, std::mt19937&) {
    const Se3Slopes<double> slopes(c.segment, c.ends());
    for (int i = 0; i < 13; ++i) {
      CAPTURE(i);
      const SegmentGradient<double> exact = slopes.change_of_gradient(parameters(Vec13::Unit(i)));
      const double step = 1e-4 * c.segment.h;
      const Vec9 numeric = slope([&](double t) { return gradient_of(changed(c, Vec13::Unit(i) * t)); }, step);
      CHECK((flat(exact) - numeric).norm() < 1e-7 * (1 + numeric.norm()));
      CHECK(exact.energy == Approx(slope([&](double t) { return energy_of(changed(c, Vec13::Unit(i) * t)); }, step))
                                .epsilon(1e-7).margin(3e-8));
    }
  });
}

TEST_CASE("se3 parameters: both directions agree to rounding", "[rod]") {
  over_states(103, [](const Case& c, std::mt19937& random) {
    const Se3Slopes<double> slopes(c.segment, c.ends());
    const Vec9 step = random_step(random);
    const Vec13 by_parameter = flat(slopes.of_work(step_of(step)));
    for (int i = 0; i < 13; ++i) {
      const Vec9 change = flat(slopes.change_of_gradient(parameters(Vec13::Unit(i))));
      CHECK(std::abs(step.dot(change) - by_parameter[i]) < 1e-12 * (1 + step.norm() * change.norm()));
    }
  });
}

TEST_CASE("se3 parameters: a function of wrench and rate pulled back to ends and parameters", "[rod]") {
  over_states(104, [](const Case& c, std::mt19937& random) {
    const Vec9 x = random_step(random), y = random_step(random);
    const Wrench<double> by_wrench{v3(Vec3(x.head<3>())), v3(Vec3(x.tail<3>()))};
    const Wrench<double> by_rate{v3(Vec3(y.head<3>())), v3(Vec3(y.tail<3>()))};
    const auto value = [&](const Case& at) {
      const Se3Slopes<double> s(at.segment, at.ends());
      return dot(by_wrench.n, s.wrench().n) + dot(by_wrench.m, s.wrench().m) + dot(by_rate.n, s.rate().n) +
             dot(by_rate.m, s.rate().m);
    };
    SegmentGradient<double> ends;
    Se3Parameters<double> by_parameters;
    Se3Slopes<double>(c.segment, c.ends()).pull_back(by_wrench, by_rate, ends, by_parameters);
    Vec9 numeric_ends;
    Vec13 numeric;
    for (int i = 0; i < 9; ++i)
      numeric_ends[i] = slope([&](double t) { return value(moved(c, Vec9::Unit(i) * t)); }, 1e-4 * c.segment.h);
    for (int i = 0; i < 13; ++i)
      numeric[i] = slope([&](double t) { return value(changed(c, Vec13::Unit(i) * t)); }, 1e-4 * c.segment.h);
    CHECK((flat(ends) - numeric_ends).norm() < 1e-7 * (1 + numeric_ends.norm()));
    CHECK((flat(by_parameters) - numeric).norm() < 1e-7 * (1 + numeric.norm()));
  });
}

TEST_CASE("se3 parameters: four lanes give what one lane gives", "[rod]") {
  std::mt19937 random(105);
  const double angles[4] = {1e-9, 0.2, 1.3, 3.0};
  Se3Segment<Pack> segment{};
  Se3Ends<Pack> ends{};
  Se3Step<Pack> step{};
  auto put = [](auto& to, const auto& from, int i) {
    auto* target = reinterpret_cast<Pack*>(&to);
    const auto* source = reinterpret_cast<const double*>(&from);
    for (std::size_t k = 0; k < sizeof(from) / sizeof(double); ++k) lane(target[k], i) = source[k];
  };
  Vec13 single[4];
  for (int i = 0; i < 4; ++i) {
    const Case c = random_case(random, angles[i], 0.4, true, true);
    const Se3Step<double> one = step_of(random_step(random));
    lane(segment.h, i) = c.segment.h;
    lane(segment.q, i) = c.segment.q;
    put(segment.flexibility_v, c.segment.flexibility_v, i);
    put(segment.flexibility_phi, c.segment.flexibility_phi, i);
    put(segment.rate_v, c.segment.rate_v, i);
    put(segment.rate_phi, c.segment.rate_phi, i);
    put(segment.slope_phi, c.segment.slope_phi, i);
    segment.varies = c.segment.varies;
    put(ends, c.ends(), i);
    put(step, one, i);
    single[i] = flat(Se3Slopes<double>(c.segment, c.ends()).of_work(one));
  }
  const Se3Parameters<Pack> packed = Se3Slopes<Pack>(segment, ends).of_work(step);
  const auto* values = reinterpret_cast<const Pack*>(&packed);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 13; ++k) CHECK(lane(values[k], i) == Approx(single[i][k]).epsilon(1e-12).margin(1e-12));
}
