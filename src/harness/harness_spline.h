// The centre curves of harness files as polynomials that can be measured: positions, tangents, curvature, arc length.
#pragma once

#include <array>
#include <vector>

#include "harness/harness_file.h"

namespace tendril {

/// How a B-spline without knots is meant. Both have equal steps between its inner knots; clamped repeats the outer ones, so that
/// the curve begins and ends at its outer control points, unclamped goes on in equal steps, and it ends between them. KBL allows both
/// and does not say which (prostep ivip, KBL implementation guideline "3D B-Spline Representation").
enum class KnotReading { clamped, unclamped };

/// The curve's own knots, or those that the reading gives it: points + degree + 1 of them.
std::vector<double> knots_of(const HarnessCurve& curve, KnotReading reading);

/// One polynomial (with weights: rational) piece, between two neighbouring knots, over t = 0 ... 1.
class SplineSpan {
 public:
  /// `span`: the index of the knot it begins at, from degree to points - 1.
  SplineSpan(const HarnessCurve& curve, const std::vector<double>& knots, int span);

  struct Values {
    Vec3 at, first, second;  ///< position (m) and its derivatives by t
  };
  Values values(double t) const;

  double length() const { return reached_.back(); }  ///< m
  /// The t where the piece has run so far (m, within 0 ... length()).
  double parameter(double arc_length) const;
  double length_to(double t) const;      ///< m, from t = 0

 private:
  double length_between(double t0, double t1) const;
  double speed(double t) const;  ///< m per t

  static constexpr int parts = 8;
  using Coefficient = Eigen::Vector4d;  ///< x, y, z times the weight, and the weight

  std::vector<Coefficient> powers_;     ///< of t, rising
  std::vector<Coefficient> rates_;      ///< the same of the derivative
  bool rational_ = false;
  std::array<double, parts + 1> reached_{};  ///< arc length at t = k / parts
};

/// The pieces of positive extent, in order.
std::vector<SplineSpan> spans_of(const HarnessCurve& curve, KnotReading reading);

}  // namespace tendril
