#include "method/dress_pack/joint_path.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::dress_pack {
namespace {

constexpr double rounding = 1e-9;  // of a limit, rad or m; of a speed, relative

void check_weights(const std::vector<double>& weights, int size) {
  if (!weights.empty() && static_cast<int>(weights.size()) != size)
    throw UsageError("joint path: " + std::to_string(weights.size()) + " weights for " + std::to_string(size) + " joints");
  for (const double weight : weights)
    if (!std::isfinite(weight) || weight < 0)
      throw UsageError("joint path: a weight is " + number_text(weight) + ", expected a number of at least 0");
}

double squared(const JointVector& way, const std::vector<double>& weights) {
  double sum = 0;
  for (int k = 0; k < way.size(); ++k) sum += std::pow((weights.empty() ? 1 : weights[k]) * way[k], 2);
  return sum;
}

}  // namespace

JointPath::JointPath(std::vector<JointVector> via) : via_(std::move(via)) {
  if (via_.empty()) throw UsageError("joint path: no via points, expected at least one");
  for (std::size_t k = 0; k < via_.size(); ++k) {
    if (via_[k].size() != via_[0].size())
      throw UsageError("joint path: via point " + std::to_string(k) + " has " + std::to_string(via_[k].size()) +
                       " joint values, the first one has " + std::to_string(via_[0].size()));
    if (!all_finite(via_[k])) throw UsageError("joint path: via point " + std::to_string(k) + " has numbers that are not finite");
  }
}

JointPath::Place JointPath::place(double t) const {
  const int pieces = points() - 1;
  if (pieces < 1) return {};
  const double along = std::clamp(t, 0.0, 1.0) * pieces;
  const int first = std::min(static_cast<int>(along), pieces - 1);
  return {first, along - first};
}

JointVector JointPath::at(double t) const {
  const Place p = place(t);
  if (p.share == 0) return via_[p.first];
  if (p.share == 1) return via_[p.first + 1];
  return (1 - p.share) * via_[p.first] + p.share * via_[p.first + 1];
}

std::vector<double> JointPath::times(int steps) {
  if (steps < 1) throw UsageError("joint path: " + std::to_string(steps) + " time steps, expected at least 1");
  std::vector<double> t(steps + 1);
  for (int k = 0; k <= steps; ++k) t[k] = static_cast<double>(k) / steps;
  return t;
}

JointVector JointPath::largest_speeds(double seconds) const {
  if (!(seconds > 0) || !std::isfinite(seconds))
    throw UsageError("joint path: it takes " + number_text(seconds) + " s, expected more than 0");
  JointVector largest = JointVector::Zero(size());
  for (int k = 0; k + 1 < points(); ++k) largest = largest.cwiseMax((via_[k + 1] - via_[k]).cwiseAbs());
  return (points() - 1) / seconds * largest;
}

double JointPath::length(const std::vector<double>& weights) const {
  check_weights(weights, size());
  double sum = 0;
  for (int k = 0; k + 1 < points(); ++k) sum += std::sqrt(squared(via_[k + 1] - via_[k], weights));
  return sum;
}

double JointPath::effort(const std::vector<double>& weights) const {
  check_weights(weights, size());
  double sum = 0;
  for (int k = 0; k + 1 < points(); ++k) sum += squared(via_[k + 1] - via_[k], weights);
  return 0.5 * (points() - 1) * sum;
}

JointPath JointPath::resampled(int points) const {
  if (points < 2) throw UsageError("joint path: " + std::to_string(points) + " via points, expected at least 2");
  std::vector<JointVector> via;
  for (const double t : times(points - 1)) via.push_back(at(t));
  return JointPath(std::move(via));
}

std::string beyond_robot(const JointPath& path, const Robot& robot, double seconds) {
  if (path.size() != robot.size())
    return "the path has " + std::to_string(path.size()) + " joint values, " + robot.name() + " has " + std::to_string(robot.size());
  for (int k = 0; k < path.points(); ++k) {
    const JointVector& q = path.via()[k];
    const std::string beyond = robot.beyond_limits({q.data(), static_cast<std::size_t>(q.size())}, rounding);
    if (!beyond.empty()) return "via point " + std::to_string(k) + ": " + beyond;
  }
  if (!(seconds > 0)) return {};
  const JointVector speeds = path.largest_speeds(seconds);
  for (int k = 0; k < robot.size(); ++k)
    if (speeds[k] > robot.variable(k).velocity * (1 + rounding))
      return robot.variable(k).name + " moves at " + number_text(speeds[k]) + ", at most " +
             number_text(robot.variable(k).velocity) + " is possible; give the path more than " + number_text(seconds) + " s";
  return {};
}

}  // namespace tendril::dress_pack
