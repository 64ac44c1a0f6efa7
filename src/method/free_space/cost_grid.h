// The cost of places as a smooth function for descents: what PlaceCost says at the nodes of a grid, and between them the tensor
// product of quadratic B-splines of these values. It is once continuously differentiable, at least 1, and its gradient is its own
// to rounding, kinks of the distance (midway between two walls) included.
//
// A quadratic B-spline of node values lies off a smooth function by h^2 / 8 of the sum of its second derivatives, and beside a
// kink by h / 8 of the jump of the slope. With h a tenth of the range that is below 1 % of the weight at two tenths of the range
// from a surface. Nodes are asked for exactly and once, when a descent first comes near.
#pragma once

#include <atomic>
#include <cstdlib>
#include <memory>

#include "geometry/distance_transform.h"
#include "method/free_space/place_cost.h"

namespace tendril::routing {

/// Safe from several threads, and the same bits for any number of them: a node's value depends on its place alone.
class CostGrid {
 public:
  /// Covers `region` and as far around it as costs change (m). Where a spacing that suits the object and the range would make too
  /// many nodes, at() is exact, with kinks. `fineness`: factor of the spacing, where there may be so many nodes.
  CostGrid(std::shared_ptr<const PlaceCost> cost, const Eigen::AlignedBox3d& region, double fineness = 1);

  /// m, between the nodes; 0 where there is no grid.
  double spacing() const { return values_ ? lattice_.spacing : 0; }
  /// Per metre; `gradient` (1/m) may be null. Exact outside the grid.
  double at(const Vec3& p, Vec3* gradient = nullptr) const;
  long asked() const { return asked_; }  ///< nodes, so far

 private:
  float asked_for(const Eigen::Array3i& node) const;

  std::shared_ptr<const PlaceCost> cost_;
  NodeLattice lattice_;
  struct Free {
    void operator()(float* block) const { std::free(block); }
  };
  std::unique_ptr<float[], Free> values_;  ///< by node; 0: not asked for yet. Pages that no descent comes near stay untouched
  mutable std::atomic<long> asked_ = 0;
};

}  // namespace tendril::routing
