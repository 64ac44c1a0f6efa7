#include "method/route/constrained_descent.h"

#include <algorithm>
#include <cmath>

#include "method/route/quadratic_program.h"

namespace tendril::routing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_trust = 1e-7;

class Descent {
 public:
  Descent(ConstrainedProblem& problem, const DescentOptions& options) : problem_(problem), options_(options) {}

  DescentOutcome run(const VectorXd& start, const RunContext& context) {
    DescentOutcome out;
    out.x = start.cwiseMax(problem_.lower()).cwiseMin(problem_.upper());
    out.value = problem_.evaluate(out.x);
    out.evaluations = 1;
    if (!out.value.valid) return out;
    problem_.accept();
    if (!problem_.linearise({}, linear_)) return out;
    const int n = static_cast<int>(start.size());
    hessian_ = MatrixXd::Identity(n, n) * std::max(1e-3 * linear_.cost.norm(), 1e-9);
    trust_ = options_.trust;
    penalty_ = 10 * std::max(linear_.cost.norm(), 1e-9);
    while (!out.converged && out.evaluations < options_.max_evaluations && !context.stop()) {
      const Step step = best_step(out.x, out.value);
      if (step.gain <= options_.tolerance * std::max(std::abs(out.value.cost), 1e-12) || trust_ < least_trust) {
        out.converged = true;
        break;
      }
      if (!take(step, out)) break;
    }
    return out;
  }

 private:
  struct Step {
    VectorXd way, multipliers;
    double left = 0;  ///< violation that the linearisation leaves
    double gain = 0;  ///< predicted, of the merit
  };

  double merit(const ConstrainedProblem::Value& value) const {
    return value.cost + penalty_ * (value.violation > options_.feasible ? value.violation : 0);
  }

  Step best_step(const VectorXd& x, const ConstrainedProblem::Value& value) {
    Step step = solve_step(x, linear_.slacks, penalty_);
    // Where more could be kept than is, keeping counts for more.
    while (step.left > options_.feasible && step.left > 0.1 * value.violation && penalty_ < 1e6 * linear_.cost.norm()) {
      const Step harder = solve_step(x, linear_.slacks, 10 * penalty_);
      const bool helps = harder.left < 0.9 * step.left;
      if (!helps) break;
      penalty_ *= 10;
      step = harder;
    }
    const double now = std::max(0.0, linear_.slacks.size() ? -linear_.slacks.minCoeff() : 0.0);
    step.gain = -(linear_.cost.dot(step.way) + 0.5 * step.way.dot(hessian_ * step.way)) + penalty_ * (now - step.left);
    return step;
  }

  /// Unknowns: the step and the violation t that it leaves.
  Step solve_step(const VectorXd& x, const VectorXd& slacks, double penalty) const {
    const int n = static_cast<int>(x.size()), m = static_cast<int>(slacks.size());
    QuadraticProgram program;
    program.hessian = MatrixXd::Zero(n + 1, n + 1);
    program.hessian.topLeftCorner(n, n) = hessian_;
    program.hessian(n, n) = 1e-6 * penalty;
    program.gradient = VectorXd(n + 1);
    program.gradient << linear_.cost, penalty;
    program.rows = MatrixXd::Zero(m + 1 + 2 * n, n + 1);
    program.bounds = VectorXd::Zero(m + 1 + 2 * n);
    program.rows.topLeftCorner(m, n) = linear_.slopes;
    program.rows.col(n).head(m + 1).setOnes();
    program.bounds.head(m) = -slacks;
    for (int j = 0; j < n; ++j) {
      program.rows(m + 1 + 2 * j, j) = 1;
      program.bounds[m + 1 + 2 * j] = std::max(problem_.lower()[j] - x[j], -trust_);
      program.rows(m + 2 + 2 * j, j) = -1;
      program.bounds[m + 2 + 2 * j] = -std::min(problem_.upper()[j] - x[j], trust_);
    }
    VectorXd start = VectorXd::Zero(n + 1);
    Eigen::Index binding = m;
    if (m > 0) start[n] = std::max(0.0, program.bounds.head(m + 1).maxCoeff(&binding));
    const QuadraticSolution solution = solve(program, start, {static_cast<int>(binding)});
    Step step;
    step.way = solution.x.head(n);
    step.multipliers = solution.multipliers.head(m);
    step.left = std::max(0.0, m > 0 ? (-slacks - linear_.slopes * step.way).maxCoeff() : 0.0);
    return step;
  }

  VectorXd within(const VectorXd& x) const { return x.cwiseMax(problem_.lower()).cwiseMin(problem_.upper()); }

  double ratio_of(const ConstrainedProblem::Value& value, const Step& step, const DescentOutcome& out) const {
    return value.valid ? (merit(out.value) - merit(value)) / step.gain : -1;
  }

  /// False: there are no derivatives to go on with.
  bool take(Step step, DescentOutcome& out) {
    VectorXd to = within(out.x + step.way);
    ConstrainedProblem::Value value = problem_.evaluate(to);
    ++out.evaluations;
    double ratio = ratio_of(value, step, out);
    if (ratio < 0.25 && value.valid && value.violation > options_.feasible && linear_.slacks.size() > 0) {
      const VectorXd seen = problem_.slacks(linear_.tags) - linear_.slopes * step.way;
      const Step second = solve_step(out.x, seen, penalty_);
      const VectorXd there = within(out.x + second.way);
      const ConstrainedProblem::Value corrected = problem_.evaluate(there);
      ++out.evaluations;
      if (!corrected.valid || merit(corrected) > merit(value)) {
        problem_.evaluate(to);
        ++out.evaluations;
      } else {
        to = there;
        value = corrected;
        step.way = second.way;
        step.multipliers = second.multipliers;
        ratio = ratio_of(value, step, out);
      }
    }
    const double size = step.way.lpNorm<Eigen::Infinity>();
    if (ratio < 0.05) {
      trust_ = (value.valid ? 0.4 : 0.25) * size;
      return true;
    }
    if (ratio > 0.75 && size > 0.99 * trust_) trust_ = std::min(2.5 * trust_, options_.most_trust);
    if (ratio < 0.25) trust_ = 0.5 * size;
    problem_.accept();
    std::vector<ConstrainedProblem::Tag> pressing;
    VectorXd multipliers(step.multipliers.size()), before = linear_.cost;
    int count = 0;
    for (int i = 0; i < step.multipliers.size(); ++i) {
      if (!(step.multipliers[i] > 0)) continue;
      pressing.push_back(linear_.tags[i]);
      before -= step.multipliers[i] * linear_.slopes.row(i).transpose();
      multipliers[count++] = step.multipliers[i];
    }
    if (!problem_.linearise(pressing, linear_)) return false;
    const VectorXd after = linear_.cost - linear_.slopes.topRows(count).transpose() * multipliers.head(count);
    update_hessian(to - out.x, after - before);
    out.x = to;
    out.value = value;
    return true;
  }

  /// Powell's damped BFGS.
  void update_hessian(const VectorXd& way, VectorXd change) {
    const VectorXd moved = hessian_ * way;
    const double curvature = way.dot(moved), seen = way.dot(change);
    if (!(curvature > 0)) return;
    if (seen < 0.2 * curvature) {
      const double share = 0.8 * curvature / (curvature - seen);
      change = share * change + (1 - share) * moved;
    }
    hessian_ += change * change.transpose() / way.dot(change) - moved * moved.transpose() / curvature;
  }

  ConstrainedProblem& problem_;
  const DescentOptions& options_;
  ConstrainedProblem::Linear linear_;
  MatrixXd hessian_;
  double trust_ = 0, penalty_ = 0;
};

}  // namespace

DescentOutcome descend(ConstrainedProblem& problem, const VectorXd& start, const DescentOptions& options,
                       const RunContext& context) {
  return Descent(problem, options).run(start, context);
}

}  // namespace tendril::routing
