#include "scene/placed_obstacle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace tendril {
namespace {

constexpr int sides = 48;  // of round parts in a picture

const TriangleSurface* surface_of(const Obstacle& body) {
  const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&body.shape);
  return surface ? surface->get() : nullptr;
}

void add_quad(Mesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

Mesh mesh_of(const Box& box) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(0.5 * box.size.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  return mesh;
}

/// A body of revolution about z through rings at the given (radius, z); the ends close in a point each.
Mesh revolved(const std::vector<std::array<double, 2>>& rings, double bottom, double top) {
  Mesh mesh;
  mesh.vertices.push_back({0, 0, bottom});
  for (const auto& [radius, z] : rings)
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  mesh.vertices.push_back({0, 0, top});
  const int count = static_cast<int>(rings.size()), last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    mesh.triangles.push_back({0, 1 + next, 1 + k});
    for (int ring = 0; ring + 1 < count; ++ring) {
      const int low = 1 + ring * sides, high = low + sides;
      add_quad(mesh, low + k, low + next, high + next, high + k);
    }
    mesh.triangles.push_back({last - sides + k, last - sides + next, last});
  }
  return mesh;
}

Mesh mesh_of(const Sphere& sphere) {
  std::vector<std::array<double, 2>> rings;
  for (int i = 1; i < sides / 2; ++i) {
    const double angle = std::numbers::pi * i / (sides / 2);
    rings.push_back({sphere.radius * std::sin(angle), -sphere.radius * std::cos(angle)});
  }
  return revolved(rings, -sphere.radius, sphere.radius);
}

Mesh mesh_of(const Cylinder& cylinder) {
  const double half = 0.5 * cylinder.length;
  return revolved({{cylinder.radius, -half}, {cylinder.radius, half}}, -half, half);
}

Mesh mesh_of_plane(const Frame& pose, const Eigen::AlignedBox3d& around) {
  const bool empty = around.isEmpty();
  const Vec3 middle = empty ? Vec3(Vec3::Zero()) : Vec3(pose.rotation.conjugate() * (around.center() - pose.at));
  const double half = empty ? 0.5 : std::max(0.05, 0.75 * around.diagonal().norm());
  Mesh mesh;
  for (const auto& [x, y] : {std::array{-1, -1}, std::array{1, -1}, std::array{1, 1}, std::array{-1, 1}})
    mesh.vertices.push_back({middle.x() + x * half, middle.y() + y * half, 0});
  add_quad(mesh, 0, 1, 2, 3);
  return mesh;
}

}  // namespace

void PlacedObstacle::check() const {
  if (name.empty()) throw UsageError("scene:obstacle: the name is empty, expected a word");
  if (!std::isfinite(clearance) || clearance < 0)
    throw UsageError("scene:obstacle: '" + name + "': 'clearance' is " + std::to_string(clearance) +
                     " m, expected a finite number of at least 0");
  Surroundings().add(body);
}

std::size_t PlacedObstacle::triangles() const {
  const TriangleSurface* surface = surface_of(body);
  return surface ? surface->mesh().triangles.size() : 0;
}

bool PlacedObstacle::has_tree() const {
  const TriangleSurface* surface = surface_of(body);
  return surface && surface->has_tree();
}

std::shared_ptr<const Mesh> drawn_mesh(const PlacedObstacle& obstacle, const Eigen::AlignedBox3d& around) {
  if (obstacle.drawn) return obstacle.drawn();
  if (const auto* shared = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape))
    return {*shared, &(*shared)->mesh()};
  const Solid& solid = std::get<Solid>(obstacle.body.shape);
  Mesh mesh;
  if (const Box* box = std::get_if<Box>(&solid)) mesh = mesh_of(*box);
  else if (const Sphere* sphere = std::get_if<Sphere>(&solid)) mesh = mesh_of(*sphere);
  else if (const Cylinder* cylinder = std::get_if<Cylinder>(&solid)) mesh = mesh_of(*cylinder);
  else mesh = mesh_of_plane(obstacle.body.pose, around);
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace tendril
