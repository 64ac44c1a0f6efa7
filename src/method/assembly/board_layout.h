// A plane drawing of a tree of rods without crossings: every branch has a sector of its own.
#pragma once

#include "method/assembly/board_graph.h"

namespace tendril::assembly {

/// Where the nodes go, z = 0. From the middle of the tree outwards each subtree gets a sector of directions by its length of rods,
/// in the order and, where they fit, the directions of `state` seen along z. A sector is a convex cone, so that what goes on in its
/// directions from a place within it stays within it: nothing crosses. Pieces keep the distance between their ends that `state`
/// has. Empty: the system has a loop.
std::vector<Vec3> board_layout(const BoardGraph& graph, const SystemEquilibrium& state);

}  // namespace tendril::assembly
