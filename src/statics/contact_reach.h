// Whether rods can come near their surroundings at all: what cannot be reached costs one query a rod.
#pragma once

#include "statics/rod_network.h"

namespace tendril {

/// False when no equilibrium of the network can touch anything: every rod lies in a ball about its holds, as large as its
/// length allows, that no obstacle comes into. Stretch is allowed for by the loads over EA, at least 5 percent.
/// A clearance that pushes belongs to its obstacle.
bool can_touch(const RodNetwork& network, ClearanceRule clearance = ClearanceRule::judge);

}  // namespace tendril
