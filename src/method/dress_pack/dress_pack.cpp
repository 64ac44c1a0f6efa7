#include "method/dress_pack/dress_pack.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "method/dress_pack/direct.h"
#include "method/dress_pack/multi_start.h"

namespace tendril::dress_pack {
namespace {

constexpr int most_rounds = 4;
constexpr double early = 0.9;     // of a limit: from there on it counts
constexpr double scale = 0.5;     // of a limit, in the first round
constexpr double sharper = 0.5;   // from round to round
constexpr double smallest_force = 1e-6;  // N, that can be a unit

/// Of a quantity that should stay below `limit`.
Demand below(double limit, int round) { return {early * limit, scale * limit * std::pow(sharper, round)}; }

class Method {
 public:
  Method(const PackProblem& pack, const Options& options, const RunContext& context, Result& out)
      : pack_(pack), options_(options), context_(context), out_(out), clock_(out.steps) {}

  void run(const JointPath& path) {
    if (!begin(path)) return finish();
    simulate_given();
    if (!out_.before.ok() && !out_.before.steps.empty() && is_stop(out_.before.status)) return finish();
    if (options_.optimise) optimise();
    if (!is_stop(out_.status) && out_.status != Status::infeasible) simulate_found();
    finish();
  }

 private:
  static bool is_stop(Status status) { return status == Status::cancelled || status == Status::timeout; }

  /// Joints and speeds are the robot's business alone: no rod is asked.
  bool begin(const JointPath& path) {
    out_.given = out_.path = options_.via > 0 ? path.resampled(options_.via) : path;
    const std::string beyond = beyond_robot(out_.given, *pack_.robot, options_.seconds);
    if (beyond.empty()) return true;
    out_.status = Status::infeasible;
    out_.message = beyond;
    return false;
  }

  PackMotion simulated(const JointPath& path) {
    SimulationOptions simulation;
    simulation.steps = options_.checked_steps;
    simulation.robot_clearance = options_.limits.robot_clearance >= 0;
    return simulate(pack_, path, simulation, context_);
  }

  void simulate_given() {
    out_.before = simulated(out_.given);
    out_.unmet_before = unmet_of(pack_, out_.before, options_.limits);
    out_.status = out_.before.status;
    out_.message = out_.before.message;
    clock_.end("simulation of the given path", counts(out_.before));
  }

  /// Rounds of ever stronger demands, until the limits are kept, or sharper ones do no more.
  void optimise() {
    double worst = INFINITY;
    for (int round = 0; round < most_rounds; ++round) {
      const ReducedResult found = search(round);
      out_.status = found.status;
      out_.message = found.message;
      out_.history.insert(out_.history.end(), found.history.begin(), found.history.end());
      out_.iterations += found.iterations;
      out_.objective_before = found.objective_before;
      out_.objective = found.objective;
      if (found.status == Status::infeasible) break;
      out_.path = found.path;
      out_.after = found.after;
      const double beyond = worst_excess(unmet_of(pack_, found.after, options_.limits));
      if (is_stop(found.status) || beyond <= 0 || beyond > 0.9 * worst) break;
      worst = beyond;
    }
    clock_.end("optimisation of the via points", {{"iterations", out_.iterations}});
  }

  ReducedResult search(int round) {
    ReducedOptions search;
    search.steps = options_.steps;
    search.seconds = options_.seconds;
    search.demands = demands_of(options_.limits, out_.before.largest_end_force(), round);
    search.weights = options_.weights;
    search.tolerance = options_.tolerance;
    search.most_iterations = options_.most_iterations;
    // Later rounds go on from the best of the starts.
    if (options_.starts > 1 && round == 0) {
      MultiStartOptions several;
      several.search = search;
      several.starts = options_.starts;
      return optimise_from_starts(pack_, out_.path, several, context_);
    }
    if (options_.formulation == Formulation::reduced) return dress_pack::optimise(pack_, out_.path, search, context_);
    DirectResult found = optimise_direct(pack_, out_.path, search, context_);
    out_.violation = found.violation;
    return found;
  }

  void simulate_found() {
    if (!options_.optimise) {
      out_.after = out_.before;
      return;
    }
    out_.after = simulated(out_.path);
    clock_.end("simulation of the optimised path", counts(out_.after));
    if (!out_.after.ok()) {
      out_.status = out_.after.status;
      out_.message = "the optimised path: " + out_.after.message;
    }
  }

  void finish() {
    out_.seconds = clock_.seconds();
    if (out_.after.steps.empty()) return;
    out_.unmet = unmet_of(pack_, out_.after, options_.limits);
    out_.ok = out_.status == Status::solved && out_.unmet.empty();
    if (out_.status != Status::solved || out_.unmet.empty()) return;
    out_.status = Status::infeasible;
    out_.message = std::string(options_.optimise ? "the best path found has " : "the path has ") + out_.unmet.front().text;
    if (out_.unmet.size() > 1) out_.message += ", and " + std::to_string(out_.unmet.size() - 1) + " more";
  }

  /// Of what a via point can change, relative to the limit.
  static double worst_excess(const std::vector<Unmet>& unmet) {
    double most = 0;
    for (const Unmet& u : unmet)
      if (!u.at_end) most = std::max(most, std::abs(u.value - u.demanded) / std::max(std::abs(u.demanded), 1e-9));
    return most;
  }
  static std::vector<std::pair<std::string, long>> counts(const PackMotion& motion) {
    return {{"time steps", static_cast<long>(motion.steps.size())}, {"snap-throughs", static_cast<long>(motion.snaps.size())}};
  }

  const PackProblem& pack_;
  const Options& options_;
  const RunContext& context_;
  Result& out_;
  StepClock clock_;
};

}  // namespace

const char* name_of(Formulation formulation) { return formulation == Formulation::reduced ? "reduced" : "direct"; }

PackDemands demands_of(const Limits& limits, double usual_force, int round) {
  PackDemands demands;
  if (std::isfinite(limits.max_tension)) {
    demands.force = below(limits.max_tension, round);
  } else {
    demands.force = {0, std::isfinite(usual_force) && usual_force > smallest_force ? usual_force : 1};
  }
  if (std::isfinite(limits.max_twist)) demands.twist = below(limits.max_twist, round);
  if (limits.min_bend_radius > 0) demands.curvature = below(1 / limits.min_bend_radius, round);
  demands.clearance = limits.clearance;
  demands.robot_clearance = limits.robot_clearance;
  return demands;
}

Result run(const PackProblem& pack, const JointPath& path, const Options& options, const RunContext& context) {
  pack.check();
  options.limits.check();
  if (options.checked_steps < 1) throw UsageError("dress pack: " + std::to_string(options.checked_steps) + " checked steps, expected at least 1");
  if (options.starts < 1) throw UsageError("dress pack: " + std::to_string(options.starts) + " starts, expected at least 1");
  if (options.starts > 1 && options.formulation == Formulation::direct)
    throw UsageError("dress pack: " + std::to_string(options.starts) + " starts by the direct formulation, expected 1; the reduced one takes several");
  Result out;
  out.limits = options.limits;
  out.duration = options.seconds;
  Method(pack, options, context, out).run(path);
  return out;
}

}  // namespace tendril::dress_pack
