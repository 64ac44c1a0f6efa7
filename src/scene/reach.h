// Which rods can come near which obstacles at all.
#pragma once

#include "scene/placed_obstacle.h"
#include "scene/placed_rod.h"

namespace tendril {

/// False when no shape that the rod can take comes near the obstacle (a mesh: its box) or its clearance. A point of the rod is no farther
/// from a hold than the length between them, give or take some stretch. Builds no tree.
bool can_reach(const PlacedRod& rod, const PlacedObstacle& obstacle);

}  // namespace tendril
