// Closed-form inverse kinematics of six-axis arms with a spherical wrist.
//
// The axes as screws in the arm's zero position: axes 2 and 3 are parallel, axes 4, 5 and 6 meet in the wrist centre. All
// offsets between them are allowed, also sideways ones. The wrist centre's place then fixes joints 1 to 3 and the rest of
// the rotation joints 4 to 6, each step by one of the subproblems of Paden and Kahan (Murray, Li, Sastry: A Mathematical
// Introduction to Robotic Manipulation, 1994, 3.3; the fourth: Elias and Wen, IK-Geo, 2025): up to 2 x 2 x 2 solutions.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"

namespace tendril {

/// A turning joint's axis in the zero position: a point on it (m) and its direction (unit).
struct ScrewAxis {
  Vec3 at, along;
};

class SphericalWristArm {
 public:
  using Angles = std::array<double, 6>;

  struct Branches {
    std::vector<Angles> angles;  ///< rad, within -pi ... pi
    std::string singular;        ///< what is free or met another branch, in words; empty: nothing
    std::string out_of_reach;    ///< why there are no angles
  };

  /// `tip`: of the link in the zero position. Nothing, and why, when the axes are of another kind.
  static std::optional<SphericalWristArm> from_axes(const std::array<ScrewAxis, 6>& axes, const Frame& tip, std::string& why_not);

  /// All angles that bring the tip to the target. Where the arm is singular the joints that are free stand as in `near`.
  Branches solve(const Frame& target, const Angles& near, const std::array<std::string, 6>& names) const;

 private:
  struct Search;
  std::vector<double> shoulder(const Vec3& wrist, Search& search) const;
  void elbow(const Vec3& wrist, Angles angles, const Mat3& rotation, Search& search) const;
  void hand(Angles angles, const Mat3& rotation, Search& search) const;

  std::array<ScrewAxis, 6> axes_;
  Vec3 wrist_;
  Frame tip_inverse_;
  double size_ = 1;    ///< m
  Vec3 upper_, fore_;  ///< from axis 2 to 3 and from axis 3 to the wrist, normal to them, m
};

}  // namespace tendril
