#include <catch2/catch.hpp>

#include <random>

#include "geometry/inside_test.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;

TEST_CASE("inside a box, also on rays through its edges and vertices", "[inside]") {
  const Mesh box = test::box_mesh({1, 1, 1}, 4);  // -1 ... 1, edges every half
  const InsideTest test(box);
  for (double x : {-1.5, -0.75, 0.0, 0.99, 1.01, 7.0})
    for (double y : {-1.5, -0.5, 0.0, 0.25, 0.5, 1.2})
      for (double z : {-1.1, -0.5, 0.0, 0.25, 0.3, 1.2}) {
        CAPTURE(x, y, z);
        CHECK(test.inside({x, y, z}) == (std::abs(x) < 1 && std::abs(y) < 1 && std::abs(z) < 1));
      }
}

TEST_CASE("inside: the share of random points is the mesh's volume", "[inside]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-2, 2);
  const Quat turn = Quat(0.3, 0.5, -0.2, 0.8).normalized();
  const Mesh box = test::box_mesh({1, 0.5, 0.7}, 3).moved({0.1, 0.2, 0.3}, turn);
  const InsideTest test(box);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p(within(random), within(random), within(random));
    const Vec3 local = turn.conjugate() * (p - Vec3(0.1, 0.2, 0.3));
    CHECK(test.inside(p) == (std::abs(local.x()) < 1 && std::abs(local.y()) < 0.5 && std::abs(local.z()) < 0.7));
  }
}

TEST_CASE("inside: rays that miss a vertex by less than its rounding", "[inside]") {
  // Far less than the other coordinates are known to, so that p - corner is the same for most corners, but not for all.
  Mesh ball = test::box_mesh({1, 1, 1}, 8);
  for (Vec3& vertex : ball.vertices) vertex *= 0.013 / vertex.norm();
  const InsideTest test(ball);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-60, -16), sign(-1, 1);
  int wrong = 0;
  for (const Vec3& vertex : ball.vertices)
    for (int i = 0; i < 20; ++i) {
      const auto tiny = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
      const Vec3 p(0.5 * vertex.x(), vertex.y() + tiny(), vertex.z() + tiny());
      wrong += std::abs(vertex.x()) > 1e-3 && !test.inside(p);
      wrong += test.inside(p + Vec3(std::copysign(0.02, vertex.x()), 0, 0));
    }
  CHECK(wrong == 0);
}
