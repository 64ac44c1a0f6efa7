// A system of rods as a graph: pieces of rods between junctions and free ends.
#pragma once

#include <string>
#include <vector>

#include "statics/equilibrium.h"

namespace tendril::assembly {

/// A junction, or an end of a rod that no junction joins.
struct BoardNode {
  int branch = -1;         ///< of the system's branch points; or
  int rod = -1;            ///< an end of this rod,
  double at = 0;           ///< at this arc length, m
  std::vector<int> pieces; ///< that meet here
};

struct BoardPiece {
  int rod = 0;
  double begin = 0, end = 0;  ///< arc lengths, m
  int from = 0, to = 0;       ///< nodes
  double length() const { return end - begin; }
};

struct BoardGraph {
  std::vector<BoardNode> nodes;
  std::vector<BoardPiece> pieces;
  std::vector<std::vector<double>> ways;  ///< m along the rods, from node to node

  bool has_loop() const { return pieces.size() >= nodes.size(); }  ///< it hangs together
  /// The node from which the longest way to any other is shortest.
  int middle() const;
  /// The shortest way along the rods between two places, m.
  double way(int piece_a, double at_a, int piece_b, double at_b) const;
};

BoardGraph board_graph(const SystemProblem& problem);

/// Where a state has a node.
Vec3 place_of(const BoardNode& node, const SystemEquilibrium& state);

}  // namespace tendril::assembly
