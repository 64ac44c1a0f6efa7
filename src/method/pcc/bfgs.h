// Minimisation of a function of few unknowns with its gradient: BFGS with the whole inverse Hessian, which for the few dozen
// unknowns of a curve costs less than one evaluation and converges faster than a limited memory.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "base/run_context.h"

namespace tendril::routing {

struct BfgsOptions {
  int iterations = 400;
  double gradient = 1e-8;   ///< ends when no entry of the gradient is larger
  double decrease = 0;      ///< ends when five iterations together decrease the value by less than this share of it
  double largest_step = 1;  ///< of any unknown in one iteration
};

struct BfgsResult {
  double value = 0;
  int iterations = 0;
  bool converged = false;
};

/// Value at x; fills the gradient. Values that are not finite are steps too far.
using BfgsFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Lowers the function from x, where it must be finite, and leaves the best point in x. Steps satisfy the weak Wolfe
/// conditions, with which BFGS also gets along with the kinks of distances (Lewis and Overton, 2013).
/// `inverse`: what is known of the inverse Hessian, from an earlier call for a function that differs little; of any other size than
/// that of x: nothing. What is known afterwards.
BfgsResult minimize(const BfgsFunction& function, Eigen::VectorXd& x, const BfgsOptions& options, const RunContext& context = {},
                    Eigen::MatrixXd* inverse = nullptr);

}  // namespace tendril::routing
