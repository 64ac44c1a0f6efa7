#include "method/dress_pack/reduced.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "method/dress_pack/clearance_search.h"
#include "method/dress_pack/path_start.h"
#include "method/dress_pack/trust_search.h"

namespace tendril::dress_pack {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Followed from its start, the rods on the optimised path may take another way than those that were moved there.
void compare(const ReducedProblem& problem, ReducedResult& out) {
  if (!out.ok() || !out.after.ok()) return;
  double most = 0;
  for (std::size_t k = 0; k < std::min(problem.states().size(), out.after.steps.size()); ++k)
    for (std::size_t i = 0; i < problem.states()[k].r.size(); ++i)
      most = std::max(most, (problem.states()[k].r[i] - out.after.steps[k].state.r[i]).norm());
  if (most > 1e-3)
    out.message = "solved; but followed from its start the rods take another way, by up to " + number_text(most) +
                  " m: see what the motion says";
}

}  // namespace

void check(const ReducedOptions& options, const Robot& robot) {
  options.demands.check();
  if (options.steps < 1) throw UsageError("dress pack: " + std::to_string(options.steps) + " time steps, expected at least 1");
  if (options.via < 0 || options.via == 1) throw UsageError("dress pack: " + std::to_string(options.via) + " via points, expected at least 2");
  if (!(options.seconds >= 0) || !std::isfinite(options.seconds))
    throw UsageError("dress pack: the path takes " + number_text(options.seconds) + " s, expected at least 0");
  if (!(options.weights.effort >= 0) || !std::isfinite(options.weights.effort))
    throw UsageError("dress pack: the weight of the path is " + number_text(options.weights.effort) + ", expected at least 0");
  if (!options.weights.joints.empty() && static_cast<int>(options.weights.joints.size()) != robot.size())
    throw UsageError("dress pack: " + std::to_string(options.weights.joints.size()) + " weights for " + std::to_string(robot.size()) + " joints");
  for (const double weight : options.weights.joints)
    if (!std::isfinite(weight) || weight < 0)
      throw UsageError("dress pack: the weight of a joint is " + number_text(weight) + ", expected a number of at least 0");
  if (!(options.tolerance > 0) || !(options.first_radius > 0) || !std::isfinite(options.first_radius))
    throw UsageError("dress pack: tolerance and radius must be positive numbers");
}

LinearLimits limits_of(const Robot& robot, const JointPath& path, double seconds) {
  const int n = path.size(), free = std::max(0, path.points() - 2), size = n * free;
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> most;
  const auto add = [&](int plus, int minus, double limit) {
    if (std::isinf(limit)) return;
    Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
    if (plus >= 0) row[plus] = 1;
    if (minus >= 0) row[minus] = -1;
    rows.push_back(row);
    most.push_back(limit);
  };
  for (int j = 0; j < free; ++j)
    for (int i = 0; i < n; ++i) {
      add(j * n + i, -1, robot.upper()[i]);
      add(-1, j * n + i, -robot.lower()[i]);
    }
  for (int p = 0; seconds > 0 && free > 0 && p + 1 < path.points(); ++p)
    for (int i = 0; i < n; ++i) {
      const double reach = robot.variable(i).velocity * seconds / (path.points() - 1);
      const int a = p >= 1 ? (p - 1) * n + i : -1, b = p + 1 <= free ? p * n + i : -1;
      // What is fixed at the ends goes to the other side.
      const double fixed = (a < 0 ? path.via().front()[i] : 0) - (b < 0 ? path.via().back()[i] : 0);
      add(b, a, reach + fixed);
      add(a, b, reach - fixed);
    }
  LinearLimits out;
  out.rows.resize(static_cast<int>(rows.size()), size);
  out.most.resize(static_cast<int>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    out.rows.row(static_cast<int>(k)) = rows[k].transpose();
    out.most[static_cast<int>(k)] = most[k];
  }
  return out;
}

namespace {

constexpr int finer = 5;        // times the time steps of the search, where clearances are verified
constexpr int most_rounds = 3;  // of tightening, when they fall short between the time steps

/// The path as found, simulated among the bodies at more time steps than the search had; keeps every so-manieth.
PackMotion verified(const PackProblem& pack, const ReducedOptions& options, const RunContext& context, ReducedResult& out) {
  SimulationOptions simulation;
  simulation.steps = finer * options.steps;
  simulation.robot_clearance = options.demands.robot_clearance >= 0;
  PackMotion motion = simulate(pack, out.path, simulation, context);
  out.clearance = motion.smallest_clearance();
  out.robot_clearance = motion.smallest_robot_clearance();
  std::vector<PackStep> kept;
  for (std::size_t k = 0; k < motion.steps.size(); k += finer) kept.push_back(std::move(motion.steps[k]));
  motion.steps = std::move(kept);
  return motion;
}

double missing_between(const ReducedOptions& options, const ReducedResult& out) {
  double missing = 0;
  if (options.demands.clearance >= 0) missing = std::max(missing, options.demands.clearance - out.clearance);
  if (options.demands.robot_clearance >= 0) missing = std::max(missing, options.demands.robot_clearance - out.robot_clearance);
  return missing;
}

/// Searches with clearances, verifies, and asks for more where they fall short between the time steps.
void search_clear(const PackProblem& pack, ReducedProblem& problem, const LinearLimits& limits, const ReducedOptions& options,
                  const RunContext& context, ReducedResult& out) {
  ClearanceSearch search(problem, limits, options);
  const std::string refused = search.ends_refused();
  if (!refused.empty()) {
    out.status = Status::infeasible;
    out.message = refused;
    return;
  }
  double reserve = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const bool found = search.run(reserve, context, out);
    out.path = problem.path();
    out.objective = problem.plain_objective();
    const Clock::time_point begin = Clock::now();
    out.after = verified(pack, options, context, out);
    out.verification_seconds += since(begin);
    if (!found || out.status != Status::solved) return;
    if (!out.after.ok()) {
      out.status = out.after.status;
      out.message = "the path that was found, followed among the bodies: " + out.after.message;
      return;
    }
    const double missing = missing_between(options, out);
    if (missing <= clearance_tolerance) return;
    reserve += 1.1 * missing;
  }
  out.status = Status::infeasible;
  out.message = "between the time steps clearances fall short by " + number_text(1e3 * missing_between(options, out)) + " mm; give more time steps";
}

}  // namespace

ReducedResult optimise(const PackProblem& given, const JointPath& given_path, const ReducedOptions& options, const RunContext& context) {
  given.check();
  check(options, *given.robot);
  const Clock::time_point begin = Clock::now();
  const bool clear = options.demands.clearance >= 0 || options.demands.robot_clearance >= 0;
  PackProblem bare = given;
  bare.bodies.clear();
  ReducedResult out;
  if (!take_path(bare, given_path, options, context, out)) return out;
  const Clock::time_point search_begin = Clock::now();
  ReducedProblem problem(given, out.path, options.steps, options.demands, options.weights);
  if (!follow_once(problem, context, out)) return out;
  out.objective = out.objective_before = problem.plain_objective();
  const LinearLimits limits = limits_of(*given.robot, out.path, options.seconds);
  if (clear) {
    search_clear(given, problem, limits, options, context, out);
  } else {
    trust_search(problem, limits, {options.tolerance, options.most_iterations, options.first_radius}, context, out);
    out.objective = problem.plain_objective();
    out.path = problem.path();
  }
  out.search_seconds = since(search_begin) - out.verification_seconds;
  if (!clear) {
    SimulationOptions simulation;
    simulation.steps = options.steps;
    out.after = simulate(bare, out.path, simulation, context);
  }
  compare(problem, out);
  out.seconds = since(begin);
  return out;
}

}  // namespace tendril::dress_pack
