#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "geometry/mesh.h"
#include "geometry/mesh_topology.h"
#include "geometry/triangle_surface.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;

TEST_CASE("a mesh that is not valid says what is wrong with it", "[mesh]") {
  Mesh mesh{"bay.obj", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  CHECK_NOTHROW(mesh.check());
  Mesh none = mesh;
  none.triangles.clear();
  CHECK_THROWS_WITH(none.check(), "mesh 'bay.obj': no triangles; at least one expected");
  Mesh wild = mesh;
  wild.triangles.push_back({0, 1, 3});
  CHECK_THROWS_WITH(wild.check(), "mesh 'bay.obj': triangle 2 uses vertex 4; there are 3 vertices");
  wild.triangles.back() = {0, -1, 2};
  CHECK_THROWS_WITH(wild.check(), "mesh 'bay.obj': triangle 2 uses vertex 0; there are 3 vertices");
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e200}) {
    Mesh broken = mesh;
    broken.vertices[1].y() = bad;
    CHECK_THROWS_WITH(broken.check(), Catch::StartsWith("mesh 'bay.obj': vertex 2 is (") &&
                                          Catch::EndsWith("finite numbers within 1e+09 m expected"));
    CHECK_THROWS_AS(TriangleSurface(broken), UsageError);
  }
}

TEST_CASE("box, area and volume of a box, also far away and turned", "[mesh]") {
  const Vec3 half(0.5, 1, 1.5);
  for (int n : {1, 3}) {
    const Mesh mesh = box_mesh(half, n);
    CHECK(mesh.box().min().isApprox(-half));
    CHECK(mesh.box().max().isApprox(half));
    CHECK(mesh.area() == Approx(22));
    CHECK(mesh.volume() == Approx(6));
    Random random(5);
    const Mesh moved = mesh.moved({1e5, -2e5, 3e4}, random.rotation(), 2);
    CHECK(moved.volume() == Approx(48).epsilon(1e-9));
  }
}

TEST_CASE("vertices within the tolerance weld, others do not", "[mesh]") {
  Random random(11);
  const double tolerance = 1e-6;
  std::vector<Vec3> points, twins;
  for (int i = 0; i < 2000; ++i) points.push_back(random.point(1));
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) points.push_back(points[i] + 0.9 * tolerance * random.direction());
  for (int i = 0; i < count; ++i) points.push_back(points[i] + 2.5 * tolerance * random.direction());
  const std::vector<int> map = weld_map(points, tolerance);
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    wrong += map[i] != i;
    wrong += map[count + i] != i;
    wrong += map[2 * count + i] != 2 * count + i;
  }
  CHECK(wrong == 0);
  const std::vector<int> exact = weld_map({{0, 0, 0}, {-0.0, 0, 0}, {1e-300, 0, 0}, {1, 0, 0}, {1, 0, 0}}, 0);
  CHECK(exact == std::vector<int>{0, 0, 0, 3, 3});  // the square of 1e-300 is 0
}

TEST_CASE("welding a box of loose faces closes it; degenerate and repeated triangles go and are counted", "[mesh]") {
  Mesh mesh = box_mesh({1, 1, 1}, 4);
  CHECK_FALSE(topology_of(mesh, 0).boundary_edges != 0);  // corners coincide exactly
  const int triangles = static_cast<int>(mesh.triangles.size());
  const auto first = mesh.triangles[0];
  mesh.triangles.push_back({first[0], first[0], first[1]});
  mesh.triangles.push_back({first[2], first[0], first[1]});
  mesh.triangles.push_back({first[1], first[0], first[2]});
  mesh.vertices.push_back({9, 9, 9});
  const Welded clean = welded(mesh, 1e-9);
  CHECK(clean.degenerate_triangles == 1);
  CHECK(clean.repeated_triangles == 2);
  CHECK(static_cast<int>(clean.mesh.triangles.size()) == triangles);
  CHECK(clean.mesh.vertices.size() == 6 * 4 * 4 + 2);  // Euler: V = 2 + E - F
  CHECK(clean.mesh.volume() == Approx(8));
  const MeshTopology topology = topology_of(mesh, 1e-9);
  CHECK(topology.watertight());
  CHECK(topology.degenerate_triangles == 1);
  CHECK(topology.repeated_triangles == 2);
}

TEST_CASE("the weights of a mesh add up to its Euler characteristic", "[mesh]") {
  const auto total = [](const Mesh& mesh) {
    double sum = 0;
    for (const FeatureWeights& w : topology_of(mesh, 1e-9).weights) {
      sum += w.face;
      for (int k = 0; k < 3; ++k) sum += w.edge[k] + w.vertex[k];
    }
    return sum;
  };
  // Far away every distance is the same, and the sum is V - E + F: c_v makes it so.
  CHECK(total(box_mesh({1, 1, 1}, 5)) == 2);
  const Mesh single{"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  CHECK(total(single) == 1);
  Mesh fin{"fin", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  CHECK(total(fin) == 1);
  CHECK(topology_of(fin, 0).non_manifold_edges == 1);
  CHECK(topology_of(fin, 0).boundary_edges == 6);
}

TEST_CASE("a surface builds its tree and topology once and only when asked", "[mesh]") {
  const TriangleSurface surface(box_mesh({1, 1, 1}));
  CHECK_FALSE(surface.has_tree());
  CHECK_FALSE(surface.has_topology());
  const DistanceTree* tree = &surface.tree();
  CHECK(surface.has_tree());
  CHECK_FALSE(surface.has_topology());
  CHECK(&surface.tree() == tree);
  CHECK(surface.topology().watertight());
}
