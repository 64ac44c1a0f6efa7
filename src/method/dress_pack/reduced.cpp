#include "method/dress_pack/reduced.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::dress_pack {
namespace {

constexpr double smallest_radius = 1e-9;  // rad
constexpr double smallest_step = 1e-9;    // rad

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

class Search {
 public:
  Search(ReducedProblem& problem, const LinearLimits& limits, const ReducedOptions& options)
      : problem_(problem), limits_(limits), options_(options), radius_(options.first_radius) {}

  void run(const RunContext& context, ReducedResult& out) {
    out.status = Status::solved;
    out.message = "solved";
    if (problem_.variables() == 0) return;
    bool stale = true;
    while (out.iterations < options_.most_iterations) {
      if (stop(context, out)) return;
      if (stale && !problem_.derivatives(gradient_, hessian_, context)) {
        if (!stop(context, out)) fail("a state is not stable", out);
        return;
      }
      const Eigen::VectorXd u = problem_.values();
      const TrustStep step = trust_step(gradient_, hessian_, limits_, u, radius_);
      const double size = step.step.norm();
      if (step.reduction <= options_.tolerance * std::abs(problem_.objective()) && !step.at_edge) return;
      if (size < smallest_step) return;
      if (radius_ < smallest_radius) return fail("no step improves the path any more", out);
      ++out.iterations;
      const ReducedProblem::Trial trial = problem_.try_values(u + step.step, context);
      if (stop(context, out)) return;
      stale = judge(step, size, trial, out);
      if (context.progress) context.progress(std::min(0.99, out.iterations / (out.iterations + 5.0)), "optimisation");
    }
    fail("not finished in " + std::to_string(options_.most_iterations) + " iterations", out);
  }

 private:
  bool judge(const TrustStep& step, double size, const ReducedProblem::Trial& trial, ReducedResult& out) {
    const double gain = trial.ok() ? problem_.objective() - trial.objective : -1;
    const double ratio = gain / std::max(step.reduction, 1e-300);
    const bool accepted = trial.ok() && gain > 0 && ratio > 1e-4;
    out.history.push_back({accepted ? trial.objective : problem_.objective(), size, radius_, accepted});
    if (ratio < 0.25) radius_ = 0.3 * size;
    if (ratio > 0.7 && step.at_edge) radius_ *= 2;
    if (accepted) problem_.accept();
    return accepted;
  }

  static bool stop(const RunContext& context, ReducedResult& out) {
    const auto why = context.stop();
    if (!why) return false;
    out.status = *why;
    out.message = *why == Status::timeout ? "out of time; this is the best path so far" : "interrupted; this is the best path so far";
    return true;
  }
  static void fail(const std::string& why, ReducedResult& out) {
    out.status = Status::stalled;
    out.message = why + "; this is the best path so far";
  }

  ReducedProblem& problem_;
  const LinearLimits& limits_;
  const ReducedOptions& options_;
  double radius_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
};

/// Followed from its start, the rods on the optimised path may take another way than those that were moved there.
void compare(const ReducedProblem& problem, ReducedResult& out) {
  if (!out.ok() || !out.after.ok()) return;
  double most = 0;
  for (std::size_t k = 0; k < problem.states().size(); ++k)
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

ReducedResult optimise(const PackProblem& given, const JointPath& given_path, const ReducedOptions& options, const RunContext& context) {
  given.check();
  check(options, *given.robot);
  const Clock::time_point begin = Clock::now();
  PackProblem pack = given;
  pack.bodies.clear();
  ReducedResult out;
  out.path = options.via > 0 ? given_path.resampled(options.via) : given_path;
  const std::string beyond = beyond_robot(out.path, *pack.robot, options.seconds);
  if (!beyond.empty()) {
    out.status = Status::infeasible;
    out.message = "the path cannot be improved from where it starts: " + beyond;
    return out;
  }
  SimulationOptions simulation;
  simulation.steps = options.steps;
  out.before = simulate(pack, out.path, simulation, context);
  const Clock::time_point search_begin = Clock::now();
  ReducedProblem problem(pack, out.path, options.steps, options.demands, options.weights);
  const PackFollower::Outcome start = problem.start(context);
  if (!start.ok()) {
    const bool stopped = start.status == Status::cancelled || start.status == Status::timeout;
    out.status = stopped ? start.status : Status::infeasible;
    out.message = stopped ? "interrupted before the path was followed once" : "the rods cannot follow the path: " + out.before.message;
    return out;
  }
  out.objective_before = problem.objective();
  const LinearLimits limits = limits_of(*pack.robot, out.path, options.seconds);
  Search(problem, limits, options).run(context, out);
  out.search_seconds = since(search_begin);
  out.objective = problem.objective();
  out.path = problem.path();
  out.after = simulate(pack, out.path, simulation, context);
  compare(problem, out);
  out.seconds = since(begin);
  return out;
}

}  // namespace tendril::dress_pack
