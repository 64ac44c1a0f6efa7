// From a harness's route to rods joined at junctions, and to what is measured where they come to rest.
#pragma once

#include "method/route/harness_routing.h"

namespace tendril::routing {

/// Equilibrium of scene_of(), begun from the route; fills what the result says about it.
void settle(const Scene& scene, HarnessResult& harness, const RunContext& context = {});

}  // namespace tendril::routing
