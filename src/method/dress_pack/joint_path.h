// A robot's path through via points: linear in the joint values between neighbours, all of them at the same distance in time.
#pragma once

#include <vector>

#include "robot/robot.h"

namespace tendril::dress_pack {

using JointVector = Eigen::VectorXd;  ///< in the order of Robot::variables(), rad or m

/// Via points at the times 0, 1/(n-1), ..., 1. A single one is a robot that stands still.
class JointPath {
 public:
  JointPath() = default;

  /// Throws UsageError for no via points, for ones of different sizes and for numbers that are not finite.
  explicit JointPath(std::vector<JointVector> via);

  const std::vector<JointVector>& via() const { return via_; }
  int points() const { return static_cast<int>(via_.size()); }
  int size() const { return via_.empty() ? 0 : static_cast<int>(via_.front().size()); }  ///< joints

  /// Joint values at a time are (1 - share) via[first] + share via[first + 1]; a single via point has itself twice.
  struct Place {
    int first = 0;
    double share = 0;
  };
  /// `t` is drawn into 0 ... 1.
  Place place(double t) const;
  JointVector at(double t) const;

  /// The times 0, 1/steps, ..., 1. Throws UsageError for less than one step.
  static std::vector<double> times(int steps);

  /// Largest speed of each joint when the path takes so many seconds; rad/s or m/s. Throws UsageError unless seconds > 0.
  JointVector largest_speeds(double seconds) const;

  /// Sum over the pieces of |weights . du|. `weights`: one number for each joint, empty: all 1.
  double length(const std::vector<double>& weights = {}) const;

  /// 1/2 (n - 1) sum |weights . du|^2: at a given course of the path least when its speed is uniform, then length^2 / 2.
  double effort(const std::vector<double>& weights = {}) const;

  /// The same course through more via points: `points` evenly spaced in time, and none of the old ones is moved when
  /// points - 1 is a multiple of points() - 1. Throws UsageError for less than two.
  JointPath resampled(int points) const;

 private:
  std::vector<JointVector> via_;
};

/// What the robot cannot do of a path, in words; empty when nothing: joint values beyond their limits and, with `seconds` > 0,
/// speeds beyond the joints'. Linear pieces are within their limits where the via points are.
std::string beyond_robot(const JointPath& path, const Robot& robot, double seconds = 0);

}  // namespace tendril::dress_pack
