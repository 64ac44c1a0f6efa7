// From a harness's route to rods joined at junctions, and to what is measured where they come to rest.
#pragma once

#include "method/route/harness_routing.h"

namespace tendril::routing {

/// Equilibrium of scene_of(), begun from the route, or from an equilibrium of a similar design; fills what the result says about it.
void settle(const Scene& scene, HarnessResult& harness, const RunContext& context = {}, const SceneEquilibrium* from = nullptr);

}  // namespace tendril::routing
