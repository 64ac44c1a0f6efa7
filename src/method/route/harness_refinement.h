// Refinement of a routed harness: what it is built to, so that at rest under gravity it keeps bend radius and clearance at the least
// cost.
//
//   minimise   sum over branches of  factor * integral of FreeSpace::cost along the rod at rest
//   over       unstressed lengths between clips and ends, directions of branches at junctions
//   subject to equilibrium in contact, bend radius, clearance, keep_out and keep_in, and no branch strung tighter than allowed
//
// by sequential quadratic programming on exact sensitivities (constrained_descent.h). Where that is not enough, clips are chosen
// (harness_clips.h) and lengths and directions follow once more. Not done: clips stay where the route is.
#pragma once

#include "method/route/harness_routing.h"

namespace tendril::routing {

/// Fills the design, the equilibrium and what is said about it. `harness`: routed, nothing missed. `clips_first`: without clips it is
/// only tried where they do not help. False: it hangs so far below its route that another one with a little in reserve would not help.
bool refine(const Scene& scene, HarnessResult& harness, bool clips_first, const RunContext& context = {});

/// Sum of what the harness misses at rest, as shares of what is demanded; infinite without an equilibrium.
double missed_at_rest(const HarnessResult& harness);

}  // namespace tendril::routing
