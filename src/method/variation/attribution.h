// Shares of a measure's variance, by contributor.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/run_context.h"
#include "method/variation/contributors.h"
#include "method/variation/row_solver.h"

namespace tendril::variation {

/// Derivatives of all measures by all columns at the nominal design, by central differences of outcomes a fiftieth of a
/// standard deviation to both sides: they take part in whatever an outcome goes through. NaN where one of them fails, zero
/// for a column that does not vary.
Eigen::MatrixXd gradient_of(const std::vector<double>& nominal, const Eigen::VectorXd& variances, const Measures& measures,
                            const RowSolver& solver, const RunContext& context);

class Attribution {
 public:
  /// `independent`: the outcomes are.
  Attribution(const std::vector<Variables::Contributor>& contributors, bool independent);

  void add_linear(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance);
  void add_regression(const Outcomes& outcomes, int measure);
  /// `drawn`: the contributors that have a row of effects, in order.
  void add_effects(const Outcomes& outcomes, int measure, const std::vector<int>& drawn);

  /// Largest first.
  Contributions finish();

 private:
  Contributions out_;
  bool independent_;
};

}  // namespace tendril::variation
