// One step of a trust-region method under linear inequalities, on a quadratic model that need not be convex.
//
// In the space that the active inequalities leave, the step is that of the saddle-free Newton method, -(|H| + mu)^-1 g with |H| from
// the eigenvalues' sizes (Dauphin et al., 2014), mu so large that it stays within the radius. An inequality that it meets is made
// active and the rest of the radius spent along it; one that holds back a descent is let go. The model never increases on the way,
// since the curvature along the step is at most that of |H|.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tendril::dress_pack {

/// Row by row: rows x <= most.
struct LinearLimits {
  Eigen::MatrixXd rows;
  Eigen::VectorXd most;
};

struct TrustStep {
  Eigen::VectorXd step;
  double reduction = 0;     ///< of the model, not negative
  double slope = 0;         ///< largest derivative along what is free, at the beginning
  bool at_edge = false;     ///< the radius cut it short
};

/// From `x`, which is within the limits. All numbers must be finite.
TrustStep trust_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian, const LinearLimits& limits, const Eigen::VectorXd& x,
                     double radius);

}  // namespace tendril::dress_pack
