// Clips through which a rod slips without friction: the arc lengths there are unknowns, found so that the whole energy is
// stationary in them too.
//
// At fixed arc lengths a the rods are in equilibrium, Pi(a) = min over q of E(q, a). Newton's method on Pi: slope dE/da,
// curvature d2E/da2 - B^T K^-1 B with B = d2E/dq da and K the factorised second derivative of the equilibrium at hand. For a
// clip that holds the orientation this is the balance of the configurational force M^2/(2 EI) + ... with the jump of the
// axial force (Bigoni et al. 2013, "Effects of the constraint's curvature on structural instability").
// Not done: friction; what contact between two stops does to the slip (its energy is a penalty's, not stored).
#pragma once

#include "base/run_context.h"
#include "statics/equilibrium.h"

namespace tendril {

bool has_sliding_clips(const SystemProblem& problem);

/// As solve(), for a problem with sliding clips: `at` of those holds is where the search begins. The supports' `s` says
/// where each one settled. A rod that slides out of a clip is a result with status infeasible and a message that says so.
SystemEquilibrium solve_sliding(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                                const SystemEquilibrium* from);

}  // namespace tendril
