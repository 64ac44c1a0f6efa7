// Bounds of the distance to the surroundings from a coarse grid: what decides most questions of a search without the tree.
//
// Nodes within 0.8661 of the spacing from a triangle are marked, and a separable exact distance transform of the marks
// follows: at every node the distance is known to within that much, and it changes by at most the way to the node. Solids are
// exact at the nodes. Each obstacle counts with its clearance taken off: one transform for each clearance that occurs.
#pragma once

#include <limits>
#include <vector>

#include "base/run_context.h"
#include "geometry/distance_transform.h"
#include "geometry/surroundings.h"

namespace tendril {

/// Immutable; safe from several threads.
class DistanceField {
 public:
  static constexpr double most_nodes = 1 << 27;

  /// Of the surroundings within `box` (m); nodes `spacing` (m) apart. Throws UsageError for a spacing that is not finite and
  /// positive, an empty or infinite box, and more than most_nodes. Polls `context`, and is not ok() when stopped.
  DistanceField(const Surroundings& surroundings, const Eigen::AlignedBox3d& box, double spacing, const RunContext& context = {});
  /// The field of `surroundings`, whose first obstacles are those of `known`, by adding the others to it.
  DistanceField(const DistanceField& known, const Surroundings& surroundings, const RunContext& context = {});

  bool ok() const { return ok_; }
  double spacing() const { return lattice_.spacing; }
  const Eigen::AlignedBox3d& box() const { return box_; }  ///< of the nodes, m; holds the box that was asked for
  std::size_t bytes() const { return values_.size() * sizeof(float); }

  /// The smallest distance less clearance over all obstacles (m, as Surroundings::closest_kept with `most` infinite) lies
  /// within these, for unsigned distances to meshes and signed ones to solids. Outside the box: -infinity ... infinity.
  struct Bounds {
    double low, high;
  };
  Bounds at(const Vec3& p) const;

  /// The same distance, linear between the nodes: off by at most 0.8661 of the spacing at the nodes, and between them by no more
  /// than half the diagonal of a voxel further. NaN outside the box; of meshes that stick out of it only what lies within counts.
  double interpolated(const Vec3& p) const;

 private:
  void add(const Surroundings& surroundings, int first, const RunContext& context);
  void add_meshes(const Surroundings& surroundings, const std::vector<int>& meshes, const RunContext& context);
  void add_solids(const Surroundings& surroundings, const std::vector<int>& solids, const RunContext& context);

  bool ok_ = false;
  NodeLattice lattice_;
  Eigen::AlignedBox3d box_;
  int obstacles_ = 0;
  bool has_meshes_ = false;
  double beyond_ = -std::numeric_limits<double>::infinity();  ///< m, largest clearance of the meshes that stick out of the box
  double rounding_ = 0;        ///< m
  std::vector<float> values_;  ///< by node, m
};

}  // namespace tendril
