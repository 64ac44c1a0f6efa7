// One segment of the rod in mixed form: its ends and its wrench are independent of each other (Hellinger and Reissner).
//
//     P(ends, W) = h (W . (eps - eps0) - 1/2 W . F W - q/2 U . K^-1 U),   U = ad_eps^T W,   eps = xi/h,
// with xi = log of the relative motion, q = h^2/12 and F = K^-1 (A K^-1 A^T where the reference curvature varies). P is largest by W
// at the wrench of the fourth-order element of se3_element.h and is then its energy: its stationary points are those of the rod. It
// is a polynomial in W, so the large stiffness against stretch does not make the equations hard.
//
// Increments of the ends: (dr_a, theta_a, dr_b, theta_b), positions in world axes, rotations in the sections' own axes. Second
// derivatives are the symmetric ones along R exp([theta]).
#pragma once

#include "rod/se3_element.h"
#include "statics/block_system.h"

namespace tendril::dress_pack {

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;
using Mat12x6 = Eigen::Matrix<double, 12, 6>;

/// xi of two section frames, and how functions of it are derived by the frames.
class SegmentMotion {
 public:
  SegmentMotion(const Vec3& ra, const Quat& qa, const Vec3& rb, const Quat& qb);

  const Vec6& xi() const { return xi_; }
  /// Its derivative by the increments, transposed.
  const Mat12x6& slope() const { return slope_; }

  /// Of a function with these derivatives by xi.
  Vec12 gradient(const Vec6& by_xi) const { return slope_ * by_xi; }
  Mat12 hessian(const Vec6& by_xi, const Mat6& by_xi_twice) const;

 private:
  Mat3 axes_;
  Mat3 a_;  ///< inverse left Jacobian
  Mat3 g_;  ///< d(A d)/dphi
  Vec3 d_, phi_;
  JacobianCoefficients<double> k_;
  Vec6 xi_;
  Mat12x6 slope_;
};

struct MixedTerms {
  double value = 0;
  Vec12 by_ends;
  Vec6 by_wrench;
  Mat12 ends_ends;
  Mat12x6 ends_wrench;
  Mat6 wrench_wrench;
};

class MixedSegment {
 public:
  explicit MixedSegment(const Se3Segment<double>& segment);

  /// `second` false: value and first derivatives alone.
  void terms(const SegmentMotion& motion, const Vec6& wrench, bool second, MixedTerms& out) const;

  /// The wrench (force N, moment N m, section axes at mid-segment) at which P is largest.
  Vec6 wrench(const SegmentMotion& motion) const;

 private:
  Mat6 flexibility(const Mat6& ad) const;  ///< F + q ad K^-1 ad^T

  double h_, q_;
  Vec6 k_;     ///< K^-1 by component
  Mat6 rest_;  ///< F
  Vec6 rate_;  ///< eps0
};

}  // namespace tendril::dress_pack
