// A triangle mesh as plain data, and what can be said of it without a tree or its topology.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vectors.h"

namespace tendril {

/// Triangles over shared vertices. `vertices` in m; `triangles` index them from 0. The name stands in error messages.
struct Mesh {
  std::string name = "mesh";
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  /// Beyond this (m) the squares of single precision overflow long after rounding has eaten all detail.
  static constexpr double largest_coordinate = 1e9;

  /// Throws UsageError naming the mesh: no triangles, a vertex that is not finite or farther than largest_coordinate, an
  /// index out of range, more triangles than can be counted in 30 bits. Messages count vertices and triangles from 1.
  void check() const;

  Eigen::AlignedBox3d box() const;  ///< of all vertices that triangles use, m; empty without triangles
  double area() const;              ///< m^2
  double volume() const;            ///< m^3; positive for a closed mesh with outward normals

  /// The mesh moved: x -> rotation * (scale * x) + at.
  Mesh moved(const Vec3& at, const Quat& rotation, double scale = 1) const;
};

/// For each vertex the lowest index of a vertex within `tolerance` (m) of it, in effect the vertex to use in its stead.
/// Time linear in the count.
std::vector<int> weld_map(const std::vector<Vec3>& vertices, double tolerance);

/// The distance below which vertices of a mesh count as one: 1e-7 of its box's diagonal.
double weld_tolerance(const Mesh& mesh);

/// A mesh with coincident vertices merged, unused vertices dropped, and without triangles that have two corners in
/// one place or repeat another triangle's corners. Thin triangles with three different corners stay: they close seams.
struct Welded {
  Mesh mesh;
  int merged_vertices = 0;
  int degenerate_triangles = 0;
  int repeated_triangles = 0;
};
Welded welded(const Mesh& mesh, double tolerance);

}  // namespace tendril
