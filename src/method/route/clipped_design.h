// A design held on its way by as few clips as keep what is demanded.
#pragma once

#include <optional>
#include <string>

#include "method/route/local_refinement.h"
#include "method/route/surroundings_by_use.h"

namespace tendril::routing {

struct ClippedDesign {
  bool found = false;       ///< false: none of the numbers allowed leaves every stretch an equilibrium worth a refinement
  Design design;            ///< with the clips
  std::vector<Hold> added;
  int needed = -1;          ///< clips that would do, were there no limit; -1: no number of them does
  std::string lack;         ///< what keeps them from doing: "" where they do
};

/// Candidate places lie along the design's way (its route, or a preformed shape), its own clips stay. Clips are full holds, so each
/// stretch between two is looked at alone: one equilibrium, in contact as for `refine`, of the way's length. Nothing: the design
/// has no way, or nothing to fasten to is in reach of it.
std::optional<ClippedDesign> clipped_along_way(const SurroundingsByUse& around, const Vec3& gravity, const Design& design,
                                               const RefinementOptions& options, const RunContext& context);

}  // namespace tendril::routing
