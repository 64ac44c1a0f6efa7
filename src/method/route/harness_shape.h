// A harness as curves that meet at junctions.
#pragma once

#include <vector>

#include "method/route/harness_routing.h"
#include "method/route/harness_tree.h"

namespace tendril::routing {

struct ShapeJunction {
  Vec3 at = Vec3::Zero();              ///< m
  std::vector<int> branches;           ///< the two of the trunk first
  std::vector<Vec3> leaving;           ///< unit, into each branch; the second is opposite to the first
};

struct ShapeBranch {
  HarnessEnd from, to;
  std::vector<int> wires;
  double factor = 1;                   ///< what a metre costs
  std::vector<Vec3> path;              ///< over the grid, m, from end to end
  PccPoints points;
};

struct HarnessShape {
  std::vector<ShapeJunction> junctions;
  std::vector<ShapeBranch> branches;

  /// Of a branch, at its junctions by their directions.
  Ends ends(int branch, const std::vector<Frame>& connections) const;
  double cost() const;                 ///< m: lengths times factors; nothing of preferences
};

/// The tree's branches and junctions, those nearer to each other along the tree than `least` (m) as one. `tips`: by connection,
/// where the straight that leaves it ends.
HarnessShape shape_of(const Roadmap& roadmap, const HarnessTree& tree, const HarnessOptions& options, const std::vector<Vec3>& tips,
                      double least);

/// Demands of one branch.
PccDemands demands_of(const HarnessOptions& options, const ShapeBranch& branch);

}  // namespace tendril::routing
