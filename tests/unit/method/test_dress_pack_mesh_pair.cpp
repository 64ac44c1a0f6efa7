// The nearest points of two meshes against all pairs of triangles.
#include <catch2/catch.hpp>

#include "geometry/closest_point.h"
#include "method/dress_pack/mesh_pair.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using namespace tendril::dress_pack;
using tendril::test::Random;

namespace {

void triangle_of(const Mesh& mesh, int triangle, const RelativePose& pose, Vec3 (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = pose * mesh.vertices[mesh.triangles[triangle][k]];
}

double all_pairs(const Mesh& a, const Mesh& b, const RelativePose& pose) {
  double least = 1e9;
  for (int i = 0; i < static_cast<int>(a.triangles.size()); ++i) {
    Vec3 of_a[3], of_b[3];
    triangle_of(a, i, pose, of_a);
    for (int j = 0; j < static_cast<int>(b.triangles.size()); ++j) {
      triangle_of(b, j, {}, of_b);
      least = std::min(least, closest_of_triangles(of_a, of_b).distance);
    }
  }
  return least;
}

double off_triangle(const Vec3& p, const Mesh& mesh, int triangle, const RelativePose& pose) {
  Vec3 t[3];
  triangle_of(mesh, triangle, pose, t);
  return std::sqrt(closest_on_triangle(p, t[0], t[1], t[2]).squared);
}

RelativePose random_pose(double reach, Random& random) {
  return {random.rotation().toRotationMatrix(), random.point(reach)};
}

Mesh random_mesh(Random& random) {
  switch (random.below(4)) {
    case 0: return tendril::test::box_mesh(Vec3(0.05, 0.05, 0.05) + random.point(0.4).cwiseAbs(), 1 + random.below(5));
    case 1: return tendril::test::triangle_soup(1 + random.below(4), 0.3, random);
    default: return tendril::test::triangle_soup(1 + random.below(200), 0.15, random);
  }
}

/// Both points lie on their triangles, as far apart as is said.
void check_points(const MeshPair& found, const Mesh& a, const Mesh& b, const RelativePose& pose) {
  CHECK((found.nearest.on_a - found.nearest.on_b).norm() == Approx(found.nearest.distance).margin(1e-12));
  CHECK(off_triangle(found.nearest.on_a, a, found.triangles.a, pose) < 1e-9);
  CHECK(off_triangle(found.nearest.on_b, b, found.triangles.b, {}) < 1e-9);
}

}  // namespace

TEST_CASE("nearest points of two meshes: as all pairs of triangles, with any limit and any start", "[dress_pack]") {
  int apart = 0, beyond = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const Mesh a = random_mesh(random);
    const TriangleSurface b(random_mesh(random));
    const BoxTree boxes(a);
    const RelativePose pose = random_pose(random.below(3) == 0 ? 0.5 : 3, random);
    const double expected = all_pairs(a, b.mesh(), pose);
    const MeshPair found = closest_of_meshes(boxes, b, pose, 100);
    REQUIRE(found.found());
    CHECK(found.nearest.distance == Approx(expected).epsilon(0).margin(1e-12));
    check_points(found, a, b.mesh(), pose);
    apart += expected > 0;
    for (int round = 0; round < 3; ++round) {
      const TriangleNumbers any{random.below(static_cast<int>(a.triangles.size())), random.below(static_cast<int>(b.mesh().triangles.size()))};
      const double limit = round == 0 ? expected + 1e-9 : random.in(0.01, 2) * std::max(expected, 1e-3);
      const MeshPair limited = closest_of_meshes(boxes, b, pose, limit, round == 2 ? found.triangles : any);
      CHECK(limited.found() == (expected < limit));
      CHECK(limited.nearest.distance == Approx(std::min(limit, expected)).epsilon(0).margin(1e-12));
      if (limited.found()) check_points(limited, a, b.mesh(), pose);
      else ++beyond;
    }
  }
  CHECK(apart > 60);
  CHECK(beyond > 60);
}

TEST_CASE("nearest points of two meshes: faces that are parallel, or nearly, at every scale", "[dress_pack]") {
  Random random(7);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Mesh a = tendril::test::box_mesh(scale * Vec3(0.1, 0.2, 0.05), 6);
    const TriangleSurface b(tendril::test::box_mesh(scale * Vec3(0.4, 0.3, 0.1), 8));
    const BoxTree boxes(a);
    for (const double tilt : {0.0, 1e-9, 1e-6, 1e-3, 0.1}) {
      INFO("scale " << scale << ", tilt " << tilt);
      const double gap = random.in(0.001, 0.2) * scale;
      // The lower face over the upper one, turned about the normal; the tilt lowers the nearest corner.
      const Mat3 turn = Mat3(Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix()) * Eigen::AngleAxisd(random.in(-3, 3), Vec3::UnitZ());
      double lowest = 1e9;
      for (const Vec3& v : a.vertices) lowest = std::min(lowest, (turn * v).z());
      const RelativePose pose{turn, {0, 0, 0.1 * scale + gap - lowest}};
      const MeshPair found = closest_of_meshes(boxes, b, pose, 10 * scale);
      CHECK(found.nearest.distance == Approx(gap).epsilon(0).margin(1e-12 * std::max(1.0, scale)));
      check_points(found, a, b.mesh(), pose);
    }
  }
}

TEST_CASE("nearest points of two meshes: along a motion from the triangles that were nearest", "[dress_pack]") {
  Random random(11);
  const Mesh a = tendril::test::triangle_soup(80, 0.2, random);
  const TriangleSurface b(tendril::test::triangle_soup(300, 0.1, random));
  const BoxTree boxes(a);
  const Vec3 from = random.point(3), to = random.point(3), axis = random.direction();
  TriangleNumbers last;
  for (int step = 0; step <= 60; ++step) {
    const double t = step / 60.0;
    const RelativePose pose{Eigen::AngleAxisd(2 * t, axis).toRotationMatrix(), (1 - t) * from + t * to};
    const MeshPair found = closest_of_meshes(boxes, b, pose, 100, last);
    CHECK(found.nearest.distance == Approx(all_pairs(a, b.mesh(), pose)).epsilon(0).margin(1e-12));
    last = found.triangles;
  }
}

TEST_CASE("boxes about parts of a mesh hold them, and every triangle has one", "[dress_pack]") {
  Random random(13);
  for (int round = 0; round < 20; ++round) {
    const Mesh mesh = random_mesh(random);
    const BoxTree tree(mesh);
    std::vector<int> seen(mesh.triangles.size(), 0);
    // The triangles below a node, by its children, which come after it.
    std::vector<std::vector<int>> below(tree.nodes().size());
    for (int k = static_cast<int>(tree.nodes().size()) - 1; k >= 0; --k) {
      const BoxTree::Node& node = tree.nodes()[k];
      if (node.child < 0) {
        ++seen.at(node.triangle);
        below[k] = {node.triangle};
      } else {
        below[k] = below.at(node.child);
        below[k].insert(below[k].end(), below.at(node.child + 1).begin(), below.at(node.child + 1).end());
      }
      CHECK((node.box.axes.transpose() * node.box.axes - Mat3::Identity()).norm() < 1e-9);
      for (const int t : below[k])
        for (const int v : mesh.triangles[t]) {
          const Vec3 own = node.box.axes.transpose() * (mesh.vertices[v] - node.box.middle);
          CHECK(((own.cwiseAbs() - node.box.half).array() < 1e-9).all());
        }
    }
    for (const int count : seen) CHECK(count == 1);
  }
}
