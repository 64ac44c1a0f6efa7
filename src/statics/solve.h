// Static equilibrium of rods: the door to everything in this folder.
#pragma once

#include "base/run_context.h"
#include "statics/equilibrium.h"
#include "statics/problem.h"

namespace tendril {

/// Finds the static equilibrium of one rod. `from`: an equilibrium of a similar problem to start from (a warm start);
/// null: a first guess from the holds. Throws UsageError for a problem that makes no sense; a computation that does not
/// converge, is cancelled or runs out of time gives a result with that status and the best state so far.
Equilibrium solve(const RodProblem& problem, const SolveOptions& options = {}, const RunContext& context = {},
                  const Equilibrium* from = nullptr);

/// The same for rods that hang together at branch points.
SystemEquilibrium solve(const SystemProblem& problem, const SolveOptions& options = {}, const RunContext& context = {},
                        const SystemEquilibrium* from = nullptr);

}  // namespace tendril
