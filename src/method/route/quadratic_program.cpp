#include "method/route/quadratic_program.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace tendril::routing {
namespace {

class ActiveSet {
 public:
  ActiveSet(const QuadraticProgram& program, const Eigen::VectorXd& start, const std::vector<int>& binding)
      : program_(program), x_(start), working_(binding) {}

  QuadraticSolution run() {
    const int n = static_cast<int>(x_.size()), m = static_cast<int>(program_.bounds.size());
    QuadraticSolution out;
    Eigen::VectorXd multipliers;
    for (int round = 0; round < 20 * (n + m) && !out.converged; ++round) {
      const Eigen::VectorXd step = equality_step(multipliers);
      if (step.lpNorm<Eigen::Infinity>() <= 1e-12 * (1 + x_.lpNorm<Eigen::Infinity>()))
        out.converged = !drop_one(multipliers);
      else
        advance(step);
    }
    out.x = x_;
    out.multipliers = Eigen::VectorXd::Zero(m);
    for (std::size_t k = 0; k < working_.size() && out.converged; ++k)
      out.multipliers[working_[k]] = std::max(0.0, multipliers[static_cast<int>(k)]);
    return out;
  }

 private:
  /// The way to the minimum with the working rows held, and their multipliers there.
  Eigen::VectorXd equality_step(Eigen::VectorXd& multipliers) const {
    const int n = static_cast<int>(x_.size()), w = static_cast<int>(working_.size());
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + w, n + w);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + w);
    kkt.topLeftCorner(n, n) = program_.hessian;
    for (int k = 0; k < w; ++k) {
      kkt.row(n + k).head(n) = program_.rows.row(working_[k]);
      kkt.col(n + k).head(n) = -program_.rows.row(working_[k]).transpose();
    }
    right.head(n) = -(program_.gradient + program_.hessian * x_);
    const Eigen::VectorXd solution = kkt.fullPivLu().solve(right);
    multipliers = solution.tail(w);
    return solution.head(n);
  }

  /// The working row that pushes the wrong way hardest no longer binds; false: there is none.
  bool drop_one(const Eigen::VectorXd& multipliers) {
    if (working_.empty()) return false;
    Eigen::Index worst = 0;
    const double scale = 1 + program_.gradient.lpNorm<Eigen::Infinity>();
    if (multipliers.minCoeff(&worst) >= -1e-11 * scale) return false;
    working_.erase(working_.begin() + worst);
    return true;
  }

  /// As far as the other rows allow; the one that stops it joins the working rows.
  void advance(const Eigen::VectorXd& step) {
    double share = 1;
    int blocking = -1;
    for (int i = 0; i < static_cast<int>(program_.bounds.size()); ++i) {
      if (std::find(working_.begin(), working_.end(), i) != working_.end()) continue;
      const double rate = program_.rows.row(i).dot(step);
      if (rate >= -1e-13 * program_.rows.row(i).norm() * step.norm()) continue;
      const double room = std::max(0.0, program_.rows.row(i).dot(x_) - program_.bounds[i]);
      if (room < -rate * share) {
        share = room / -rate;
        blocking = i;
      }
    }
    x_ += share * step;
    if (blocking >= 0) working_.push_back(blocking);
  }

  const QuadraticProgram& program_;
  Eigen::VectorXd x_;
  std::vector<int> working_;
};

}  // namespace

QuadraticSolution solve(const QuadraticProgram& program, const Eigen::VectorXd& start, const std::vector<int>& binding) {
  return ActiveSet(program, start, binding).run();
}

}  // namespace tendril::routing
