// The solids of VRML97 as triangles.

#include <cmath>

#include "base/units.h"
#include "geometry/read_vrml_nodes.h"

namespace tendril {

namespace {

constexpr int sides = 32;

/// A ring about the y axis; returns the index of its first vertex.
int add_ring(Mesh& mesh, double radius, double y) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * units::pi * k / sides;
    mesh.vertices.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
  }
  return first;
}

int add_point(Mesh& mesh, double y) {
  mesh.vertices.emplace_back(0, y, 0);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

void add_wall(Mesh& mesh, int lower, int upper) {
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    mesh.triangles.push_back({lower + k, lower + next, upper + next});
    mesh.triangles.push_back({lower + k, upper + next, upper + k});
  }
}

/// A ring joined to a point, seen from above when `up`.
void add_fan(Mesh& mesh, int ring, int point, bool up) {
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    mesh.triangles.push_back({ring + (up ? k : next), ring + (up ? next : k), point});
  }
}

}  // namespace

Mesh vrml_box(const Vec3& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(0.5 * Vec3(i & 1 ? size.x() : -size.x(), i & 2 ? size.y() : -size.y(), i & 4 ? size.z() : -size.z()));
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

Mesh vrml_cylinder(double radius, double height, bool side, bool bottom, bool top) {
  Mesh mesh;
  const int lower = add_ring(mesh, radius, -0.5 * height), upper = add_ring(mesh, radius, 0.5 * height);
  if (side) add_wall(mesh, lower, upper);
  if (bottom) add_fan(mesh, lower, add_point(mesh, -0.5 * height), false);
  if (top) add_fan(mesh, upper, add_point(mesh, 0.5 * height), true);
  return mesh;
}

Mesh vrml_cone(double radius, double height, bool side, bool bottom) {
  Mesh mesh;
  const int ring = add_ring(mesh, radius, -0.5 * height);
  if (side) add_fan(mesh, ring, add_point(mesh, 0.5 * height), true);
  if (bottom) add_fan(mesh, ring, add_point(mesh, -0.5 * height), false);
  return mesh;
}

Mesh vrml_sphere(double radius) {
  Mesh mesh;
  const auto height = [&](int row) { return -radius * std::cos(units::pi * row / (sides / 2)); };
  const auto width = [&](int row) { return radius * std::sin(units::pi * row / (sides / 2)); };
  int last = add_ring(mesh, width(1), height(1));
  add_fan(mesh, last, add_point(mesh, -radius), false);
  for (int row = 2; row < sides / 2; ++row) {
    const int next = add_ring(mesh, width(row), height(row));
    add_wall(mesh, last, next);
    last = next;
  }
  add_fan(mesh, last, add_point(mesh, radius), true);
  return mesh;
}

Mesh vrml_elevation(int columns, int rows, double column_spacing, double row_spacing, const std::vector<double>& heights) {
  Mesh mesh;
  if (columns < 2 || rows < 2) return mesh;
  mesh.vertices.reserve(heights.size());
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      mesh.vertices.emplace_back(column_spacing * i, heights[static_cast<std::size_t>(j) * columns + i], row_spacing * j);
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + columns;  // b is further along z
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

}  // namespace tendril
