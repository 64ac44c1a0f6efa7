// Parts of a tree near an oriented box: the bounds hold, nothing near is left out, and they are sharp where surfaces face each other.
#include <catch2/catch.hpp>
#include <map>

#include "base/frame.h"
#include "geometry/closest_point.h"
#include "geometry/distance_tree.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;
using tendril::test::triangle_soup;
using OrientedBox = DistanceTree::OrientedBox;

namespace {

OrientedBox random_box(double reach, double size, Random& random) {
  OrientedBox box{random.point(reach), random.rotation().toRotationMatrix(), random.point(size).cwiseAbs()};
  if (random.below(3) == 0) box.half[random.below(3)] = 0;
  if (random.below(6) == 0) box.half.setZero();
  return box;
}

/// Corners first, then points anywhere within.
std::vector<Vec3> points_of(const OrientedBox& box, int count, Random& random) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    Vec3 at = random.point(1);
    if (k < 8) at = Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    points.push_back(box.middle + box.axes * at.cwiseProduct(box.half));
  }
  return points;
}

/// All triangles that are left within `range`, and the largest lower bound on the way to each.
std::map<int, double> left_over(const DistanceTree& tree, const OrientedBox& box, const Vec3& direction, double range) {
  std::map<int, double> bounds;
  std::vector<std::pair<int, double>> stack = {{DistanceTree::whole, 0}};
  while (!stack.empty()) {
    const auto [part, above] = stack.back();
    stack.pop_back();
    DistanceTree::Near near[8];
    const int count = tree.near(part, box, direction, range, near);
    for (int k = 0; k < count; ++k) {
      if (k > 0) CHECK(near[k].at_least <= near[k - 1].at_least);
      const double bound = std::max(above, double(near[k].at_least));
      if (part < 0) CHECK(bounds.emplace(near[k].part, bound).second);
      else stack.push_back({near[k].part, bound});
    }
  }
  return bounds;
}

double distance(const Mesh& mesh, int triangle, const Vec3& p) {
  const auto& t = mesh.triangles[triangle];
  return std::sqrt(closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]).squared);
}

}  // namespace

TEST_CASE("parts near a box: no triangle is nearer than its bound, and none within range is left out", "[tree]") {
  int left = 0, out = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Vec3 away = seed % 4 == 0 ? Vec3(random.point(1000)) : Vec3(Vec3::Zero());
    Mesh mesh = seed % 5 == 0 ? box_mesh({0.5, 0.3, 0.2}, 6) : triangle_soup(1 + random.below(400), 0.1, random);
    for (Vec3& v : mesh.vertices) v += away;
    const DistanceTree tree(mesh);
    for (int round = 0; round < 5; ++round) {
      OrientedBox box = random_box(1.5, 0.2, random);
      box.middle += away;
      const double range = random.in(0.01, 1);
      const Vec3 direction = round % 2 ? random.direction() : Vec3(Vec3::Zero());
      const std::map<int, double> bounds = left_over(tree, box, direction, range);
      left += static_cast<int>(bounds.size());
      out += static_cast<int>(mesh.triangles.size() - bounds.size());
      const std::vector<Vec3> points = points_of(box, 20, random);
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        double least = 1e9, along = 1e9;
        for (const Vec3& p : points) {
          least = std::min(least, distance(mesh, t, p));
          for (const int v : mesh.triangles[t]) along = std::min(along, direction.dot(p - mesh.vertices[v]));
        }
        const auto found = bounds.find(t);
        if (found == bounds.end()) CHECK(least >= range);
        else CHECK(found->second <= least);
        // The gap along the direction is between corners: it is exact, and a triangle beyond the range by it is out.
        if (along > range + 0.01) CHECK(found == bounds.end());
      }
    }
  }
  CHECK(left > 1000);
  CHECK(out > 1000);
}

TEST_CASE("parts near a box: bounds along the direction between surfaces that face each other are sharp", "[tree]") {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    Mesh mesh = box_mesh({0.5, 0.4, 0.1}, 16);
    const Mat3 turn = random.rotation().toRotationMatrix();
    for (Vec3& v : mesh.vertices) v = turn * v;
    const DistanceTree tree(mesh);
    // A plate over the upper face, turned about its normal.
    const double gap = random.in(0.02, 0.3);
    const OrientedBox plate{turn * Vec3(0, 0, 0.1 + gap), turn * exp_rotation({0, 0, random.in(-3, 3)}).toRotationMatrix(), {0.2, 0.1, 0}};
    const Vec3 normal = turn.col(2);
    CHECK(left_over(tree, plate, normal, gap - 2e-5).empty());
    const std::map<int, double> bounds = left_over(tree, plate, normal, gap + 1e-4);
    CHECK(bounds.size() > 10);
    CHECK(bounds.size() < 2 * 16 * 16);  // of the upper face only
    for (const auto& [triangle, bound] : bounds) CHECK((bound > gap - 2e-5 && bound < gap + 1e-4));
  }
}

TEST_CASE("parts near a box: none without a range or for a box that is nowhere", "[tree]") {
  const Mesh mesh = box_mesh({0.5, 0.4, 0.1}, 4);
  const DistanceTree tree(mesh);
  DistanceTree::Near near[8];
  OrientedBox box;
  CHECK(tree.near(DistanceTree::whole, box, Vec3::Zero(), 0, near) == 0);
  CHECK(tree.near(DistanceTree::whole, box, Vec3::Zero(), NAN, near) == 0);
  CHECK(tree.near(DistanceTree::whole, box, Vec3::Zero(), INFINITY, near) > 0);
  box.middle.x() = NAN;
  CHECK(tree.near(DistanceTree::whole, box, Vec3::Zero(), 1, near) == 0);
}
