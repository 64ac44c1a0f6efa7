#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "base/units.h"
#include "method/route/state_lattice.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

double turn_between(const Vec3& a, const Vec3& b) { return 2 * std::atan2((a - b).norm(), (a + b).norm()); }

}  // namespace

TEST_CASE("biarc: a straight, a quarter circle and an S of two quarter circles", "[route]") {
  const auto straight = biarc({0, 0, 0}, {1, 0, 0}, {0.3, 0, 0}, {1, 0, 0});
  REQUIRE(straight);
  CHECK(straight->length == Approx(0.3).epsilon(1e-14));
  CHECK(std::isinf(straight->smallest_radius()));
  CHECK((straight->at(0.25, {0, 0, 0}, {1, 0, 0}) - Vec3(0.075, 0, 0)).norm() < 1e-15);

  const auto quarter = biarc({0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0});
  REQUIRE(quarter);
  CHECK(quarter->length == Approx(0.1 * units::pi).epsilon(1e-12));
  CHECK(quarter->radii[0] == Approx(0.2).epsilon(1e-12));
  CHECK(quarter->radii[1] == Approx(0.2).epsilon(1e-12));
  for (const double share : {0.0, 0.1, 0.5, 0.8, 1.0})
    CHECK((quarter->at(share, {0, 0, 0}, {1, 0, 0}) - Vec3(0, 0.2, 0)).norm() == Approx(0.2).epsilon(1e-12));

  const auto s_bend = biarc({0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {1, 0, 0});
  REQUIRE(s_bend);
  CHECK(s_bend->length == Approx(0.1 * units::pi).epsilon(1e-12));
  CHECK((s_bend->at(0.5, {0, 0, 0}, {1, 0, 0}) - Vec3(0.1, 0.1, 0)).norm() < 1e-14);
}

TEST_CASE("biarc: what cannot be", "[route]") {
  CHECK_FALSE(biarc({0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}));
  CHECK_FALSE(biarc({0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}));  // straight back
}

TEST_CASE("biarc: meets both ends and tangents, smoothly, with its own length", "[route]") {
  const unsigned seed = 5;
  CAPTURE(seed);
  std::mt19937 random(seed);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 start = random_unit(random), along = random_unit(random);
    // A sweep of angles between the tangents that includes none at all.
    const double angles[] = {0, 1e-9, 1e-5, 1e-2, 0.5, 1.5, 2.5};
    Vec3 axis = along.cross(random_unit(random)).normalized();
    const Vec3 finish_along = Eigen::AngleAxisd(angles[i % 7], axis) * along;
    const Vec3 finish = start + 0.2 * along + 0.15 * random_unit(random);
    const auto arcs = biarc(start, along, finish, finish_along);
    if (!arcs) continue;
    ++found;
    CHECK((arcs->at(0, start, along) - start).norm() < 1e-12);
    CHECK((arcs->at(1, start, along) - finish).norm() < 1e-9);
    const double h = 1e-6;
    const auto tangent = [&](double a, double b) -> Vec3 { return (arcs->at(b, start, along) - arcs->at(a, start, along)).normalized(); };
    CHECK((tangent(0, h) - along).norm() < 1e-4);
    CHECK((tangent(1 - h, 1) - finish_along).norm() < 1e-4);
    double length = 0;
    for (int k = 0; k < 2000; ++k) length += (arcs->at((k + 1) / 2000.0, start, along) - arcs->at(k / 2000.0, start, along)).norm();
    CHECK(length == Approx(arcs->length).epsilon(1e-5));
    for (int k = 0; k < 2; ++k)
      if (arcs->turns[k] > 1e-9) CHECK(arcs->radii[k] * std::tan(0.5 * arcs->turns[k]) == Approx(arcs->tangent).epsilon(1e-12));
  }
  CHECK(found > 200);
}

TEST_CASE("directions: unit, different, in opposite pairs", "[route]") {
  const std::pair<int, std::size_t> counts[] = {{0, 12}, {1, 42}, {2, 162}};
  for (const auto& [times, count] : counts) {
    const std::vector<Vec3> directions = geodesic_directions(times);
    REQUIRE(directions.size() == count);
    for (const Vec3& d : directions) {
      CHECK(d.norm() == Approx(1).epsilon(1e-15));
      int same = 0, opposite = 0;
      for (const Vec3& e : directions) {
        same += (d - e).norm() < 1e-9;
        opposite += (d + e).norm() < 1e-9;
      }
      CHECK(same == 1);
      CHECK(opposite == 1);
    }
  }
}

TEST_CASE("state lattice: primitives end on the grid, in their direction, and bend no more than they may", "[route]") {
  for (const double radius : {0.02, 0.05, 0.2}) {
    CAPTURE(radius);
    const StateLattice lattice(0.02, radius, 0.01);
    for (int from = 0; from < 42; ++from) {
      REQUIRE(lattice.from(from).size() >= 6);  // on, and to each of its neighbours
      for (const Primitive& p : lattice.from(from)) {
        const Vec3 end = 0.02 * Vec3(p.offset[0], p.offset[1], p.offset[2]);
        CHECK((p.samples.back() - end).norm() < 1e-12);
        CHECK(p.length >= end.norm() - 1e-12);
        CHECK(p.length <= lattice.longest() + 1e-12);
        Vec3 last = Vec3::Zero();
        for (const Vec3& sample : p.samples) {
          CHECK((sample - last).norm() <= 0.01 + 1e-12);
          last = sample;
        }
        const auto arcs = biarc(Vec3::Zero(), lattice.directions()[from], end, lattice.directions()[p.to]);
        REQUIRE(arcs);
        CHECK(arcs->smallest_radius() >= radius * (1 - 1e-9));
        CHECK(turn_between(lattice.directions()[from], lattice.directions()[p.to]) * radius <= p.length * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("state lattice: every primitive has its mirror image", "[route]") {
  // The directions come in opposite pairs, and so must what joins them: backwards along a primitive is a primitive of the
  // opposite directions with the same length. Choices between equals may differ, so lengths are compared and not offsets.
  const StateLattice lattice(0.02, 0.05, 0.01);
  const auto opposite = [&](int d) {
    for (int e = 0; e < 42; ++e)
      if ((lattice.directions()[d] + lattice.directions()[e]).norm() < 1e-9) return e;
    return -1;
  };
  const auto shortest = [&](int from, int to) {
    double length = std::numeric_limits<double>::infinity();
    for (const Primitive& p : lattice.from(from))
      if (p.to == to) length = std::min(length, p.length);
    return length;
  };
  for (int from = 0; from < 42; ++from)
    for (int to = 0; to < 42; ++to) {
      const double there = shortest(from, to), back = shortest(opposite(to), opposite(from));
      if (std::isinf(there)) CHECK(std::isinf(back));
      else CHECK(there == Approx(back).epsilon(1e-9));
    }
}

TEST_CASE("state lattice: a grid far too fine for the bend radius is refused", "[route]") {
  CHECK_THROWS_WITH(StateLattice(0.001, 0.5, 0.01), Catch::Matchers::Contains("too small for a bend radius of 0.5 m"));
}
