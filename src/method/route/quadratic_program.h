// Small dense convex quadratic programs, as the steps of sequential quadratic programming need them.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tendril::routing {

/// minimise  x' hessian x / 2 + gradient' x   subject to   rows x >= bounds.
struct QuadraticProgram {
  Eigen::MatrixXd hessian;    ///< n x n, positive definite
  Eigen::VectorXd gradient;   ///< n
  Eigen::MatrixXd rows;       ///< m x n
  Eigen::VectorXd bounds;     ///< m
};

struct QuadraticSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  ///< m, of the rows; zero where a row does not bind
  bool converged = false;       ///< false: x keeps all rows, but may not be the best
};

/// Primal active-set method (Nocedal and Wright, Numerical Optimization, 16.5) from `start`, which must keep all rows. `binding`:
/// rows, independent of each other, that hold with equality at the start and are the first guess of those that bind.
QuadraticSolution solve(const QuadraticProgram& program, const Eigen::VectorXd& start, const std::vector<int>& binding = {});

}  // namespace tendril::routing
