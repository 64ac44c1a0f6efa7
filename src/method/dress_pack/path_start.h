// What comes before a path is improved, however it is.
#pragma once

#include "method/dress_pack/reduced.h"

namespace tendril::dress_pack {

/// Puts the path to begin with into `out`, and the motion of the rods of `pack` along it. False, with a status and a message, when it
/// lies beyond the robot's limits.
bool take_path(const PackProblem& pack, const JointPath& given, const ReducedOptions& options, const RunContext& context, ReducedResult& out);

/// Finds the equilibria of `problem` along that path. False, with a status and a message, when there are none or it was ended.
bool follow_once(ReducedProblem& problem, const RunContext& context, ReducedResult& out);

}  // namespace tendril::dress_pack
