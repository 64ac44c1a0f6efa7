// Whether bodies touch: against separating planes, against the distance tree, against formulas.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "geometry/collision.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;

namespace {

std::shared_ptr<const TriangleSurface> surface(const Mesh& mesh) { return std::make_shared<const TriangleSurface>(mesh); }

// Two triangles have a common point when an edge of one passes through the other: rays along the edges.
bool triangles_touch(const Mesh& a, const Frame& at_a, const DistanceTree& tree_b, const Frame& at_b) {
  const Frame local = at_b.inverse() * at_a;
  for (const auto& t : a.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = local.at + local.rotation * a.vertices[t[k]], q = local.at + local.rotation * a.vertices[t[(k + 1) % 3]];
      if (tree_b.ray(p, q)) return true;
    }
  return false;
}

// Boxes by the fifteen separating axes; > 0: clear by that much along one of them.
double gap_along(const Vec3& n, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
  for (const Vec3& p : a) low_a = std::min(low_a, n.dot(p)), high_a = std::max(high_a, n.dot(p));
  for (const Vec3& p : b) low_b = std::min(low_b, n.dot(p)), high_b = std::max(high_b, n.dot(p));
  return std::max(low_a - high_b, low_b - high_a);
}

double gap_of_boxes(const Vec3& half_a, const Frame& a, const Vec3& half_b, const Frame& b) {
  const Mat3 ra = a.rotation.toRotationMatrix(), rb = b.rotation.toRotationMatrix();
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(ra.col(i));
    axes.push_back(rb.col(i));
    for (int j = 0; j < 3; ++j)
      if (const Vec3 c = ra.col(i).cross(rb.col(j)); c.norm() > 1e-6) axes.push_back(c.normalized());
  }
  double gap = -1e300;
  for (const Vec3& n : axes)
    gap = std::max(gap, std::abs(n.dot(b.at - a.at)) - (ra.transpose() * n).cwiseAbs().dot(half_a) -
                            (rb.transpose() * n).cwiseAbs().dot(half_b));
  return gap;
}

}  // namespace

TEST_CASE("collision: boxes as solids and as meshes, by the separating axes", "[collision]") {
  int touching = 0, clear = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Vec3 half_a(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)),
        half_b(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1));
    const Frame a{random.point(1), random.rotation()}, b{random.point(1), random.rotation()};
    const double gap = gap_of_boxes(half_a, a, half_b, b);
    if (std::abs(gap) < 1e-6) continue;
    CollisionBodies bodies;
    const int solid_a = bodies.add(Solid(Box{2 * half_a})), solid_b = bodies.add(Solid(Box{2 * half_b}));
    const int mesh_a = bodies.add(surface(box_mesh(half_a, 2))), mesh_b = bodies.add(surface(box_mesh(half_b, 3)));
    for (int first : {solid_a, mesh_a})
      for (int second : {solid_b, mesh_b}) {
        CHECK(bodies.touch(first, a, second, b) == (gap < 0));
        CHECK(bodies.touch(second, b, first, a) == (gap < 0));
      }
    ++(gap < 0 ? touching : clear);
  }
  CHECK(touching > 100);
  CHECK(clear > 50);
}

TEST_CASE("collision: spheres and cylinders against meshes, by distance", "[collision]") {
  int touching = 0, clear = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto mesh = surface(tendril::test::triangle_soup(40, 0.5, random));
    const double radius = random.in(0.02, 0.5);
    const Frame at{random.point(1.2), random.rotation()}, pose{random.point(0.5), random.rotation()};
    const Vec3 local = pose.inverse().at + pose.inverse().rotation * at.at;
    const double gap = mesh->tree().closest(local, 1e9).distance - radius;
    if (std::abs(gap) < 1e-5) continue;
    CollisionBodies bodies;
    const int ball = bodies.add(Solid(Sphere{radius})), soup = bodies.add(mesh);
    CHECK(bodies.touch(ball, at, soup, pose) == (gap < 0));
    CHECK(bodies.touch(soup, pose, ball, at) == (gap < 0));
    ++(gap < 0 ? touching : clear);
  }
  CHECK(touching > 30);
  CHECK(clear > 30);
  CollisionBodies bodies;
  const int can = bodies.add(Solid(Cylinder{0.5, 2})), plate = bodies.add(surface(box_mesh({1, 1, 0.01})));
  for (double off : {-1e-4, 1e-4}) {
    CHECK(bodies.touch(can, {{0, 0, 1.01 + off}, Quat::Identity()}, plate, {}) == (off < 0));
    CHECK(bodies.touch(can, {{0, 0, 0.51 + off}, exp_rotation({1.5707963267948966, 0, 0})}, plate, {}) == (off < 0));
    CHECK(bodies.touch(can, {{1.5 + off, 0.2, 0}, Quat::Identity()}, plate, {}) == (off < 0));
  }
}

TEST_CASE("collision: boxes against single triangles, slivers and points among them", "[collision]") {
  int touching = 0, clear = 0;
  for (unsigned seed = 1; seed <= 600; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Mesh triangle = tendril::test::triangle_soup(1, 0.5, random);
    const Vec3 half(random.in(0.1, 0.8), random.in(0.1, 0.8), random.in(0.1, 0.8));
    std::vector<Vec3> corners, axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (int k = 0; k < 8; ++k) corners.push_back(half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
    const std::vector<Vec3>& t = triangle.vertices;
    axes.push_back((t[1] - t[0]).cross(t[2] - t[0]));
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) axes.push_back(Vec3::Unit(i).cross(t[(k + 1) % 3] - t[k]));
    for (int k = 0; k < 3; ++k) axes.push_back((t[(k + 1) % 3] - t[k]).cross((t[1] - t[0]).cross(t[2] - t[0])));
    double gap = -1e300;
    for (const Vec3& n : axes)
      if (n.norm() > 1e-9) gap = std::max(gap, gap_along(n.normalized(), corners, t));
    if (std::abs(gap) < 1e-5) continue;
    CollisionBodies bodies;
    const int box = bodies.add(Solid(Box{2 * half})), mesh = bodies.add(surface(triangle));
    const Frame pose{random.point(1), random.rotation()};
    CHECK(bodies.touch(box, pose, mesh, pose) == (gap < 0));
    CHECK(bodies.touch(mesh, pose, box, pose) == (gap < 0));
    ++(gap < 0 ? touching : clear);
  }
  CHECK(touching > 50);
  CHECK(clear > 50);
}

TEST_CASE("collision: meshes against meshes, edge by edge", "[collision]") {
  int touching = 0, clear = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto a = surface(tendril::test::triangle_soup(6, 0.7, random)),
               b = surface(tendril::test::triangle_soup(6, 0.7, random));
    const Frame at_a{random.point(0.3), random.rotation()}, at_b{random.point(0.3), random.rotation()};
    const bool expected = triangles_touch(a->mesh(), at_a, b->tree(), at_b) || triangles_touch(b->mesh(), at_b, a->tree(), at_a);
    CollisionBodies bodies;
    const int first = bodies.add(a), second = bodies.add(b);
    CHECK(bodies.touch(first, at_a, second, at_b) == expected);
    CHECK(bodies.touch(second, at_b, first, at_a) == expected);
    ++(expected ? touching : clear);
  }
  CHECK(touching > 20);
  CHECK(clear > 20);
}

TEST_CASE("collision: a body wholly within a watertight mesh touches it, within an open one it does not", "[collision]") {
  const Mesh closed = box_mesh({1, 1, 1}, 3);
  Mesh open = closed;
  open.triangles.pop_back();
  CollisionBodies bodies;
  const int shell = bodies.add(surface(closed)), sheet = bodies.add(surface(open));
  const int ball = bodies.add(Solid(Sphere{0.2})), stone = bodies.add(surface(box_mesh({0.2, 0.1, 0.1})));
  const Frame turned{{0.3, 0.2, 0.1}, exp_rotation({0.2, 0.3, 0.4})};
  for (int small : {ball, stone}) {
    CHECK(bodies.touch(small, turned, shell, {}));
    CHECK(bodies.touch(shell, {}, small, turned));
    CHECK_FALSE(bodies.touch(small, turned, sheet, {}));
    CHECK_FALSE(bodies.touch(small, {{1.5, 0, 0}, Quat::Identity()}, shell, {}));
  }
  // A solid is full, whatever lies within it.
  const int block = bodies.add(Solid(Box{{4, 4, 4}}));
  CHECK(bodies.touch(block, {}, shell, {}));
  CHECK(bodies.touch(ball, {}, block, {}));
}

TEST_CASE("collision: half-spaces", "[collision]") {
  CollisionBodies bodies;
  const int ground = bodies.add(Solid(HalfSpace{})), ceiling = bodies.add(Solid(HalfSpace{}));
  const int box = bodies.add(Solid(Box{{2, 4, 6}})), ball = bodies.add(Solid(Sphere{0.5})),
            can = bodies.add(Solid(Cylinder{0.5, 2}));
  const int mesh = bodies.add(surface(box_mesh({1, 2, 3}, 4)));
  const double s = std::sqrt(0.5);
  const Frame tilted{{0, 0, 0}, exp_rotation({0.7853981633974483, 0, 0})};
  for (double off : {-1e-9, 1e-9}) {
    const auto at = [&](double height, const Quat& turn = Quat::Identity()) { return Frame{{7, -3, height + off}, turn}; };
    CHECK(bodies.touch(box, at(3), ground, {}) == (off < 0));
    CHECK(bodies.touch(ground, {}, mesh, at(3)) == (off < 0));
    CHECK(bodies.touch(mesh, at(2 * s + 3 * s, tilted.rotation), ground, {}) == (off < 0));
    CHECK(bodies.touch(box, at(2 * s + 3 * s, tilted.rotation), ground, {}) == (off < 0));
    CHECK(bodies.touch(ball, at(0.5), ground, {}) == (off < 0));
    CHECK(bodies.touch(can, at(1), ground, {}) == (off < 0));
    CHECK(bodies.touch(can, at(1.5 * s, tilted.rotation), ground, {}) == (off < 0));
    const Frame down{{0, 0, 1}, exp_rotation({3.141592653589793, 0, 0})};
    CHECK(bodies.touch(ground, {{0, 0, 1 - off}, Quat::Identity()}, ceiling, down) == (off < 0));
  }
  CHECK(bodies.touch(ground, {}, ceiling, tilted));
  CHECK(bodies.touch(ground, {}, ceiling, {{0, 0, -100}, Quat::Identity()}));
}

TEST_CASE("collision: a mesh is kept once; what is no body is refused", "[collision]") {
  CollisionBodies bodies;
  const auto mesh = surface(box_mesh({1, 1, 1}));
  CHECK(bodies.add(mesh) == 0);
  CHECK(bodies.add(mesh) == 1);
  CHECK(bodies.touch(0, {}, 1, {{1.9, 0, 0}, Quat::Identity()}));
  CHECK_FALSE(bodies.touch(0, {}, 1, {{2.1, 0, 0}, Quat::Identity()}));
  CHECK_THROWS_WITH(bodies.add(std::shared_ptr<const TriangleSurface>()), "collision: a body has no mesh");
  CHECK_THROWS_WITH(bodies.add(Solid(Sphere{0})), Catch::Contains("collision"));
}
