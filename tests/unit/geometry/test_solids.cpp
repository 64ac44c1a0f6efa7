#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "geometry/solids.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::Random;

namespace {

const std::vector<std::pair<const char*, Solid>> solids = {
    {"box", Box{{0.8, 1.2, 2.0}}}, {"sphere", Sphere{0.7}}, {"cylinder", Cylinder{0.5, 1.4}}, {"half-space", HalfSpace{}}};

bool contains(const Solid& solid, const Vec3& p) {
  if (auto* box = std::get_if<Box>(&solid)) return (p.cwiseAbs().array() <= 0.5 * box->size.array()).all();
  if (auto* sphere = std::get_if<Sphere>(&solid)) return p.norm() <= sphere->radius;
  if (auto* c = std::get_if<Cylinder>(&solid)) return p.head<2>().norm() <= c->radius && std::abs(p.z()) <= c->length / 2;
  return p.z() <= 0;
}

}  // namespace

TEST_CASE("distances to solids at known points", "[solids]") {
  const Solid box = Box{{2, 4, 6}}, cylinder = Cylinder{1, 4};
  CHECK(distance_to(box, {2, 0, 0}).distance == Approx(1));
  CHECK(distance_to(box, {2, 3, 0}).distance == Approx(std::sqrt(2)));
  CHECK(distance_to(box, {2, 3, 4}).distance == Approx(std::sqrt(3)));
  CHECK(distance_to(box, {0.9, 0, 0}).distance == Approx(-0.1));
  CHECK(distance_to(box, {0, 0, 0}).distance == Approx(-1));
  CHECK(distance_to(box, {-0.9, 0, 0}).normal == -Vec3::UnitX());
  CHECK(distance_to(cylinder, {0, 3, 0}).distance == Approx(2));
  CHECK(distance_to(cylinder, {0, 0.5, 2.5}).distance == Approx(0.5));
  CHECK(distance_to(cylinder, {0, 4, -6}).distance == Approx(5));
  CHECK(distance_to(cylinder, {0, 4, -6}).normal.isApprox(Vec3(0, 0.6, -0.8)));
  CHECK(distance_to(cylinder, {0, 0.8, 0}).distance == Approx(-0.2));
  CHECK(distance_to(cylinder, {0, 0, 1.9}).normal == Vec3::UnitZ());
  CHECK(distance_to(Solid(Sphere{2}), {0, 3, 4}).distance == Approx(3));
  CHECK(distance_to(Solid(HalfSpace{}), {7, 8, -2}).distance == Approx(-2));
}

TEST_CASE("the foot lies on the surface at the distance and no point of the solid is nearer", "[solids]") {
  for (const auto& [name, solid] : solids) {
    Random random(81);
    CAPTURE(name);
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = random.point(1.5);
      const SolidDistance d = distance_to(solid, p);
      CHECK((d.distance <= 0) == contains(solid, p));
      CHECK(d.normal.norm() == Approx(1));
      CHECK(d.point.isApprox(p - d.distance * d.normal, 1e-12));
      CHECK(std::abs(distance_to(solid, d.point).distance) < 1e-12);
      for (int k = 0; k < 20; ++k) {
        const Vec3 q = p + std::abs(d.distance) * 0.999 * random.direction();
        CHECK(contains(solid, q) == (d.distance <= 0));
      }
    }
  }
}

TEST_CASE("gradients and Hessians of distances to solids against finite differences", "[solids]") {
  for (const auto& [name, solid] : solids) {
    Random random(83);
    CAPTURE(name);
    int checked = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random.point(1.6), way = random.direction();
      const SolidDistance d = distance_to(solid, p);
      if (std::abs(d.distance) < 1e-3) continue;
      const double h = 1e-6;
      const SolidDistance after = distance_to(solid, p + h * way), before = distance_to(solid, p - h * way);
      // Inside, the nearest side may change within the step.
      if (d.distance < 0 && (after.normal - before.normal).norm() > 1e-4) continue;
      ++checked;
      CHECK(d.normal.dot(way) == Approx((after.distance - before.distance) / (2 * h)).margin(1e-6));
      const Vec3 forward = (after.normal - d.normal) / h, backward = (d.normal - before.normal) / h;
      if ((forward - backward).norm() > 1e-3 * (1 + d.hessian.norm())) continue;  // a foot passes an edge
      CHECK((d.hessian * way - 0.5 * (forward + backward)).norm() < 1e-4 * (1 + d.hessian.squaredNorm()));
      CHECK((d.hessian * d.normal).norm() < 1e-9 * (1 + d.hessian.norm()));
    }
    CHECK(checked > 500);
  }
}

TEST_CASE("in the middle and on the axis distances to solids are finite", "[solids]") {
  for (const auto& [name, solid] : solids) {
    CAPTURE(name);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0, 0, 0.3), Vec3(0, 0, 3), Vec3(1e-200, 0, 0)}) {
      const SolidDistance d = distance_to(solid, p);
      CHECK(std::isfinite(d.distance));
      CHECK(d.normal.norm() == Approx(1));
      CHECK(all_finite(d.hessian));
    }
  }
}

TEST_CASE("rays enter solids where marching along the way does", "[solids]") {
  for (const auto& [name, solid] : solids) {
    Random random(85);
    CAPTURE(name);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 a = random.point(1.6), b = random.point(1.6);
      const auto hit = entry_into(solid, a, b);
      double share = 2;
      for (int k = 1; k <= 2000 && share > 1; ++k)
        if (!contains(solid, a + (k - 1) / 2000.0 * (b - a)) && contains(solid, a + k / 2000.0 * (b - a))) share = k / 2000.0;
      if (share > 1) {
        // A way that grazes may enter and leave between two steps.
        if (hit) CHECK(contains(solid, a + (hit->share + 1e-3) * (b - a)) == false);
        continue;
      }
      REQUIRE(hit);
      ++hits;
      CHECK(std::abs(hit->share - share) < 6e-4);
      CHECK(hit->normal.norm() == Approx(1));
      CHECK(hit->normal.dot(b - a) < 0);
      CHECK(std::abs(distance_to(solid, a + hit->share * (b - a)).distance) < 1e-12);
    }
    CHECK(hits > 30);
  }
}

TEST_CASE("a way out of a solid, past it or of no length enters nothing", "[solids]") {
  for (const auto& [name, solid] : solids) {
    CAPTURE(name);
    CHECK_FALSE(entry_into(solid, {0.01, 0.02, -0.03}, {0.1, 5, 5}));
    CHECK_FALSE(entry_into(solid, {9, 9, 9}, {9, 9, 9}));
    CHECK_FALSE(entry_into(solid, {9, -9, 5}, {9, 9, 5}));
  }
  CHECK(entry_into(Solid(Cylinder{1, 2}), {0, 0, 5}, {0, 0, -5})->share == Approx(0.4));
  CHECK(entry_into(Solid(Cylinder{1, 2}), {5, 0, 0}, {-5, 0, 0})->normal.isApprox(Vec3::UnitX()));
}

TEST_CASE("solids without size say so", "[solids]") {
  CHECK_THROWS_WITH(check(Box{{1, 0, 1}}, "scene:obstacle 'crate'"),
                    "scene:obstacle 'crate': size y is 0; a finite length above 0 expected (m)");
  CHECK_THROWS_WITH(check(Sphere{-1}, "ball"), "ball: radius is -1; a finite length above 0 expected (m)");
  CHECK_THROWS_WITH(check(Cylinder{1, std::numeric_limits<double>::infinity()}, "post"),
                    "post: length is inf; a finite length above 0 expected (m)");
  CHECK_THROWS_AS(check(Cylinder{std::nan(""), 1}, "post"), UsageError);
  CHECK_NOTHROW(check(HalfSpace{}, "floor"));
}
