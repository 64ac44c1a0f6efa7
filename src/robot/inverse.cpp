#include "robot/inverse.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {

namespace {

constexpr double full_turn = 2 * units::pi;
constexpr double accepted = 1e-9;          // m and rad
constexpr double limit_tolerance = 1e-11;  // rad: rounding; what lies beyond by less is put on the limit
constexpr std::size_t most_of_one = 1000;  // solutions that differ by whole turns from one
constexpr int most_turns = 6;              // of a joint whose limits are taken for limits of turns

// The zero position's axes of the joints on the way to a link.
std::array<ScrewAxis, 6> screw_axes(const Robot& robot, const std::vector<int>& moving) {
  const std::vector<Frame> frames = robot.link_frames(std::vector<double>(robot.size(), 0.0));
  std::array<ScrewAxis, 6> axes;
  for (int k = 0; k < 6; ++k) {
    const int joint = robot.variables()[moving[k]];
    axes[k] = {frames[joint + 1].at, frames[joint + 1].rotation * robot.joints()[joint].axis};
  }
  return axes;
}

bool turns(const Joint& joint) { return joint.kind != JointKind::prismatic; }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

}  // namespace

InverseKinematics::InverseKinematics(std::shared_ptr<const Robot> robot, int link) : robot_(std::move(robot)), link_(link) {
  if (link < 0 || link >= static_cast<int>(robot_->links().size()))
    throw UsageError("inverse kinematics: the robot has no link of the number " + std::to_string(link));
  bool mimicry = false, shifts = false;
  for (int at : robot_->chain(link)) {
    if (at == 0 || robot_->joints()[at - 1].kind == JointKind::fixed) continue;
    const Joint& joint = robot_->joints()[at - 1];
    mimicry |= joint.mimics != -1;
    shifts |= !turns(joint);
    const int followed = joint.mimics == -1 ? at - 1 : joint.mimics;
    const auto& variables = robot_->variables();
    const int v = static_cast<int>(std::find(variables.begin(), variables.end(), followed) - variables.begin());
    if (std::find(moving_.begin(), moving_.end(), v) == moving_.end()) moving_.push_back(v);
  }
  if (mimicry)
    why_not_ = "a joint mimics another one";
  else if (moving_.size() != 6)
    why_not_ = std::to_string(moving_.size()) + " joints move '" + robot_->links()[link].name + "', not six";
  else if (shifts)
    why_not_ = "a joint shifts instead of turning";
  else
    wrist_ = SphericalWristArm::from_axes(screw_axes(*robot_, moving_),
                                          robot_->link_frame(link, std::vector<double>(robot_->size(), 0.0)), why_not_);
}

double InverseKinematics::residual(Robot::JointValues q, const Frame& target) const {
  const Frame there = robot_->link_frame(link_, q).inverse() * target;
  return there.at.norm() + log_rotation(there.rotation).norm();
}

std::vector<double> InverseKinematics::reference(const InverseOptions& options) const {
  if (!options.near.empty()) {
    robot_->check(options.near, "inverse kinematics: near");
    return options.near;
  }
  std::vector<double> q(robot_->size(), 0.0);
  for (int k = 0; k < robot_->size() && options.limits; ++k) q[k] = std::clamp(0.0, robot_->lower()[k], robot_->upper()[k]);
  return q;
}

InverseResult InverseKinematics::solve(const Frame& target, const InverseOptions& options, const RunContext& context) const {
  if (!all_finite(target.at) || !all_finite(target.rotation.coeffs()) || std::abs(target.rotation.norm() - 1) > 1e-6)
    throw UsageError("inverse kinematics: the target is no finite frame");
  if (options.starts < 1)
    throw UsageError("inverse kinematics: got " + std::to_string(options.starts) + " starts, expected one or more");
  const std::vector<double> near = reference(options);
  InverseResult result;
  if (moving_.empty()) {
    if (residual(near, target) < accepted)
      result.solutions.push_back(near);
    else
      result.message = "no joint moves '" + robot_->links()[link_].name + "'";
  } else if (closed_form() && !options.numeric) {
    solve_closed_form(target, options, near, result);
  } else {
    solve_numeric(target, options, near, context, result);
  }
  std::stable_sort(result.solutions.begin(), result.solutions.end(),
                   [&](const auto& a, const auto& b) { return largest_difference(a, near) < largest_difference(b, near); });
  if (!result.solutions.empty() && (result.status == Status::infeasible || result.status == Status::stalled))
    result.status = Status::solved;
  return result;
}

void InverseKinematics::solve_closed_form(const Frame& target, const InverseOptions& options, const std::vector<double>& near,
                                          InverseResult& result) const {
  result.closed_form = true;
  SphericalWristArm::Angles start;
  std::array<std::string, 6> names;
  for (int k = 0; k < 6; ++k) {
    start[k] = near[moving_[k]];
    names[k] = robot_->variable(moving_[k]).name;
  }
  const SphericalWristArm::Branches found = wrist_->solve(target, start, names);
  result.message = found.out_of_reach;
  std::string beyond;
  double least = std::numeric_limits<double>::infinity();
  int exact = 0;
  for (const auto& angles : found.angles) {
    std::vector<double> q = near;
    for (int k = 0; k < 6; ++k) q[moving_[k]] = near[moving_[k]] + std::remainder(angles[k] - near[moving_[k]], full_turn);
    if (!polish(target, q)) continue;
    ++exact;
    const std::size_t before = result.solutions.size();
    add_turns(q, options, near, result);
    if (result.solutions.size() > before) continue;
    // Why not: how far each joint is beyond its limits, at best.
    double sum = 0;
    for (int v : moving_) {
      const double lower = robot_->lower()[v], upper = robot_->upper()[v], middle = (lower + upper) / 2;
      if (!std::isfinite(middle)) continue;
      q[v] = middle + std::remainder(q[v] - middle, full_turn);
      sum += std::max({0.0, lower - q[v], q[v] - upper});
    }
    if (sum < least) {
      least = sum;
      beyond = robot_->beyond_limits(q, limit_tolerance);
    }
  }
  if (!result.solutions.empty()) {
    result.message = found.singular;
    result.singular = !found.singular.empty();
  } else if (exact > 0) {
    result.message = "beyond the joint limits in every way (" + std::to_string(exact) + "); the nearest has " + beyond;
  } else if (result.message.empty()) {
    result.status = Status::stalled;
    result.message = "at the rim of the reach: no solution reproduces the frame to " + number_text(accepted);
  }
}

// Newton's method, for descriptions whose axes do not quite meet or are not quite parallel.
bool InverseKinematics::polish(const Frame& target, std::vector<double>& q) const {
  double error = residual(q, target);
  Jacobian jacobian(6, robot_->size());
  for (int i = 0; i < 8 && error > 1e-13; ++i) {
    const Frame there = robot_->jacobian(link_, q, jacobian).inverse() * target;
    Eigen::Matrix<double, 6, 1> miss;
    miss << there.at, log_rotation(there.rotation);
    Eigen::MatrixXd columns(6, moving_.size());
    for (std::size_t k = 0; k < moving_.size(); ++k) columns.col(k) = jacobian.col(moving_[k]);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    qr.setThreshold(1e-7);
    const Eigen::VectorXd step = qr.solve(miss);
    std::vector<double> moved = q;
    for (std::size_t k = 0; k < moving_.size(); ++k) moved[moving_[k]] += step[k];
    const double left = residual(moved, target);
    if (!(left < error)) break;
    q = moved;
    error = left;
  }
  return error < accepted;
}

// Where one joint may stand, whole turns apart, the place nearest to `near` first.
std::vector<double> InverseKinematics::places_of(int v, double at, double near, const InverseOptions& options) const {
  if (!options.limits) return {at};
  const double lower = robot_->lower()[v], upper = robot_->upper()[v];
  const bool turning = turns(robot_->variable(v));
  if (turning && at < lower - limit_tolerance) at += full_turn * std::ceil((lower - limit_tolerance - at) / full_turn);
  if (turning && at > upper + limit_tolerance) at -= full_turn * std::ceil((at - upper - limit_tolerance) / full_turn);
  if (!(at >= lower - limit_tolerance && at <= upper + limit_tolerance)) return {};
  std::vector<double> places = {at};
  if (turning && moving_.size() <= 6 && upper - lower < most_turns * full_turn) {
    for (double other = at - full_turn; other >= lower - limit_tolerance; other -= full_turn) places.push_back(other);
    for (double other = at + full_turn; other <= upper + limit_tolerance; other += full_turn) places.push_back(other);
  }
  std::sort(places.begin(), places.end(), [&](double a, double b) { return std::abs(a - near) < std::abs(b - near); });
  if (!options.turns) places.resize(1, 0.0);
  for (double& place : places) place = std::clamp(place, lower, upper);
  return places;
}

void InverseKinematics::add_turns(const std::vector<double>& q, const InverseOptions& options, const std::vector<double>& near,
                                  InverseResult& result) const {
  const auto same = [&](const std::vector<double>& other) {  // but for whole turns: then it is there with all of its own
    for (int v : moving_) {
      const double apart = other[v] - q[v];
      if (std::abs(turns(robot_->variable(v)) ? std::remainder(apart, full_turn) : apart) > 1e-7) return false;
    }
    return true;
  };
  if (std::any_of(result.solutions.begin(), result.solutions.end(), same)) return;
  std::vector<std::vector<double>> all = {q};
  for (int v : moving_) {
    std::vector<double> places = places_of(v, q[v], near[v], options);
    if (all.size() * places.size() > most_of_one) places.resize(1, 0.0);
    std::vector<std::vector<double>> more;
    for (const auto& one : all)
      for (double place : places) {
        more.push_back(one);
        more.back()[v] = place;
      }
    all = std::move(more);
  }
  result.solutions.insert(result.solutions.end(), all.begin(), all.end());
}

}  // namespace tendril
