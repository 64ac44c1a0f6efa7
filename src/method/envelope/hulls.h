// What one chord of a rod sweeps in all outcomes, rounded by the rod's radius, as a convex field.
#pragma once

#include <vector>

#include "method/envelope/cloud_hull.h"
#include "method/envelope/kernel.h"

namespace tendril::envelope {

/// Below 0 inside. Either the largest of plane distances, or the distance to a segment less a radius. Both are convex and
/// nowhere above the distance to any of the centre points less the radius.
class SweptHull {
 public:
  /// Planes are those of the centre points' hull, planes between neighbouring facets that meet at a sharp edge, and the
  /// planes of all directions, each moved out to the farthest point and then by `radius` (m).
  void build(const CloudHull& cloud, std::span<const Cloud> clouds, const Kernel& kernel, double radius);

  bool is_capsule() const { return is_capsule_; }
  const Capsule& capsule() const { return capsule_; }
  PlaneArrays planes() const;
  int plane_count() const { return count_; }

  float low(int axis) const { return low_[axis]; }    ///< box of the field's inside, m
  float high(int axis) const { return high_[axis]; }

  /// Of a capsule, within a cube.
  FieldBounds capsule_bounds(const Cube& cube) const;
  std::size_t bytes() const { return rows_.capacity() * sizeof(float); }

 private:
  void collect_normals(const ConvexHull& hull);
  void add_edge_normals(const ConvexHull& hull);
  void add_directions(std::span<const Cloud> clouds, double radius);

  bool is_capsule_ = false;
  Capsule capsule_{};
  std::vector<float> rows_;  ///< x, y, z, offset, number of `room_` floats each
  int count_ = 0, room_ = 0;
  float low_[3]{}, high_[3]{};
  std::vector<Vec3> normals_;  ///< scratch
};

}  // namespace tendril::envelope
