#include "method/pcc/bfgs.h"

#include <array>
#include <cmath>
#include <limits>

namespace tendril::routing {

namespace {

using Eigen::VectorXd;

constexpr double sufficient = 1e-4, slope_left = 0.9;
// What rounding may make of a value.
constexpr double rounding = 1e-15;

/// The state of one minimisation; allocates before the first iteration only.
class Bfgs {
 public:
  Bfgs(const BfgsFunction& function, VectorXd& x, const BfgsOptions& options, Eigen::MatrixXd& inverse)
      : function_(function), options_(options), x_(x), gradient_(x.size()), direction_(x.size()), tried_(x.size()),
        tried_gradient_(x.size()), change_(x.size()), product_(x.size()), inverse_(inverse), fresh_(inverse.rows() != x.size()) {
    if (fresh_) inverse_.setIdentity(x.size(), x.size());
  }

  BfgsResult run(const RunContext& context) {
    value_ = function_(x_, gradient_);
    BfgsResult result{value_, 0, false};
    std::array<double, 5> before;
    before.fill(std::numeric_limits<double>::infinity());
    while (std::isfinite(value_) && result.iterations < options_.iterations && !context.stop()) {
      if (!(gradient_.lpNorm<Eigen::Infinity>() > options_.gradient)) {
        result.converged = true;
        break;
      }
      double& old = before[result.iterations % before.size()];
      if (old - value_ < options_.decrease * std::abs(value_)) {
        result.converged = true;
        break;
      }
      old = value_;
      ++result.iterations;
      if (step()) continue;
      // A direction that does not lead down: once more from the steepest descent, then this is the minimum to rounding.
      if (fresh_) break;
      inverse_.setIdentity();
      fresh_ = true;
    }
    result.value = value_;
    return result;
  }
  bool is_fresh() const { return fresh_; }

 private:
  bool step() {
    direction_.noalias() = -(inverse_ * gradient_);
    double slope = direction_.dot(gradient_);
    if (!(slope < 0)) return false;
    const double largest = direction_.lpNorm<Eigen::Infinity>();
    double length = largest > options_.largest_step ? options_.largest_step / largest : 1;
    if (fresh_) length = std::min(1.0, 0.1 * options_.largest_step / largest);
    if (!search(slope, length, options_.largest_step / largest)) return false;
    update();
    return true;
  }

  /// Weak Wolfe conditions by doubling and halving. Near the minimum, where values differ by rounding only, slopes decide.
  bool search(double slope, double length, double longest) {
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 40; ++trial) {
      tried_ = x_ + length * direction_;
      const double value = function_(tried_, tried_gradient_);
      const double now = direction_.dot(tried_gradient_);
      const bool lower = value <= value_ + sufficient * length * slope;
      const bool as_low = value <= value_ + rounding * std::abs(value_) && now <= (2 * sufficient - 1) * slope;
      if (!std::isfinite(value) || !(lower || as_low)) {
        high = length;
      } else if (now < slope_left * slope && length < longest) {
        low = length;
      } else {
        return accept(value);
      }
      const double next = std::isfinite(high) ? 0.5 * (low + high) : std::min(2 * length, longest);
      if (next == length || (low > 0 && high - low < 1e-3 * low)) break;
      length = next;
    }
    if (low == 0) return false;
    // Lower, if not yet flat enough: a kink.
    tried_ = x_ + low * direction_;
    return accept(function_(tried_, tried_gradient_));
  }

  bool accept(double value) {
    change_ = tried_ - x_;
    product_ = tried_gradient_ - gradient_;  // the change of the gradient, until update()
    value_ = value;
    x_.swap(tried_);
    gradient_.swap(tried_gradient_);
    return true;
  }

  void update() {
    const double curvature = change_.dot(product_), size = product_.squaredNorm();
    if (!(curvature > 1e-14 * change_.norm() * std::sqrt(size))) return;
    if (fresh_) inverse_.diagonal().setConstant(curvature / size);
    fresh_ = false;
    direction_.noalias() = inverse_ * product_;
    const double factor = (1 + product_.dot(direction_) / curvature) / curvature;
    for (Eigen::Index j = 0; j < x_.size(); ++j)
      inverse_.col(j) += (factor * change_[j] - direction_[j] / curvature) * change_ - change_[j] / curvature * direction_;
  }

  const BfgsFunction& function_;
  const BfgsOptions& options_;
  VectorXd& x_;
  VectorXd gradient_, direction_, tried_, tried_gradient_, change_, product_;
  Eigen::MatrixXd& inverse_;
  double value_ = 0;
  bool fresh_;  ///< nothing is known of the curvature yet
};

}  // namespace

BfgsResult minimize(const BfgsFunction& function, VectorXd& x, const BfgsOptions& options, const RunContext& context,
                    Eigen::MatrixXd* inverse) {
  Eigen::MatrixXd own;
  Eigen::MatrixXd& known = inverse ? *inverse : own;
  Bfgs bfgs(function, x, options, known);
  const BfgsResult result = bfgs.run(context);
  if (bfgs.is_fresh()) known.resize(0, 0);
  return result;
}

}  // namespace tendril::routing
