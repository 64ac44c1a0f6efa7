#include "statics/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "statics/solver.h"

namespace tendril {
namespace {

/// Largest distance of the common vertices; `fine` has a whole multiple of the segments of `coarse`.
double largest_difference(const Equilibrium& coarse, const Equilibrium& fine) {
  const std::size_t ratio = (fine.s.size() - 1) / (coarse.s.size() - 1);
  double largest = 0;
  for (std::size_t i = 0; i < coarse.s.size(); ++i)
    largest = std::max(largest, (coarse.points[i] - fine.points[i * ratio]).norm());
  return largest;
}

double own_order(const SolveOptions& options) {
  if (options.element == Element::se3) return 4;
  return options.clamp == ClampRule::thesis ? 1 : 2;
}

}  // namespace

ErrorEstimate estimate_error(const RodProblem& problem, const SolveOptions& options, const RunContext& context,
                             const Equilibrium& solution) {
  ErrorEstimate estimate;
  SolveOptions plain = options;
  plain.error = false;
  plain.tolerance = std::min(1e-12, options.tolerance);  // differences of meshes must not drown in unfinished iterations
  RodSolver twice(problem, plain, problem.rod.segments, 2), four_times(problem, plain, problem.rod.segments, 4);
  const Equilibrium finer = twice.solve(context, &solution);
  const Equilibrium finest = four_times.solve(context, finer.ok() ? &finer : &solution);
  if (!finer.ok() || !finest.ok()) {
    estimate.why = "the finer meshes were not solved: " + (finer.ok() ? finest : finer).message;
    estimate.value = solution.s.back();
    return estimate;
  }
  const double first = largest_difference(solution, finer), second = largest_difference(finer, finest);
  const double expected = own_order(options), length = solution.s.back();
  const double rounding = 1e-11 * length;
  if (first < rounding) {
    estimate.value = first;
    estimate.order = expected;
    estimate.valid = true;
    estimate.why = "at the level of rounding";
    return estimate;
  }
  estimate.order = std::log2(first / std::max(second, 1e-300));
  // first = e (1 - 2^-p), second = e 2^-p (1 - 2^-p): their sum plus what is beyond the finest mesh.
  const double p = std::clamp(estimate.order, 0.5 * expected, expected + 2);
  estimate.value = first + second / (1 - std::exp2(-p));
  estimate.valid = std::abs(estimate.order - expected) < 0.4 * expected + 0.2 || second < rounding;
  if (!estimate.valid) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the error falls with order %.1f where %.0f is expected: too few segments for this shape, or another "
                  "equilibrium on the finer mesh", estimate.order, expected);
    estimate.why = text;
  }
  return estimate;
}

}  // namespace tendril
