// Clips of a harness: where they can be, and the fewest of those places at which the harness at rest keeps what it keeps with a
// clip at each of them.
//
// A clip holds a section completely, so that clips part a harness into cells that do not feel each other. Beginning with clips at
// all places, in each round those that bear least are left out, no two of them at the same cell, and the cells that this makes one
// are judged each by itself: as many trials as fit into one equilibrium. A clip without which its cells miss more than before stays
// for good, since cells only grow. Then one clip in the middle stands in for two neighbours where it can.
#pragma once

#include <memory>
#include <vector>

#include "method/route/harness_model.h"

namespace tendril::routing {

/// At regular distances along the routes, all places where something that takes clips is within reach. By branch, then rising; `at`
/// is that of rods as long as their routes.
std::vector<HarnessClip> harness_clip_places(const HarnessSurroundings& around, const HarnessResult& harness);

struct HarnessClips {
  Status status = Status::solved;            ///< stalled: no equilibrium even with all clips; cancelled, timeout
  std::vector<HarnessClip> clips;            ///< at most as many as allowed
  int enough = 0;                            ///< with so many nothing more is missed than with all; above `most`: too few are allowed
  std::shared_ptr<const SceneEquilibrium> equilibrium;  ///< with `clips`, of rods as long as their routes
  double missed_with_all = 0;                ///< the largest share of what is missed with clips at all places
  int equilibria = 0;
};

/// `most`: so many are allowed, at least 1. `least`: the slack (share of what is demanded) that bend radii and gaps shall have with rods
/// as long as their routes; below 0 where lengths are left to make up for it.
HarnessClips fewest_harness_clips(const Scene& scene, const HarnessSurroundings& around, const HarnessResult& harness,
                        const std::vector<HarnessClip>& places, int most, double least, const RunContext& context);

}  // namespace tendril::routing
