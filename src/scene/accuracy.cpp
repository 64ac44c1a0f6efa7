#include "scene/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "statics/network_solver.h"
#include "statics/solve.h"

namespace tendril {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<Scene::System> systems_of(const Scene& scene, const Surroundings* surroundings, int segments) {
  std::vector<Scene::System> systems = scene.systems();
  for (Scene::System& system : systems)
    for (RodProblem& problem : system.problem.rods) {
      problem.rod.segments = segments;
      problem.surroundings = surroundings;
    }
  return systems;
}

/// One equilibrium a rod, in the scene's order. `refinement` 2: with every segment cut into two, so that every second
/// vertex is one of the coarser mesh.
std::vector<Equilibrium> solve_all(const std::vector<Scene::System>& systems, const SolveOptions& options,
                                   const RunContext& context, int refinement = 1) {
  std::vector<Equilibrium> all;
  for (const Scene::System& system : systems) {
    SystemEquilibrium solved = refinement == 1 ? solve(system.problem, options, context)
                                               : NetworkSolver(system.problem, options, refinement).solve(context);
    for (std::size_t k = 0; k < system.rods.size(); ++k) {
      const std::size_t rod = static_cast<std::size_t>(system.rods[k]);
      if (all.size() <= rod) all.resize(rod + 1);
      all[rod] = std::move(solved.rods[k]);
    }
  }
  return all;
}

/// The counts of rods that hang together are those of all of them.
int iterations_of(const std::vector<Scene::System>& systems, const std::vector<Equilibrium>& all) {
  int sum = 0;
  for (const Scene::System& system : systems) sum += all.empty() ? 0 : all[system.rods.front()].iterations;
  return sum;
}

const Equilibrium* first_failure(const std::vector<Equilibrium>& all) {
  for (const Equilibrium& eq : all)
    if (!eq.ok()) return &eq;
  return nullptr;
}

double least_slope(double before, double after) {
  if (before * after <= 0) return 0;
  return std::abs(before) < std::abs(after) ? before : after;
}

/// The centre line between the vertices, with its tangents from the strains too (Equilibrium::frame_at takes the directors,
/// which is off by the strain times a part of the segment). The strain varies linearly along a segment, as slowly as towards
/// its neighbours: it may jump where a load acts.
Vec3 place_at(const Equilibrium& eq, double arc_length) {
  const auto above = std::upper_bound(eq.s.begin(), eq.s.end(), arc_length);
  const int last = static_cast<int>(eq.s.size()) - 2;
  const int i = std::clamp<int>(static_cast<int>(above - eq.s.begin()) - 1, 0, last);
  Vec3 half_change;
  const Vec3 here = eq.strains[i];
  for (int k = 0; k < 3; ++k) {
    const double before = i > 0 ? here[k] - eq.strains[i - 1][k] : eq.strains[std::min(1, last)][k] - here[k];
    const double after = i < last ? eq.strains[i + 1][k] - here[k] : before;
    half_change[k] = 0.5 * least_slope(before, after);
  }
  const double h = eq.s[i + 1] - eq.s[i];
  const double t = std::clamp((arc_length - eq.s[i]) / h, 0.0, 1.0), u = 1 - t;
  const Vec3 ta = h * (eq.rotations[i] * Vec3(Vec3::UnitZ() + here - half_change));
  const Vec3 tb = h * (eq.rotations[i + 1] * Vec3(Vec3::UnitZ() + here + half_change));
  return (1 + 2 * t) * u * u * eq.points[i] + t * t * (3 - 2 * t) * eq.points[i + 1] + t * u * u * ta - t * t * u * tb;
}

/// The centre line to compare with: what is known exactly, else a fine solution, extrapolated from a coarser one when that
/// is sound.
struct Reference {
  std::function<Vec3(std::size_t, double)> exact;
  std::vector<Equilibrium> coarse, fine;
  bool extrapolated = false;
  double uncertainty = 0;

  Vec3 at(std::size_t rod, double s) const {
    if (exact) return exact(rod, s);
    const Vec3 best = place_at(fine[rod], s);
    return extrapolated ? Vec3(best + (best - place_at(coarse[rod], s)) / 15) : best;
  }
};

double largest_distance(const std::vector<Equilibrium>& a, const std::vector<Equilibrium>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].s.size(); ++i)
      largest = std::max(largest, (a[k].points[i] - place_at(b[k], a[k].s[i])).norm());
  return largest;
}

/// Solves with n, 2n and 4n segments; extrapolates when the differences fall by the factor 16 of a fourth-order element.
Reference make_reference(const Scene& scene, const Surroundings* surroundings, int n, const AccuracyOptions& options,
                         const RunContext& context, Accuracy& result) {
  Reference reference;
  reference.exact = options.exact;
  if (reference.exact) return reference;
  SolveOptions best = options.solve;
  best.element = Element::se3;
  best.error = false;
  best.tolerance = std::min(options.solve.tolerance, 1e-11);
  std::vector<Equilibrium> first;
  for (auto [target, segments] : {std::pair{&first, n}, std::pair{&reference.coarse, 2 * n}, std::pair{&reference.fine, 4 * n}}) {
    *target = solve_all(systems_of(scene, surroundings, segments), best, context);
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

/// What one row measures: a solution a rod, or two with half the segments in the first.
struct Solutions {
  std::vector<Equilibrium> half, whole;
  int iterations = 0;

  const Equilibrium* failure() const {
    const Equilibrium* failed = first_failure(half);
    return failed ? failed : first_failure(whole);
  }
};

/// The vertices' places, extrapolated where there is a coarser solution: then only those that both meshes have.
void add_errors(const Solutions& solved, double order, const Reference& reference, double& largest) {
  const double gain = 1 / (std::exp2(order) - 1);
  for (std::size_t k = 0; k < solved.whole.size(); ++k) {
    const Equilibrium& whole = solved.whole[k];
    const std::size_t stride = solved.half.empty() ? 1 : 2;
    for (std::size_t i = 0; i < whole.s.size(); i += stride) {
      Vec3 place = whole.points[i];
      if (stride == 2) place += gain * (place - solved.half[k].points[i / 2]);
      largest = std::max(largest, (place - reference.at(k, whole.s[i])).norm());
    }
  }
}

Solutions solve_row(const Scene& scene, const Surroundings* surroundings, int segments, const AccuracyOptions& options,
                    const RunContext& context, std::vector<double>& seconds) {
  SolveOptions timed = options.solve;
  timed.error = false;
  const std::vector<Scene::System> systems =
      systems_of(scene, surroundings, options.extrapolate ? segments / 2 : segments);
  Solutions solved;
  double spent = 0;
  while (seconds.size() < 3 || (spent < options.seconds_each && seconds.size() < 2000)) {
    const Clock::time_point start = Clock::now();
    if (options.extrapolate) solved.half = solve_all(systems, timed, context);
    solved.whole = solve_all(systems, timed, context, options.extrapolate ? 2 : 1);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    spent += seconds.back();
    if (solved.failure()) break;
  }
  solved.iterations = iterations_of(systems, solved.half) + iterations_of(systems, solved.whole);
  return solved;
}

AccuracyRow measure(const Scene& scene, const Surroundings* surroundings, int segments, const AccuracyOptions& options,
                    const RunContext& context, const Reference& reference) {
  AccuracyRow row;
  row.segments = segments;
  row.error = row.order = row.estimate = unknown;
  std::vector<double> seconds;
  const Solutions solved = solve_row(scene, surroundings, segments, options, context, seconds);
  std::sort(seconds.begin(), seconds.end());
  row.fastest = seconds.front();
  row.seconds = seconds[seconds.size() / 2];
  row.iterations = solved.iterations;
  const Equilibrium* failed = solved.failure();
  row.status = failed ? failed->status : Status::solved;
  if (failed) return row;
  row.error = 0;
  const SolveOptions& used = options.solve;
  const double order = used.element == Element::se3 ? 4 : used.clamp == ClampRule::thesis ? 1 : 2;
  add_errors(solved, order, reference, row.error);
  return row;
}

double estimate_of(const std::vector<Scene::System>& systems, const SolveOptions& options, const RunContext& context) {
  double largest = 0;
  for (const Equilibrium& eq : solve_all(systems, options, context)) {
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
  for (const int n : options.segments)
    if (options.extrapolate && n % 2 != 0)
      throw UsageError("study.accuracy: 'segments' has " + std::to_string(n) +
                       ", expected even numbers: extrapolation solves with half as many too");
}

}  // namespace

bool Accuracy::unresolved() const {
  return std::any_of(rows.begin(), rows.end(), [&](const AccuracyRow& row) { return row.error < 2 * reference_uncertainty; });
}

std::string Accuracy::element() const {
  const std::string plain = solve.element == Element::se3          ? "se3"
                            : solve.clamp == ClampRule::thesis ? "staggered, thesis's clamp"
                                                               : "staggered";
  return plain + (row_extrapolated ? ", extrapolated" : "");
}

Accuracy study_accuracy(const Scene& scene, const AccuracyOptions& options, const RunContext& context) {
  check(scene, options);
  Accuracy result;
  result.solve = options.solve;
  result.row_extrapolated = options.extrapolate;
  const auto surroundings = scene.surroundings();
  const int finest = *std::max_element(options.segments.begin(), options.segments.end());
  const Reference reference = make_reference(scene, surroundings.get(), finest, options, context, result);
  if (result.status != Status::solved) return result;
  for (const int n : options.segments) {
    AccuracyRow row = measure(scene, surroundings.get(), n, options, context, reference);
    if (options.solve.error && row.status == Status::solved)
      row.estimate = estimate_of(systems_of(scene, surroundings.get(), n), options.solve, context);
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
