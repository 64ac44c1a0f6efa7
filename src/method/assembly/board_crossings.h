// Rods on a plane: where they cross, and where they lie too near to each other.
#pragma once

#include "method/assembly/board_graph.h"

namespace tendril::assembly {

struct BoardCrossings {
  int crossings = 0;
  int rod_a = -1, rod_b = -1;          ///< of the first crossing
  Vec3 at = Vec3::Zero();              ///< of the first crossing, m
  /// Where axes are nearer to each other than they should be.
  bool near = false;
  double distance = 0;                 ///< m, where they fall shortest of it
  int near_a = -1, near_b = -1;        ///< rods
};

/// Crossings of the polylines through the vertices, seen along z: segments that have an inner point in common, by the signs of four
/// areas. Axes should be `spacing` (m) apart, but for vertices with less than four spacings of rods between them; from there on a tenth
/// of the further way is enough: what meets at a junction is near there.
BoardCrossings board_crossings(const BoardGraph& graph, const SystemEquilibrium& state, double spacing);

}  // namespace tendril::assembly
