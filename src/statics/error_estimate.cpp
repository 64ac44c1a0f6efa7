#include "statics/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "statics/network_solver.h"

namespace tendril {
namespace {

/// A line about which the whole rod may turn at no cost.
struct SpinAxis {
  Vec3 origin, direction;
};

/// Round sections, straight at rest, no load across the line, and every held place on it with its tangent along it.
std::optional<SpinAxis> spin_axis(const RodProblem& problem) {
  if (problem.surroundings || problem.rod.shape || !problem.loads.empty() || problem.holds.size() < 2) return {};
  for (const RodPart& part : problem.rod.parts)
    if (part.section.EI1 != part.section.EI2 || part.section.GA1 != part.section.GA2) return {};
  SpinAxis axis{problem.holds[0].frame.at, Vec3::Zero()};
  for (const Hold& hold : problem.holds)
    if (hold.orientation)
      axis.direction = hold.frame.d3();
    else if (axis.direction.isZero(0) && hold.frame.at != axis.origin)
      axis.direction = (hold.frame.at - axis.origin).normalized();
  if (axis.direction.isZero(0)) return {};
  for (const Hold& hold : problem.holds) {
    if (hold.position && axis.direction.cross(hold.frame.at - axis.origin).norm() > 1e-9 * problem.rod.length) return {};
    if (hold.orientation && axis.direction.cross(hold.frame.d3()).norm() > 1e-9) return {};
  }
  if (problem.rod.mass() > 0 && axis.direction.cross(problem.gravity).norm() > 1e-9 * problem.gravity.norm()) return {};
  return axis;
}

/// Largest distance of the common vertices; `fine` has a whole multiple of the segments of `coarse`. With an axis, after
/// turning `fine` about it as near to `coarse` as it gets: which of all the turned shapes a solution is says nothing.
double largest_difference(const Equilibrium& coarse, const Equilibrium& fine, const std::optional<SpinAxis>& axis) {
  const std::size_t ratio = (fine.s.size() - 1) / (coarse.s.size() - 1);
  Mat3 turn = Mat3::Identity();
  const Vec3 origin = axis ? axis->origin : Vec3(Vec3::Zero());
  if (axis) {
    double sine = 0, cosine = 0;
    for (std::size_t i = 0; i < coarse.s.size(); ++i) {
      const Vec3 a = axis->direction.cross(fine.points[i * ratio] - origin);
      const Vec3 b = axis->direction.cross(coarse.points[i] - origin);
      sine += axis->direction.dot(a.cross(b));
      cosine += a.dot(b);
    }
    turn = Eigen::AngleAxisd(std::atan2(sine, cosine), axis->direction).toRotationMatrix();
  }
  double largest = 0;
  for (std::size_t i = 0; i < coarse.s.size(); ++i)
    largest = std::max(largest, (coarse.points[i] - origin - turn * (fine.points[i * ratio] - origin)).norm());
  return largest;
}

double own_order(const SolveOptions& options) {
  if (options.element == Element::se3) return 4;
  return options.clamp == ClampRule::thesis ? 1 : 2;
}

/// Below this order the extrapolation is not to be trusted. The fourth-order element leaves a small second-order error
/// under distributed load (the weight's effect on the stretch), which shows on fine meshes. Contact forces jump from
/// point to point, which leaves about first order.
double lowest_order(const RodProblem& problem, const SolveOptions& options) {
  if (problem.surroundings) return 0.5;
  return options.element == Element::se3 ? 1.8 : 0.6 * own_order(options) - 0.2;
}

/// From one rod on three meshes.
ErrorEstimate compare(const RodProblem& problem, const SolveOptions& options, const std::optional<SpinAxis>& axis,
                      const Equilibrium& solution, const Equilibrium& finer, const Equilibrium& finest) {
  ErrorEstimate estimate;
  const double first = largest_difference(solution, finer, axis), second = largest_difference(finer, finest, axis);
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
  const double p = std::clamp(estimate.order, std::min(0.5 * expected, lowest_order(problem, options)), expected + 2);
  estimate.value = first + second / (1 - std::exp2(-p));
  estimate.valid = (estimate.order > lowest_order(problem, options) && estimate.order < 1.4 * expected + 0.2) || second < rounding;
  if (!estimate.valid) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "the error falls with order %.1f where %.0f is expected: too few segments for this shape, or another "
                  "equilibrium on the finer mesh", estimate.order, expected);
    estimate.why = text;
  }
  return estimate;
}

/// Sliding sections held where they have come to rest.
SystemProblem with_clips_settled(const SystemProblem& problem, const SystemEquilibrium& solution) {
  SystemProblem settled = problem;
  for (std::size_t k = 0; k < settled.rods.size(); ++k)
    for (std::size_t h = 0; h < settled.rods[k].holds.size(); ++h) {
      Hold& hold = settled.rods[k].holds[h];
      if (hold.slide && hold.cut_at < 0) hold.cut_at = hold.at;
      if (hold.slide) hold.at = solution.rods[k].reactions[h].s;
    }
  return settled;
}

bool any_surroundings(const SystemProblem& problem) {
  return std::any_of(problem.rods.begin(), problem.rods.end(), [](const RodProblem& rod) { return rod.surroundings; });
}

}  // namespace

void estimate_errors(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                     SystemEquilibrium& solution) {
  SolveOptions plain = options;
  plain.error = false;
  plain.tolerance = std::min(1e-12, options.tolerance);  // differences of meshes must not drown in unfinished iterations
  const SystemProblem settled = with_clips_settled(problem, solution);
  NetworkSolver twice(settled, plain, 2), four_times(settled, plain, 4);
  // In contact a warm start would carry the contact forces over, and with them the error that is looked for.
  const bool warm = !any_surroundings(problem);
  const SystemEquilibrium finer = twice.solve(context, warm ? &solution : nullptr);
  const SystemEquilibrium finest = four_times.solve(context, !warm ? nullptr : finer.ok() ? &finer : &solution);
  for (std::size_t k = 0; k < solution.rods.size(); ++k) {
    Equilibrium& rod = solution.rods[k];
    if (!finer.ok() || !finest.ok()) {
      ErrorEstimate estimate;
      estimate.why = "the finer meshes were not solved: " + (finer.ok() ? finest : finer).rods[k].message;
      estimate.value = rod.s.back();
      rod.error = estimate;
      continue;
    }
    const bool alone = solution.rods.size() == 1;
    rod.error = compare(problem.rods[k], options, alone ? spin_axis(problem.rods[k]) : std::nullopt, rod, finer.rods[k],
                        finest.rods[k]);
  }
}

}  // namespace tendril
