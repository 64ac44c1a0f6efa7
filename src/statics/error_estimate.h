// How far discrete rods are from the exact ones, from solving it again on finer meshes.
#pragma once

#include "base/run_context.h"
#include "statics/equilibrium.h"

namespace tendril {

/// Solves the problem with twice and four times the segments, warm from `solution`, and fills the rods' `error`. The
/// differences at the common vertices give the order of convergence and, by Richardson's extrapolation, the error. Not valid
/// when the order that is seen is far from the element's own: the mesh is then too coarse, or the finer meshes fell to
/// another equilibrium.
void estimate_errors(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                     SystemEquilibrium& solution);

}  // namespace tendril
