#include "statics/solve.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "statics/error_estimate.h"
#include "statics/network_solver.h"
#include "statics/sliding_clips.h"

namespace tendril {

SystemEquilibrium solve(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                        const SystemEquilibrium* from) {
  problem.check();
  const auto start = std::chrono::steady_clock::now();
  SystemEquilibrium result = has_sliding_clips(problem) ? solve_sliding(problem, options, context, from)
                                                        : NetworkSolver(problem, options).solve(context, from);
  if (options.error && result.ok()) estimate_errors(problem, options, context, result);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (Equilibrium& rod : result.rods) rod.seconds = seconds;
  return result;
}

Equilibrium solve(const RodProblem& problem, const SolveOptions& options, const RunContext& context,
                  const Equilibrium* from) {
  SystemProblem system;
  system.rods.push_back(problem);
  SystemEquilibrium warm;
  if (from) warm.rods.push_back(*from);
  return std::move(solve(system, options, context, from ? &warm : nullptr).rods.front());
}

}  // namespace tendril
