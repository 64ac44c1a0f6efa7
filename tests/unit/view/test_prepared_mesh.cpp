#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "golden/picture_scenes.h"
#include "view/prepared_mesh.h"

using namespace tendril;
using scenes::Mesh;

namespace {

PreparedMesh prepared(Mesh mesh) { return prepare_mesh(scenes::surface("part", std::move(mesh)), Vec3::Zero()); }

/// Every triangle with its own three vertices, as STL files have them.
Mesh torn(const Mesh& mesh) {
  Mesh result;
  for (const auto& t : mesh.triangles) {
    const std::int32_t base = static_cast<std::int32_t>(result.vertices.size());
    for (std::int32_t v : t) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({base, base + 1, base + 2});
  }
  return result;
}

double total_area(const PreparedMesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Eigen::Vector3f &a = mesh.positions[mesh.triangles[i]], &b = mesh.positions[mesh.triangles[i + 1]],
                          &c = mesh.positions[mesh.triangles[i + 2]];
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

Eigen::Vector3f unfolded(const std::array<std::int16_t, 2>& code) {
  Eigen::Vector3f n(code[0] / 32767.0f, code[1] / 32767.0f, 0);
  n.z() = 1 - std::abs(n.x()) - std::abs(n.y());
  if (n.z() < 0) {
    const float x = n.x();
    n.x() = (1 - std::abs(n.y())) * (x < 0 ? -1.0f : 1.0f);
    n.y() = (1 - std::abs(x)) * (n.y() < 0 ? -1.0f : 1.0f);
  }
  return n.normalized();
}

}  // namespace

TEST_CASE("a cube has twelve feature edges and 24 corners with exact normals, torn or joined") {
  Mesh cube;
  cube.box({0, 0, 0}, {1, 1, 1});
  for (const Mesh& mesh : {cube, torn(cube)}) {
    const PreparedMesh p = prepared(mesh);
    CHECK(p.edges.size() / 2 == 12);
    CHECK(p.positions.size() == 24);
    CHECK(p.triangles.size() / 3 == 12);
    for (std::size_t i = 0; i < p.edges.size(); i += 2)
      CHECK((p.positions[p.edges[i]] - p.positions[p.edges[i + 1]]).norm() == Approx(1));  // no diagonal
    for (std::size_t i = 0; i < p.triangles.size(); i += 3) {
      const Eigen::Vector3f &a = p.positions[p.triangles[i]], &b = p.positions[p.triangles[i + 1]],
                            &c = p.positions[p.triangles[i + 2]];
      const Eigen::Vector3f n = (b - a).cross(c - a).normalized();
      for (int k = 0; k < 3; ++k)
        CHECK(std::abs(unfolded(p.normals[p.triangles[i + k]]).dot(n)) == Approx(1).margin(1e-4));
    }
  }
}

TEST_CASE("a sphere has no feature edge, one vertex a place, and normals along its radii") {
  Mesh ball;
  ball.sphere({1, 2, 3}, 0.5, 24);
  const PreparedMesh p = prepared(ball);
  CHECK(p.edges.empty());
  CHECK(p.positions.size() == ball.vertices.size());
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const Eigen::Vector3f radius = (p.positions[i] - Eigen::Vector3f(1, 2, 3)).normalized();
    CHECK(std::abs(unfolded(p.normals[i]).dot(radius)) > 0.995f);
  }
}

TEST_CASE("a cylinder has its two rims, an open sheet its border, a perforated plate its rims and holes") {
  Mesh can, sheet, plate;
  can.cylinder({0, 0, 0}, {0, 0, 1}, 0.2, 40);
  CHECK(prepared(can).edges.size() / 2 == 2 * 40);
  sheet.wavy_sheet({0, 0, 0}, 1, 0, 10);
  CHECK(prepared(sheet).edges.size() / 2 == 4 * 10);
  plate.perforated_plate(0, 0.01, 0, 0, 0.1, 3, 2, 0.03);
  // Per cell two rims of 32 sides; along the border 8 sides a cell side on both faces; four corners through the
  // thickness.
  CHECK(prepared(plate).edges.size() / 2 == 6 * 2 * 32 + 2 * (2 * 3 + 2 * 2) * 8 + 4);
}

TEST_CASE("turned-over and doubled triangles are no creases") {
  Mesh sheet;
  sheet.wavy_sheet({0, 0, 0}, 1, 0.001, 8);
  std::mt19937 random(5);
  Mesh flipped = sheet, doubled = sheet;
  for (auto& t : flipped.triangles)
    if (random() % 2) std::swap(t[0], t[1]);
  for (const auto& t : sheet.triangles) doubled.triangles.push_back({t[1], t[0], t[2]});
  CHECK(prepared(flipped).edges.size() / 2 == 4 * 8);
  CHECK(prepared(doubled).edges.size() / 2 == 4 * 8);  // its border is where one side turns into the other
}

TEST_CASE("the crease angle is 30 degrees, both ways") {
  for (double degrees : {-60.0, -31.0, -29.0, -1.0, 0.0, 1.0, 29.0, 31.0, 90.0, 179.0}) {
    const double a = degrees * 3.14159265358979 / 180;
    Mesh hinge;
    hinge.vertices = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(a), 0, std::sin(a)}};
    hinge.triangles = {{0, 1, 2}, {1, 0, 3}};
    INFO(degrees << " degrees");
    CHECK(prepared(hinge).edges.size() / 2 == (std::abs(degrees) > 30 ? 5u : 4u));
  }
}

TEST_CASE("sorting into pieces keeps every triangle, and every piece its box") {
  Mesh mesh;
  mesh.wavy_sheet({-1, -2, 3}, 4, 0.2, 90);
  mesh.sphere({0, 0, 4}, 0.7, 40);
  const PreparedMesh p = prepared(mesh);
  CHECK(p.triangles.size() == 3 * mesh.triangles.size());
  CHECK(p.triangle_pieces.size() > 8);
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
  CHECK(total_area(p) == Approx(area).epsilon(1e-5));
  std::size_t counted = 0;
  for (const MeshPiece& piece : p.triangle_pieces) {
    CHECK(piece.first == counted);
    counted += piece.count;
    for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i) {
      const Eigen::Vector3f& at = p.positions[p.triangles[i]];
      CHECK(((at.array() >= piece.low.array()).all() && (at.array() <= piece.high.array()).all()));
    }
  }
  CHECK(counted == p.triangles.size());
}

TEST_CASE("bad triangles are left out and counted, degenerate ones do no harm") {
  Mesh mesh;
  mesh.box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({NAN, 0, 0});
  mesh.vertices.push_back({INFINITY, 0, 0});
  for (std::array<std::int32_t, 3> bad : {std::array<std::int32_t, 3>{0, 1, 99}, {0, 1, -1}, {0, 1, 8}, {0, 1, 9}})
    mesh.triangles.push_back(bad);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  const PreparedMesh p = prepared(mesh);
  CHECK(p.left_out == 4);
  CHECK(p.triangles.size() / 3 == 12);
  CHECK(p.edges.size() / 2 == 12);
  for (const Eigen::Vector3f& position : p.positions) CHECK(position.allFinite());
}

TEST_CASE("an empty mesh, one point and one place many times are nothing to draw") {
  CHECK(prepared({}).triangles.empty());
  Mesh point;
  point.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  point.triangles = {{0, 1, 2}};
  CHECK(prepared(point).triangles.empty());
}

TEST_CASE("far from the origin, what is relative to it keeps its shape") {
  Mesh near, far;
  near.sphere({0, 0, 0}, 0.01, 20);
  far.sphere({5000, -3000, 1000}, 0.01, 20);
  const PreparedMesh p = prepare_mesh(scenes::surface("near", near), Vec3::Zero());
  const PreparedMesh q = prepare_mesh(scenes::surface("far", far), {5000, -3000, 1000});
  REQUIRE(p.positions.size() == q.positions.size());
  CHECK(total_area(q) == Approx(total_area(p)).epsilon(1e-6));
}

TEST_CASE("a pose turns and moves the mesh") {
  Mesh cube;
  cube.box({0, 0, 0}, {1, 2, 3});
  PictureSurface part = scenes::surface("part", cube);
  part.pose = Frame{{10, 20, 30}, Quat(Eigen::AngleAxisd(0.5 * 3.14159265358979, Vec3::UnitZ()))};
  const PreparedMesh p = prepare_mesh(part, {10, 20, 30});
  Eigen::Vector3f low = p.positions[0], high = p.positions[0];
  for (const Eigen::Vector3f& at : p.positions) low = low.cwiseMin(at), high = high.cwiseMax(at);
  CHECK((low - Eigen::Vector3f(-2, 0, 0)).norm() < 1e-5f);
  CHECK((high - Eigen::Vector3f(0, 1, 3)).norm() < 1e-5f);
}

TEST_CASE("octahedral codes give the direction back") {
  const unsigned seed = 3;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::normal_distribution<float> part;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f n = Eigen::Vector3f(part(random), part(random), part(random)).normalized();
    CHECK((unfolded(octahedral(n)) - n).norm() < 1e-4f);
  }
}
