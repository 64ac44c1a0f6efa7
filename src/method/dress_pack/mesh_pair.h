// The nearest points of two meshes, by branch and bound over trees of both.
//
// Two parts are as far apart as the gaps between their boxes along the axes of either box, and as the gap along the direction in which
// the nearest triangles so far are apart: between surfaces that face each other this one is nearly sharp.
#pragma once

#include <vector>

#include "geometry/triangle_surface.h"
#include "method/dress_pack/triangle_pair.h"

namespace tendril::dress_pack {

/// Boxes about parts of a mesh, halved until one triangle is left; the boxes of triangles lie flat on them.
class BoxTree {
 public:
  explicit BoxTree(const Mesh& mesh);  ///< valid (Mesh::check); must outlive this

  struct Node {
    DistanceTree::OrientedBox box;
    int child = -1;     ///< and the next one; -1: one triangle
    int triangle = -1;
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  const Mesh& mesh() const { return mesh_; }

 private:
  DistanceTree::OrientedBox box_of(int first, int count) const;
  DistanceTree::OrientedBox flat_box(int triangle) const;

  const Mesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<int> order_;  ///< triangles
};

/// Where one mesh's axes are in the other's.
struct RelativePose {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 operator*(const Vec3& p) const { return turn * p + shift; }
};

/// Which triangles of the two meshes; -1: none.
struct TriangleNumbers {
  int a = -1, b = -1;
};

struct MeshPair {
  TrianglePair nearest;      ///< in the second mesh's axes; the distance is the limit when none is nearer
  TriangleNumbers triangles;
  bool found() const { return triangles.a >= 0; }
};

/// The nearest points of meshes a, which is at `pose`, and b, when nearer than `limit` (m). `likely`: triangles that are likely to be near,
/// such as the answer for a pose close by; they save time.
MeshPair closest_of_meshes(const BoxTree& a, const TriangleSurface& b, const RelativePose& pose, double limit, TriangleNumbers likely = {});

}  // namespace tendril::dress_pack
