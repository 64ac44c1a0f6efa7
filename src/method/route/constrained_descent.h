// Sequential quadratic programming in a trust region for few variables and many constraints, of which each step knows those that
// matter near it:
//
//   minimise  cost(x)   subject to   slack_i(x) >= 0,  lower <= x <= upper.
//
// Steps minimise  cost slope . d + d' B d / 2 + mu t,  t >= -(slack_i + slope_i . d), t >= 0, |d| <= trust (Fletcher's S l-infinity
// QP: it always has a solution); the merit cost + mu violation judges them; where a step fails by the curvature of the constraints
// it is corrected to second order, by their values where it ended; B by damped BFGS updates of the Lagrangian; mu grows while
// linearised slacks can be kept and are not.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/run_context.h"

namespace tendril::routing {

/// What is minimised. Variables are of order one.
class ConstrainedProblem {
 public:
  virtual ~ConstrainedProblem() = default;
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;

  struct Value {
    bool valid = false;    ///< false: there is nothing at this point
    double cost = 0;
    double violation = 0;  ///< the largest -slack, at least 0
  };
  /// Looks at a point.
  virtual Value evaluate(const Eigen::VectorXd& x) = 0;
  /// The point looked at last is the one to go on from.
  virtual void accept() = 0;

  /// Names a constraint across points.
  struct Tag {
    int kind = 0;
    double place = 0;
  };
  struct Linear {
    Eigen::VectorXd cost;           ///< slope
    std::vector<Tag> tags;
    Eigen::VectorXd slacks;
    Eigen::MatrixXd slopes;         ///< a row for each slack
  };
  /// First order at the accepted point, of the cost and of the constraints that matter near it: first those in `always`, in their
  /// order, then others. False: there are no derivatives.
  virtual bool linearise(const std::vector<Tag>& always, Linear& out) = 0;
  /// Values of these constraints at the point looked at last, which is valid.
  virtual Eigen::VectorXd slacks(const std::vector<Tag>& tags) = 0;
};

struct DescentOptions {
  double tolerance = 1e-6;      ///< of the cost, relative
  double feasible = 1e-9;       ///< violations up to this are none
  double trust = 0.25, most_trust = 2;
  int max_evaluations = 100;
};

struct DescentOutcome {
  Eigen::VectorXd x;
  ConstrainedProblem::Value value;
  int evaluations = 0;
  bool converged = false;
};

/// From `start`, moved within the bounds. The problem is left at the best point. Ends early when the context says so.
DescentOutcome descend(ConstrainedProblem& problem, const Eigen::VectorXd& start, const DescentOptions& options,
                       const RunContext& context);

}  // namespace tendril::routing
