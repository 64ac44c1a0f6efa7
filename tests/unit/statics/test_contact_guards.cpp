#include <catch2/catch.hpp>

#include <random>

#include "statics/contact_guards.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

/// A straight rod along x of `segments` segments at the height z, and its guard.
struct Guarded {
  std::vector<double> s, radii;
  std::vector<Vec3> points;
  std::vector<Quat> rotations;
  ContactSet set;
  ContactGuard guard;

  Guarded(const ContactField& field, double z, int segments = 4, Element element = Element::se3)
      : s(make_s(segments)),
        radii(segments, 0.02),
        set(field, contact_points(s, radii, element), 1),
        guard(set) {
    for (double at : s) {
      points.push_back({at, 0, z});
      rotations.push_back(Frame::looking(Vec3::Zero(), Vec3::UnitX()).rotation);
    }
    stand();
    guard.start();
  }
  static std::vector<double> make_s(int segments) {
    std::vector<double> s;
    for (int i = 0; i <= segments; ++i) s.push_back(0.1 * i);
    return s;
  }
  VertexShape shape() const { return {points, rotations}; }
  void stand() {
    std::vector<Vec3> x;
    moved_positions(set.points(), shape(), std::vector<Vec6>(points.size(), Vec6::Zero()), 0, x);
    set.evaluate(x);
  }
  void take(const std::vector<Vec6>& step, double share) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += share * step[i].head<3>();
      rotations[i] = rotations[i] * exp_rotation(share * step[i].tail<3>());
    }
    stand();
    guard.accept();
  }
  std::vector<Vec6> shifted(const Vec3& by) const {
    Vec6 v = Vec6::Zero();
    v.head<3>() = by;
    return std::vector<Vec6>(points.size(), v);
  }
};

TriangleSheet flat_sheet(double half_width) {
  return grid_sheet(3, 3, [&](double u, double v) {
    return Vec3(0.2 + half_width * (2 * u - 1), half_width * (2 * v - 1), 0);
  });
}

}  // namespace

TEST_CASE("guards: a step in the open is taken whole without a ray") {
  const TriangleSheet sheet = flat_sheet(0.5);
  Guarded rod(sheet, 0.3);
  const GuardedStep step = rod.guard.admit(rod.shape(), rod.shifted({0, 0, -0.04}));
  CHECK(step.share == 1);
  CHECK(step.blockades.empty());
  CHECK(rod.guard.rays() == 0);
}

TEST_CASE("guards: a step through a thin sheet stops half a radius above it") {
  const TriangleSheet sheet = flat_sheet(0.5);
  Guarded rod(sheet, 0.3);
  const GuardedStep step = rod.guard.admit(rod.shape(), rod.shifted({0, 0, -1.0}));
  CHECK(step.share == Approx(0.29));
  CHECK(static_cast<int>(step.blockades.size()) == rod.set.size());
  CHECK(step.blockades.front().normal.z() == Approx(1));
  CHECK(step.blockades.front().plane == Approx(0).margin(1e-12));
}

TEST_CASE("guards: close to the sheet half the height is kept") {
  const TriangleSheet sheet = flat_sheet(0.5);
  Guarded rod(sheet, 0.01);
  const GuardedStep step = rod.guard.admit(rod.shape(), rod.shifted({0, 0, -1.0}));
  CHECK(step.share == Approx(0.005));
  const GuardedStep away = rod.guard.admit(rod.shape(), rod.shifted({0, 0, 1.0}));
  CHECK(away.share == 1);
  const GuardedStep along = rod.guard.admit(rod.shape(), rod.shifted({0.1, 0, 0}));
  CHECK(along.share == 1);
}

TEST_CASE("guards: an edge does not slip between two points") {
  // A blade between two neighbouring contact points (0.02 apart) of the rod, standing up from below to z = 0.
  const TriangleSheet blade = grid_sheet(1, 1, [](double u, double v) { return Vec3(0.21, u - 0.5, -0.3 * v); });
  Guarded rod(blade, 0.03);
  const GuardedStep step = rod.guard.admit(rod.shape(), rod.shifted({0, 0, -0.05}));
  CHECK(step.share < 0.6);
  CHECK(step.share > 0.1);
  CHECK(step.blockades.empty());  // no point itself meets the blade
  rod.take(rod.shifted({0, 0, -0.05}), step.share);
  CHECK(rod.guard.crossings().empty());
}

TEST_CASE("guards: a crossing at the start is reported and does not block the way out") {
  const TriangleSheet blade = grid_sheet(1, 1, [](double u, double v) { return Vec3(0.21, u - 0.5, -0.3 * v); });
  Guarded rod(blade, -0.01);
  REQUIRE(rod.guard.crossings().size() == 1);
  const int where = rod.guard.crossings().front();
  CHECK(rod.set.points()[where].s < 0.21);
  CHECK(rod.set.points()[where + 1].s > 0.21);
  const auto up = rod.shifted({0, 0, 0.05});
  CHECK(rod.guard.admit(rod.shape(), up).share == 1);
  rod.take(up, 1);
  CHECK(rod.guard.crossings().empty());
  // Once free it is guarded like any other place.
  CHECK(rod.guard.admit(rod.shape(), rod.shifted({0, 0, -0.05})).share < 1);
}

TEST_CASE("guards: the way out of a closed solid is free, the way in is not") {
  const Ball ball({0.2, 0, 0}, 0.05);
  Guarded inside(ball, 0.0);
  CHECK(inside.guard.admit(inside.shape(), inside.shifted({0, 0, 0.2})).share == 1);
  Guarded above(ball, 0.2);
  CHECK(above.guard.admit(above.shape(), above.shifted({0, 0, -0.2})).share < 0.75);
}

TEST_CASE("guards: turning the sections counts as motion") {
  // Turning the two end sections of one long segment sags its middle by 0.1 h |theta| without moving a vertex.
  const TriangleSheet sheet = flat_sheet(2);
  Guarded rod(sheet, 0.03, 1);
  rod.points[1] = {1.0, 0, 0.03};
  Guarded longer(sheet, 0.03, 1);
  longer.s = {0, 1.0};
  longer.set = ContactSet(sheet, contact_points(longer.s, longer.radii, Element::se3), 1);
  longer.points[1] = {1.0, 0, 0.03};
  longer.stand();
  longer.guard.start();
  // Directors of looking(+x): find the section axis that dips the tangent.
  std::vector<Vec6> step(2, Vec6::Zero());
  const Vec3 world_axis = Vec3::UnitY();  // turns +x towards -z
  step[0].tail<3>() = longer.rotations[0].conjugate() * (1.0 * world_axis);
  step[1].tail<3>() = longer.rotations[1].conjugate() * (-1.0 * world_axis);
  const GuardedStep admitted = longer.guard.admit(longer.shape(), step);
  CHECK(admitted.share < 0.3);
  std::vector<Vec3> x;
  moved_positions(longer.set.points(), longer.shape(), step, admitted.share, x);
  for (const Vec3& p : x) CHECK(p.z() > 0);
}

TEST_CASE("guards: thousands of random steps never carry a point through the sheet") {
  const TriangleSheet sheet = flat_sheet(3);
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  Guarded rod(sheet, 0.1);
  for (int k = 0; k < 3000; ++k) {
    std::vector<Vec6> step(rod.points.size());
    for (Vec6& v : step) {
      for (int i = 0; i < 6; ++i) v[i] = 0.2 * normal(random);
      v.head<2>() *= 0.05;
    }
    for (std::size_t i = 0; i < step.size(); ++i) step[i][2] += 0.3 * (0.08 - rod.points[i].z());
    rod.take(step, rod.guard.admit(rod.shape(), step).share);
    for (const Vec3& p : rod.set.positions()) REQUIRE(p.z() > 0);
  }
}

TEST_CASE("guards: blockade springs pull a point to half its radius above the plane") {
  const TriangleSheet sheet = flat_sheet(0.5);
  Guarded rod(sheet, 0.005);
  BlockSystem system;
  system.resize(static_cast<int>(rod.points.size()));
  for (auto& b : system.gradient) b.setZero();
  for (auto& b : system.diagonal) b.setIdentity();
  for (auto& b : system.upper) b.setZero();
  add_blockade_springs(rod.set, rod.shape(), {{0, Vec3::UnitZ(), 0}}, 1e6, system);
  const Vec6 solution = -system.diagonal[0].inverse() * system.gradient[0];
  CHECK(solution[2] == Approx(0.005).epsilon(1e-5));  // from 0.005 up to half the radius of 0.02
}
