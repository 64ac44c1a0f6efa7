#include "method/dress_pack/parameters.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "method/dress_pack/trust_step.h"

namespace tendril::dress_pack {
namespace {

constexpr double smallest_radius = 1e-7;  // share of the bounds' distance
constexpr double damping = 0.2;           // Powell's

void check(const PackProblem& pack, const std::vector<PackParameter>& parameters, const std::vector<PackTask>& tasks,
           const ParameterOptions& options) {
  pack.check();
  options.demands.check();
  if (parameters.empty()) throw UsageError("dress pack: no parameters, expected at least one to optimise");
  if (tasks.empty()) throw UsageError("dress pack: no paths, expected at least one to optimise parameters for");
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const PackParameter& p = parameters[k];
    if (!p.apply) throw UsageError("dress pack: parameter '" + p.name + "' changes nothing");
    if (!std::isfinite(p.lower) || !std::isfinite(p.upper) || !(p.lower < p.upper))
      throw UsageError("dress pack: the bounds of '" + p.name + "' are " + number_text(p.lower) + " and " + number_text(p.upper) +
                       ", expected two numbers in rising order");
    if (!(p.start >= p.lower && p.start <= p.upper))
      throw UsageError("dress pack: '" + p.name + "' starts at " + number_text(p.start) + ", expected " + number_text(p.lower) + " to " + number_text(p.upper));
    for (std::size_t i = 0; i < k; ++i)
      if (parameters[i].name == p.name) throw UsageError("dress pack: parameter '" + p.name + "' is given twice");
  }
  for (const PackTask& task : tasks)
    if (!(task.weight >= 0) || !std::isfinite(task.weight))
      throw UsageError("dress pack: the weight of a path is " + number_text(task.weight) + ", expected at least 0");
  if (options.steps < 1) throw UsageError("dress pack: " + std::to_string(options.steps) + " time steps, expected at least 1");
  if (!std::isfinite(options.length_weight))
    throw UsageError("dress pack: the weight of the length is " + number_text(options.length_weight) + ", expected a number");
  if (!(options.tolerance > 0) || !(options.first_radius > 0) || !std::isfinite(options.first_radius))
    throw UsageError("dress pack: tolerance and radius must be positive numbers");
  if (options.demands.clearance >= 0 || options.demands.robot_clearance >= 0)
    throw UsageError("dress pack: parameters are optimised without clearance; leave it out");
}

LinearLimits unit_box(int size) {
  LinearLimits out{Eigen::MatrixXd(2 * size, size), Eigen::VectorXd(2 * size)};
  out.rows << Eigen::MatrixXd::Identity(size, size), -Eigen::MatrixXd::Identity(size, size);
  out.most << Eigen::VectorXd::Ones(size), Eigen::VectorXd::Zero(size);
  return out;
}

/// Damped BFGS: positive, whatever the curvature along the step was.
void update(Eigen::MatrixXd& hessian, const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
  const Eigen::VectorXd model = hessian * step;
  const double curvature = step.dot(model), true_curvature = step.dot(change);
  if (!(curvature > 0)) return;
  const double share = true_curvature >= damping * curvature ? 1 : (1 - damping) * curvature / (curvature - true_curvature);
  const Eigen::VectorXd y = share * change + (1 - share) * model;
  hessian += y * y.transpose() / step.dot(y) - model * model.transpose() / curvature;
}

class Search {
 public:
  Search(const ParameterProblem& problem, const ParameterOptions& options, ParameterProblem::Point start)
      : problem_(problem), options_(options), point_(std::move(start)), limits_(unit_box(problem.variables())), radius_(options.first_radius) {}

  const ParameterProblem::Point& best() const { return point_; }

  void run(const RunContext& context, ParameterResult& out) {
    if (!problem_.gradient(point_, gradient_, context)) return broken(context, out);
    const int n = problem_.variables();
    hessian_ = std::max(1e-12, gradient_.norm() / radius_) * Eigen::MatrixXd::Identity(n, n);
    for (bool first = true; out.iterations < options_.most_iterations;) {
      if (stop(context, out)) return;
      const TrustStep step = trust_step(gradient_, hessian_, limits_, point_.x, radius_);
      if ((step.reduction <= options_.tolerance * std::abs(point_.objective) && !step.at_edge) || step.step.norm() < smallest_radius) return done(out);
      if (radius_ < smallest_radius) return end(Status::stalled, "no step improves the parameters any more; these are the best so far", out);
      ++out.iterations;
      const Eigen::VectorXd x = (point_.x + step.step).cwiseMax(0.0).cwiseMin(1.0);
      ParameterProblem::Point trial = problem_.at(x, context);
      if (stop(context, out)) return;
      const double gain = trial.ok() ? point_.objective - trial.objective : -1;
      const double ratio = gain / std::max(step.reduction, 1e-300);
      if (ratio < 0.25) radius_ = 0.3 * step.step.norm();
      if (ratio > 0.7 && step.at_edge) radius_ *= 2;
      if (ratio > 1e-4 && !accept(std::move(trial), first, context)) return broken(context, out);
      out.history.push_back(point_.objective);
      if (context.progress) context.progress(std::min(0.99, out.iterations / (out.iterations + 10.0)), "optimisation");
    }
    end(Status::stalled, "not finished in " + std::to_string(options_.most_iterations) + " iterations; these are the best parameters so far", out);
  }

 private:
  bool accept(ParameterProblem::Point&& trial, bool& first, const RunContext& context) {
    const Eigen::VectorXd step = trial.x - point_.x, before = gradient_;
    point_ = std::move(trial);
    if (!problem_.gradient(point_, gradient_, context)) return false;
    const Eigen::VectorXd change = gradient_ - before;
    // The first model has only its size: that of the curvature that was met (Nocedal and Wright, equation 6.20).
    if (first && step.dot(change) > 0) hessian_ = change.squaredNorm() / step.dot(change) * Eigen::MatrixXd::Identity(step.size(), step.size());
    first = false;
    update(hessian_, step, change);
    return true;
  }

  static void end(Status status, const std::string& message, ParameterResult& out) {
    out.status = status;
    out.message = message;
  }
  static void done(ParameterResult& out) { end(Status::solved, "solved", out); }
  static bool stop(const RunContext& context, ParameterResult& out) {
    const auto why = context.stop();
    if (why) end(*why, *why == Status::timeout ? "out of time; these are the best parameters so far" : "interrupted; these are the best parameters so far", out);
    return why.has_value();
  }
  static void broken(const RunContext& context, ParameterResult& out) {
    if (!stop(context, out)) end(Status::stalled, "a neighbouring state has no equilibrium; these are the best parameters so far", out);
  }

  const ParameterProblem& problem_;
  const ParameterOptions& options_;
  ParameterProblem::Point point_;
  LinearLimits limits_;
  double radius_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
};

std::vector<PackMotion> simulated(const PackProblem& pack, const std::vector<PackTask>& tasks, int steps, const RunContext& context) {
  std::vector<PackMotion> out;
  SimulationOptions simulation;
  simulation.steps = steps;
  for (const PackTask& task : tasks) out.push_back(simulate(pack, task.path, simulation, context));
  return out;
}

}  // namespace

ParameterResult optimise_parameters(const PackProblem& given, const std::vector<PackParameter>& parameters, const std::vector<PackTask>& tasks,
                                    const ParameterOptions& options, const RunContext& context) {
  check(given, parameters, tasks, options);
  const auto begin = std::chrono::steady_clock::now();
  PackProblem pack = given;
  pack.bodies.clear();
  const ParameterProblem problem(pack, parameters, tasks, options);
  ParameterResult out;
  out.pack = given;
  out.values = problem.values_of(problem.start());
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const std::string beyond = beyond_robot(tasks[k].path, *pack.robot);
    if (beyond.empty()) continue;
    out.status = Status::infeasible;
    out.message = "path " + std::to_string(k + 1) + ": " + beyond;
    return out;
  }
  ParameterProblem::Point start = problem.at(problem.start(), context);
  out.before = simulated(problem.pack_with(problem.start()), tasks, options.steps, context);
  if (!start.ok()) {
    const bool stopped = start.status == Status::cancelled || start.status == Status::timeout;
    out.status = stopped ? start.status : Status::infeasible;
    out.message = stopped ? "interrupted before the paths were followed once" : start.message;
    return out;
  }
  out.objective_before = start.objective;
  Search search(problem, options, std::move(start));
  search.run(context, out);
  out.objective = search.best().objective;
  out.values = problem.values_of(search.best().x);
  for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k].apply(out.values[k], out.pack);
  out.after = simulated(problem.pack_with(search.best().x), tasks, options.steps, context);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace tendril::dress_pack
