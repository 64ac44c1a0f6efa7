#include "scene/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "statics/solve.h"

namespace tendril {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<RodProblem> problems_of(const Scene& scene, const Surroundings* surroundings, int segments) {
  std::vector<RodProblem> problems;
  for (const auto& rod : scene.rods()) {
    problems.push_back(scene.problem_of(*rod));
    problems.back().rod.segments = segments;
    problems.back().surroundings = surroundings;
  }
  return problems;
}

/// One equilibrium a rod; stops early when one is not solved.
std::vector<Equilibrium> solve_all(const std::vector<RodProblem>& problems, const SolveOptions& options,
                                   const RunContext& context) {
  std::vector<Equilibrium> all;
  for (const RodProblem& problem : problems) {
    all.push_back(solve(problem, options, context));
    if (!all.back().ok()) break;
  }
  return all;
}

const Equilibrium* first_failure(const std::vector<Equilibrium>& all) {
  for (const Equilibrium& eq : all)
    if (!eq.ok()) return &eq;
  return nullptr;
}

/// The centre line to compare with: a fine solution, extrapolated from a coarser one when that is sound.
struct Reference {
  std::vector<Equilibrium> coarse, fine;
  bool extrapolated = false;
  double uncertainty = 0;

  Vec3 at(std::size_t rod, double s) const {
    const Vec3 best = fine[rod].frame_at(s).at;
    return extrapolated ? Vec3(best + (best - coarse[rod].frame_at(s).at) / 15) : best;
  }
};

double largest_distance(const std::vector<Equilibrium>& a, const std::vector<Equilibrium>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].s.size(); ++i)
      largest = std::max(largest, (a[k].points[i] - b[k].frame_at(a[k].s[i]).at).norm());
  return largest;
}

/// Solves with n, 2n and 4n segments; extrapolates when the differences fall by the factor 16 of a fourth-order element.
Reference make_reference(const Scene& scene, const Surroundings* surroundings, int n, const SolveOptions& options,
                         const RunContext& context, Accuracy& result) {
  SolveOptions best = options;
  best.element = Element::se3;
  best.error = false;
  best.tolerance = std::min(options.tolerance, 1e-11);
  Reference reference;
  std::vector<Equilibrium> first;
  for (auto [target, segments] : {std::pair{&first, n}, std::pair{&reference.coarse, 2 * n}, std::pair{&reference.fine, 4 * n}}) {
    *target = solve_all(problems_of(scene, surroundings, segments), best, context);
    if (const Equilibrium* failed = first_failure(*target)) {
      result.status = failed->status;
      result.message = "the reference with " + std::to_string(segments) + " segments: " + failed->message;
      return reference;
    }
  }
  const double before = largest_distance(first, reference.coarse), last = largest_distance(reference.coarse, reference.fine);
  reference.extrapolated = last > 0 && before / last > 12 && before / last < 20;
  // A sequence that does not fall (contact that slides a little) is known no better than its largest change.
  const bool falls = last < 0.5 * before || before == 0;
  reference.uncertainty = reference.extrapolated ? last / 15 : falls ? last : std::max(before, last);
  result.reference_segments = 4 * n;
  result.extrapolated = reference.extrapolated;
  result.reference_uncertainty = reference.uncertainty;
  return reference;
}

AccuracyRow measure(const std::vector<RodProblem>& problems, const AccuracyOptions& options, const RunContext& context,
                    const Reference& reference) {
  AccuracyRow row;
  row.segments = problems.front().rod.segments;
  SolveOptions timed = options.solve;
  timed.error = false;
  std::vector<double> seconds;
  std::vector<Equilibrium> all;
  double spent = 0;
  while (seconds.size() < 3 || (spent < options.seconds_each && seconds.size() < 200)) {
    const Clock::time_point start = Clock::now();
    all = solve_all(problems, timed, context);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    spent += seconds.back();
    if (first_failure(all)) break;
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  row.seconds = seconds[seconds.size() / 2];
  row.error = row.order = row.estimate = unknown;
  for (const Equilibrium& eq : all) row.iterations += eq.iterations;
  const Equilibrium* failed = first_failure(all);
  row.status = failed ? failed->status : Status::solved;
  if (failed) return row;
  row.error = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t i = 0; i < all[k].s.size(); ++i)
      row.error = std::max(row.error, (all[k].points[i] - reference.at(k, all[k].s[i])).norm());
  return row;
}

double estimate_of(const std::vector<RodProblem>& problems, const SolveOptions& options, const RunContext& context) {
  double largest = 0;
  for (const Equilibrium& eq : solve_all(problems, options, context)) {
    if (!eq.ok() || !eq.error || !eq.error->valid) return unknown;
    largest = std::max(largest, eq.error->value);
  }
  return largest;
}

void check(const Scene& scene, const AccuracyOptions& options) {
  if (scene.rods().empty()) throw UsageError("study.accuracy: the scene has no rods");
  if (options.segments.empty()) throw UsageError("study.accuracy: 'segments' is empty, expected a list of numbers");
  for (const int n : options.segments)
    if (n < 1 || n > Rod::max_segments / 4)
      throw UsageError("study.accuracy: 'segments' has " + std::to_string(n) + ", expected 1 to " +
                       std::to_string(Rod::max_segments / 4));
}

}  // namespace

bool Accuracy::unresolved() const {
  return std::any_of(rows.begin(), rows.end(), [&](const AccuracyRow& row) { return row.error < 2 * reference_uncertainty; });
}

std::string Accuracy::element() const {
  if (solve.element == Element::se3) return "se3";
  return solve.clamp == ClampRule::thesis ? "staggered, thesis's clamp" : "staggered";
}

Accuracy study_accuracy(const Scene& scene, const AccuracyOptions& options, const RunContext& context) {
  check(scene, options);
  Accuracy result;
  result.solve = options.solve;
  const auto surroundings = scene.surroundings();
  const int finest = *std::max_element(options.segments.begin(), options.segments.end());
  const Reference reference =
      make_reference(scene, surroundings.get(), finest, options.solve, context, result);
  if (result.status != Status::solved) return result;
  for (const int n : options.segments) {
    const std::vector<RodProblem> problems = problems_of(scene, surroundings.get(), n);
    AccuracyRow row = measure(problems, options, context, reference);
    if (options.solve.error && row.status == Status::solved) row.estimate = estimate_of(problems, options.solve, context);
    if (!result.rows.empty() && result.rows.back().error > 0 && row.error > 0 && result.rows.back().segments != n)
      row.order = std::log(result.rows.back().error / row.error) / std::log(double(n) / result.rows.back().segments);
    result.rows.push_back(row);
    if (const auto stop = context.stop()) {
      result.status = *stop;
      result.message = "stopped after " + std::to_string(result.rows.size()) + " of " + std::to_string(options.segments.size());
      return result;
    }
  }
  return result;
}

}  // namespace tendril
