// A harness as curves that meet at junctions.
#pragma once

#include <vector>

#include "method/route/harness_routing.h"
#include "method/route/harness_tree.h"

namespace tendril::routing {

struct ShapeJunction {
  Vec3 at = Vec3::Zero();              ///< m
  std::vector<int> branches;
  std::vector<Vec3> leaving;           ///< unit, into each branch
};

struct ShapeBranch {
  HarnessEnd from, to;
  std::vector<int> wires;
  double factor = 1;                   ///< what a metre costs
  std::vector<Vec3> path;              ///< over the grid, m, from end to end
  PccPoints points;
};

/// rad, half angles within which directions may turn.
struct EndCones {
  double from = 0, to = 0;
};

struct HarnessShape {
  std::vector<ShapeJunction> junctions;
  std::vector<ShapeBranch> branches;

  /// Of a branch, at its junctions by their directions.
  Ends ends(int branch, const std::vector<Frame>& connections) const;
  double cost() const;                 ///< m: lengths times factors; nothing of preferences

  /// Of a branch where trunks are chosen: pi where it leaves a junction in any direction. Of others, at junctions, `cone`.
  EndCones cones(int branch) const;
  EndCones cones(int branch, double cone) const;
  /// Directions at junctions, but for those of the trunks, from the curves.
  void take_directions();

  /// From the branches' curves as they are: the two that continue each other best come first and get one tangent line, which
  /// makes them the trunk; the others keep their directions.
  void choose_trunks();

 private:
  Vec3 out_of(int branch, int junction) const;
};

/// The tree's branches and junctions, those nearer to each other along the tree than `least` (m) as one. `tips`: by connection,
/// where the straight that leaves it ends. Branches have no curves yet, and leave junctions as their paths do.
HarnessShape shape_of(const Roadmap& roadmap, const HarnessTree& tree, const HarnessOptions& options, const std::vector<Vec3>& tips,
                      double least);

/// Demands of one branch, with what its directions may turn by at its ends.
PccDemands demands_of(const HarnessOptions& options, const ShapeBranch& branch, const EndCones& cones = {});

}  // namespace tendril::routing
