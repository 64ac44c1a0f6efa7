#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "statics/contact_points.h"

using namespace tendril;

namespace {

struct Vertices {
  std::vector<double> s, radii;
  std::vector<Vec3> points;
  std::vector<Quat> rotations;
  VertexShape shape() const { return {points, rotations}; }
};

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

/// Three segments whose vertices are turned by `angle` against each other.
Vertices bent_rod(double angle, std::mt19937& random) {
  Vertices v{{0, 0.1, 0.25, 0.3}, {0.05, 0.05, 0.02}, {}, {}};
  Quat q = exp_rotation(random_vector(random));
  for (int i = 0; i < 4; ++i) {
    v.points.push_back(Vec3(v.s[i], 0, 0) + 0.03 * random_vector(random));
    v.rotations.push_back(q);
    q = q * exp_rotation(angle * random_vector(random).normalized());
  }
  return v;
}

/// A smooth energy of a place with known derivatives.
struct Field {
  Vec3 a;
  double energy(const Vec3& x) const { return std::sin(a.dot(x)) + 0.5 * x.squaredNorm() * x.z(); }
  Vec3 gradient(const Vec3& x) const {
    return std::cos(a.dot(x)) * a + x * x.z() + Vec3(0, 0, 0.5 * x.squaredNorm());
  }
  Mat3 hessian(const Vec3& x) const {
    Mat3 h = -std::sin(a.dot(x)) * a * a.transpose() + x.z() * Mat3::Identity();
    h.col(2) += x;
    h.row(2) += x.transpose();
    return h;
  }
};

std::vector<Vec6> increments(int vertex, int entry, double amount) {
  std::vector<Vec6> step(4, Vec6::Zero());
  step[vertex][entry] = amount;
  return step;
}

void advance(Vertices& v, const std::vector<Vec6>& step) {
  for (int i = 0; i < 4; ++i) {
    v.points[i] += step[i].head<3>();
    v.rotations[i] = v.rotations[i] * exp_rotation(step[i].tail<3>());
  }
}

}  // namespace

TEST_CASE("contact points: every vertex, at most the radius apart, weights sum to the length") {
  const std::vector<double> s{0, 0.1, 0.25, 0.3}, radii{0.03, 0.05, 0.2};
  const auto points = contact_points(s, radii, Element::se3);
  double sum = 0;
  std::size_t vertex = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points[i].weight;
    if (vertex < s.size() && points[i].s == s[vertex]) ++vertex;
    if (i > 0) {
      CHECK(points[i].s > points[i - 1].s);
      CHECK(points[i].s - points[i - 1].s <= radii[points[i - 1].segment] * (1 + 1e-12));
    }
    CHECK(points[i].ra + points[i].rb == Approx(1));
  }
  CHECK(vertex == s.size());
  CHECK(sum == Approx(0.3));
  CHECK(points.size() == 4 + 3 + 1 + 1);
  CHECK(points[7].radius == 0.2);  // a vertex has the larger radius of its two segments
  // A thin long segment gets no more than its share of points.
  CHECK(contact_points(std::vector<double>{0, 1}, std::vector<double>{1e-6}, Element::se3).size() ==
        max_points_per_segment + 1);
}

TEST_CASE("contact points: arrays that do not match are refused") {
  CHECK_THROWS_WITH(contact_points(std::vector<double>{0, 1}, std::vector<double>{}, Element::se3),
                    "contact_points: got 2 vertices and 0 radii; expected one radius for each segment between vertices");
}

TEST_CASE("contact points: the cubic follows a circular arc to fourth order") {
  const double arc = 1.2;  // rad, radius 1
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const int n = 4 << k;
    std::vector<double> s;
    std::vector<Vec3> points;
    std::vector<Quat> rotations;
    for (int i = 0; i <= n; ++i) {
      const double a = arc * i / n;
      s.push_back(a);
      points.push_back({std::sin(a), 0, 1 - std::cos(a)});
      rotations.push_back(Frame::looking(Vec3::Zero(), {std::cos(a), 0, std::sin(a)}).rotation);
    }
    const std::vector<double> radii(n, 0.02);
    double worst = 0;
    for (const ContactPoint& p : contact_points(s, radii, Element::se3)) {
      const Vec3 exact(std::sin(p.s), 0, 1 - std::cos(p.s));
      worst = std::max(worst, (position_of(p, {points, rotations}) - exact).norm());
    }
    errors[k] = worst;
  }
  CHECK(errors[1] < 2e-6);
  CHECK(errors[0] / errors[1] == Approx(16).epsilon(0.1));
}

TEST_CASE("contact points: gradient and Hessian agree with finite differences at every angle") {
  std::mt19937 random(11);
  for (double angle : {0.0, 1e-9, 1e-5, 1e-2, 1.0, 4.0}) {
    for (Element element : {Element::se3, Element::staggered}) {
      const Vertices rod = bent_rod(angle, random);
      const Field field{random_vector(random)};
      for (int segment : {0, 1, 2}) {
        for (double xi : {0.0, 0.3, 0.5, 1.0}) {
          const ContactPoint p = contact_point_at(rod.s, rod.radii, element, segment, xi);
          const auto energy_of = [&](const std::vector<Vec6>& step) {
            Vertices moved = rod;
            advance(moved, step);
            return field.energy(position_of(p, moved.shape()));
          };
          const Vec3 x = position_of(p, rod.shape());
          BlockSystem system;
          system.resize(4);
          for (auto& b : system.gradient) b.setZero();
          for (auto& b : system.diagonal) b.setZero();
          for (auto& b : system.upper) b.setZero();
          const Vec3 g = field.gradient(x);
          add_point_energy(p, rod.shape(), g, field.hessian(x), g, system);

          const double e = 1e-4;
          for (int i = 0; i < 24; ++i) {
            const std::vector<Vec6> plus = increments(i / 6, i % 6, e), minus = increments(i / 6, i % 6, -e);
            const double slope = (energy_of(plus) - energy_of(minus)) / (2 * e);
            REQUIRE(std::abs(slope - system.gradient[i / 6][i % 6]) < 1e-7);
            // Displacement: the same derivative of the place itself.
            Vertices moved = rod;
            advance(moved, plus);
            const Vec3 forward = position_of(p, moved.shape());
            const Vec3 first = displacement_of(p, rod.shape(), plus);
            REQUIRE((forward - x - first).norm() < 1e-8);
            for (int j = 0; j < 24; ++j) {
              double expected = 0;
              if (i / 6 == j / 6) expected = system.diagonal[i / 6](i % 6, j % 6);
              if (j / 6 == i / 6 + 1) expected = system.upper[i / 6](i % 6, j % 6);
              if (i / 6 == j / 6 + 1) expected = system.upper[j / 6](j % 6, i % 6);
              std::vector<Vec6> pp = increments(i / 6, i % 6, e), pm = pp, mp = increments(i / 6, i % 6, -e), mm = mp;
              pp[j / 6][j % 6] += e;
              pm[j / 6][j % 6] -= e;
              mp[j / 6][j % 6] += e;
              mm[j / 6][j % 6] -= e;
              const double second = (energy_of(pp) - energy_of(pm) - energy_of(mp) + energy_of(mm)) / (4 * e * e);
              INFO("angle " << angle << " segment " << segment << " xi " << xi << " entry " << i << "," << j);
              REQUIRE(std::abs(second - expected) < 3e-6);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("contact points: positions after a share of a step are those of the moved rod") {
  std::mt19937 random(5);
  for (Element element : {Element::se3, Element::staggered}) {
    Vertices rod = bent_rod(0.7, random);
    std::vector<Vec6> step(4);
    for (Vec6& v : step) {
      v.head<3>() = random_vector(random);
      v.tail<3>() = random_vector(random);
    }
    const auto points = contact_points(rod.s, rod.radii, element);
    for (double share : {0.0, 0.4, 1.0}) {
      std::vector<Vec3> moved;
      moved_positions(points, rod.shape(), step, share, moved);
      Vertices other = rod;
      auto scaled = step;
      for (Vec6& v : scaled) v *= share;
      advance(other, scaled);
      REQUIRE(moved.size() == points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        CHECK((moved[i] - position_of(points[i], other.shape())).norm() < 1e-14);
    }
  }
}
