#include "statics/solve.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "statics/error_estimate.h"
#include "statics/solver.h"

namespace tendril {

Equilibrium solve(const RodProblem& problem, const SolveOptions& options, const RunContext& context,
                  const Equilibrium* from) {
  problem.check();
  const auto start = std::chrono::steady_clock::now();
  RodSolver solver(problem, options, problem.rod.segments);
  Equilibrium result = solver.solve(context, from);
  if (options.error && result.ok()) result.error = estimate_error(problem, options, context, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace tendril
