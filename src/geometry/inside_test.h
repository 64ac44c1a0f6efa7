// Which points lie within a closed mesh.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace tendril {

/// Counts the triangles that a ray along x crosses, from columns of triangles by y and z. A ray through an edge or a
/// vertex counts one of the triangles there, as if it had been moved by next to nothing: the answer is right for every
/// point that does not lie on the surface.
class InsideTest {
 public:
  /// `mesh` must be valid (Mesh::check) and closed, and must outlive this. Vertices need not be shared.
  explicit InsideTest(const Mesh& mesh);

  bool inside(const Vec3& p) const;

 private:
  int column(double y, double z) const;
  const Mesh& mesh_;
  Eigen::AlignedBox3d box_;
  int size_[2] = {1, 1};
  double cell_[2] = {1, 1};       ///< m
  std::vector<int> first_, triangles_;  ///< by column
};

}  // namespace tendril
