// Which triangles meet at which edges and vertices: the weights of the inclusion-exclusion sum of contact.
#pragma once

#include <array>
#include <vector>

#include "geometry/mesh.h"

namespace tendril {

/// degenerate: two corners are one vertex. repeated: the same three corners as an earlier triangle, in any order.
enum class TriangleKind : unsigned char { regular, degenerate, repeated };

/// The kind of each triangle; indices are below `vertices`.
std::vector<TriangleKind> classify(const std::vector<std::array<int, 3>>& triangles, int vertices);

/// The weights of a triangle's face, its edges (k: from corner k to corner k + 1) and its corners in the sum
///
///   E = sum over faces phi(d) - sum over edges (n_e - 1) phi(d) + sum over vertices c_v phi(d),
///   c_v = 1 - F_v + sum over the edges at v of (n_e - 1),
///
/// with n_e and F_v the numbers of triangles at an edge and a vertex, and d the distance to the closed primitive. The
/// sum counts every point of the surface once (the Euler characteristic of what lies within any distance), whatever the
/// tessellation. An edge or vertex stands with its full weight in one of its triangles and with 0 in the others:
/// whoever is near the edge is as near to each of its triangles. Whole numbers, exact as floats.
struct FeatureWeights {
  float face = 0;
  float edge[3] = {0, 0, 0};
  float vertex[3] = {0, 0, 0};
};

struct MeshTopology {
  std::vector<FeatureWeights> weights;  ///< one a triangle; all zero for degenerate and repeated triangles
  int degenerate_triangles = 0;
  int repeated_triangles = 0;
  int boundary_edges = 0;      ///< edges of one triangle
  int non_manifold_edges = 0;  ///< edges of three triangles or more
  bool watertight() const { return boundary_edges == 0 && non_manifold_edges == 0; }
};

/// Coincident vertices (within `tolerance`, m) count as one. Time linear in the count of triangles.
MeshTopology topology_of(const Mesh& mesh, double tolerance);

}  // namespace tendril
