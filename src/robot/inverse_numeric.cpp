// Inverse kinematics by damped least squares (Levenberg and Marquardt; Nakamura and Hanafusa 1986) from many starts: the
// reference, then points drawn evenly within the limits. Joints at a limit that would leave it are held there for the step.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/number_text.h"
#include "base/units.h"
#include "robot/inverse.h"

namespace tendril {

namespace {

constexpr double full_turn = 2 * units::pi;
constexpr int most_steps = 200;
constexpr double good = 1e-12;  // m and rad: no further steps
constexpr double accepted = 1e-9;
constexpr int most_of_redundant = 8;  // solutions of an arm that has infinitely many
constexpr double shift_range = 1;     // m: where joints without limits start

using Vec6 = Eigen::Matrix<double, 6, 1>;

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

// One descent.
class Descent {
 public:
  Descent(const Robot& robot, int link, const std::vector<int>& moving, const Frame& target, bool limits,
          const RunContext& context)
      : robot_(robot),
        link_(link),
        moving_(moving),
        target_(target),
        limits_(limits),
        context_(context),
        jacobian_(6, robot.size()),
        columns_(6, moving.size()),
        normal_(std::min<Eigen::Index>(6, moving.size()), std::min<Eigen::Index>(6, moving.size())),
        step_(moving.size()) {}

  /// Returns what is left, m and rad added.
  double run(std::vector<double>& q) {
    double damping = 1e-3;
    double error = measure(q);
    for (int i = 0; i < most_steps && left_ > good && !context_.stop(); ++i) {
      prepare(q);
      bool better = false;
      for (int attempt = 0; attempt < 12 && !better; ++attempt) {
        std::vector<double> moved = q;
        take_step(moved, damping);
        const Vec6 kept_miss = miss_;
        const double kept_left = left_, tried = measure(moved);
        better = tried < error;
        if (better) {
          stuck_ = tried > 0.999999 * error ? stuck_ + 1 : 0;
          error = tried;
          q = moved;
          damping = std::max(damping * 0.1, 1e-15);
        } else {
          miss_ = kept_miss;
          left_ = kept_left;
          damping = std::max(damping * 10, 1e-12);
        }
      }
      if (!better || stuck_ > 5) break;
    }
    return left_;
  }

 private:
  double measure(const std::vector<double>& q) {
    const Frame there = robot_.link_frame(link_, q).inverse() * target_;
    miss_ << there.at, log_rotation(there.rotation);
    left_ = miss_.head<3>().norm() + miss_.tail<3>().norm();
    return miss_.squaredNorm();
  }

  void prepare(const std::vector<double>& q) {
    robot_.jacobian(link_, q, jacobian_);
    for (std::size_t k = 0; k < moving_.size(); ++k) columns_.col(k) = jacobian_.col(moving_[k]);
    if (limits_) {
      const Eigen::VectorXd pull = columns_.transpose() * miss_;
      for (std::size_t k = 0; k < moving_.size(); ++k) {
        const int v = moving_[k];
        if ((q[v] <= robot_.lower()[v] && pull[k] < 0) || (q[v] >= robot_.upper()[v] && pull[k] > 0)) columns_.col(k).setZero();
      }
    }
    if (redundant())
      normal_ = columns_ * columns_.transpose();
    else
      normal_ = columns_.transpose() * columns_;
  }

  bool redundant() const { return columns_.cols() > 6; }

  // (J'J + damping)^-1 J' miss, which is J' (JJ' + damping)^-1 miss: the smaller of both matrices.

  void take_step(std::vector<double>& q, double damping) {
    Eigen::MatrixXd damped = normal_;
    damped.diagonal().array() += damping;
    if (redundant())
      step_ = columns_.transpose() * damped.ldlt().solve(miss_);
    else
      step_ = damped.ldlt().solve(columns_.transpose() * miss_);
    const double largest = step_.cwiseAbs().maxCoeff();
    if (largest > 1) step_ /= largest;  // rad or m: beyond that the arm is another one
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const int v = moving_[k];
      q[v] += step_[k];
      if (limits_) q[v] = std::clamp(q[v], robot_.lower()[v], robot_.upper()[v]);
    }
  }

  const Robot& robot_;
  int link_;
  const std::vector<int>& moving_;
  const Frame& target_;
  bool limits_;
  const RunContext& context_;
  Jacobian jacobian_;
  Eigen::MatrixXd columns_, normal_;
  Eigen::VectorXd step_;
  Vec6 miss_;
  double left_ = 0;
  int stuck_ = 0;
};

std::vector<double> start(const Robot& robot, const std::vector<int>& moving, const InverseOptions& options,
                          const std::vector<double>& near, std::uint64_t seed, int number) {
  std::vector<double> q = near;
  std::mt19937_64 random(seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(number));
  random.discard(4);
  for (int v : moving) {
    double lower = robot.lower()[v], upper = robot.upper()[v];
    const double range = robot.variable(v).kind == JointKind::prismatic ? shift_range : units::pi;
    if (number > 0) {
      if (!std::isfinite(lower) || (range == units::pi && upper - lower > full_turn))
        lower = std::max(lower, std::min(upper, near[v] + range) - 2 * range);
      if (!std::isfinite(upper) || (range == units::pi && upper - lower > full_turn)) upper = std::min(upper, lower + 2 * range);
      q[v] = lower + (upper - lower) * uniform(random);
    }
    if (options.limits) q[v] = std::clamp(q[v], robot.lower()[v], robot.upper()[v]);
  }
  return q;
}

}  // namespace

void InverseKinematics::solve_numeric(const Frame& target, const InverseOptions& options, const std::vector<double>& near,
                                      const RunContext& context, InverseResult& result) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<double> nearest_q;
  result.status = Status::stalled;
  for (int number = 0; number < options.starts; ++number) {
    if (const auto stop = context.stop()) {
      result.status = *stop;
      break;
    }
    std::vector<double> q = start(*robot_, moving_, options, near, context.seed, number);
    Descent descent(*robot_, link_, moving_, target, options.limits, context);
    const double left = descent.run(q);
    if (left < nearest) {
      nearest = left;
      nearest_q = q;
    }
    if (!(left < accepted)) continue;
    add_turns(q, options, near, result);
    if (moving_.size() > 6 && static_cast<int>(result.solutions.size()) >= most_of_redundant) break;
  }
  if (!result.solutions.empty() || nearest_q.empty()) {
    if (nearest_q.empty()) result.message = "stopped before the first start";
    return;
  }
  const Frame miss = robot_->link_frame(link_, nearest_q).inverse() * target;
  result.message = "none of " + std::to_string(options.starts) + " starts found a solution; the nearest is " +
                   number_text(miss.at.norm()) + " m and " + number_text(log_rotation(miss.rotation).norm() / units::deg) +
                   " deg away";
}

}  // namespace tendril
