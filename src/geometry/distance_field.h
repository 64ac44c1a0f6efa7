// Bounds of the distance to the surroundings from a coarse grid: what decides most questions of a search without the tree.
//
// Voxels whose centre lies within 0.8661 of a voxel's edge from a triangle are marked, and a separable exact distance
// transform of the marks follows: at every node the distance is known to within that much, and the distance changes by at
// most the way to the node. Solids are exact at the nodes. Each obstacle counts with its clearance taken off.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "base/run_context.h"
#include "geometry/surroundings.h"

namespace tendril {

/// Immutable; safe from several threads.
class DistanceField {
 public:
  /// Of the surroundings within `box` (m); nodes `spacing` (m) apart. Throws UsageError for a spacing that is not finite and
  /// positive, an empty or infinite box, and more than 2^27 nodes. Polls `context`, and is not ok() when stopped.
  DistanceField(const Surroundings& surroundings, const Eigen::AlignedBox3d& box, double spacing, const RunContext& context = {});
  /// The field of `surroundings`, whose first obstacles are those of `known`, by adding the others to it.
  DistanceField(const DistanceField& known, const Surroundings& surroundings, const RunContext& context = {});

  bool ok() const { return ok_; }
  double spacing() const { return spacing_; }
  const Eigen::AlignedBox3d& box() const { return box_; }
  std::size_t bytes() const { return values_.size() * sizeof(float); }

  /// The smallest distance less clearance over all obstacles (m, as Surroundings::closest_kept with `most` infinite) lies
  /// within these, for unsigned distances to meshes and signed ones to solids. Outside the box: -infinity ... infinity.
  struct Bounds {
    double low, high;
  };
  Bounds at(const Vec3& p) const;

 private:
  bool ok_ = false;
  double spacing_ = 0;
  Eigen::AlignedBox3d box_;
  Eigen::Array3i size_ = {0, 0, 0};
  std::vector<float> values_;  ///< by node, x fastest, m
};

/// Fields that were made, for whoever asks again: the same surroundings get the same field, more obstacles get it extended.
class FieldStore {
 public:
  /// A field of these surroundings that covers `box` with a spacing of at most `spacing`.
  std::shared_ptr<const DistanceField> field(const Surroundings& surroundings, const Eigen::AlignedBox3d& box, double spacing,
                                             const RunContext& context = {});

 private:
  struct Entry {
    std::vector<Obstacle> obstacles;
    std::shared_ptr<const DistanceField> field;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;  ///< the latest first, few
};

}  // namespace tendril
