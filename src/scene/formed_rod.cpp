#include "scene/formed_rod.h"

#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {

void form(Rod& rod, const Curve& curve) {
  rod.length = curve.length();
  rod.shape = CurveShape{curve};
  rod.shape_breaks = curve.breaks();
}

const Curve* curve_of(const Rod& rod) {
  const CurveShape* shape = rod.shape.target<CurveShape>();
  return shape ? &shape->curve : nullptr;
}

namespace {

/// The integral of exp(t phi) over t = 0 ... 1: where a screw of rotation vector phi and rate v leads is this times v.
Mat3 left_jacobian(const Vec3& phi) {
  const double angle2 = phi.squaredNorm(), angle = std::sqrt(angle2);
  const Mat3 k = cross_matrix(phi);
  const bool small = angle < 1e-4;
  const double a = small ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double b = small ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  return Mat3::Identity() + a * k + b * k * k;
}

}  // namespace

Frame FrameShape::operator()(double arc_length) const {
  const auto after = std::upper_bound(s.begin() + 1, s.end() - 1, arc_length);
  const std::size_t k = after - s.begin() - 1;
  const double share = std::clamp((arc_length - s[k]) / (s[k + 1] - s[k]), 0.0, 1.0);
  if (share == 0) return frames[k];
  if (share == 1) return frames[k + 1];
  const Frame way = frames[k].inverse() * frames[k + 1];
  const Vec3 phi = log_rotation(way.rotation), rate = left_jacobian(phi).partialPivLu().solve(way.at);
  return frames[k] * Frame{share * (left_jacobian(share * phi) * rate), exp_rotation(share * phi)};
}

void form(Rod& rod, const FrameShape& shape) {
  const auto& s = shape.s;
  bool good = s.size() >= 2 && s.size() == shape.frames.size() && s.front() == 0 && s.back() == rod.length;
  for (std::size_t k = 0; good && k < s.size(); ++k)
    good = (k == 0 || s[k] > s[k - 1]) && all_finite(shape.frames[k].at) && all_finite(shape.frames[k].rotation.coeffs());
  if (!good) throw UsageError("rod.new: 'shape' needs finite frames at arc lengths that rise from 0 to the rod's length");
  rod.shape = shape;
  rod.shape_breaks.assign(s.begin() + 1, s.end() - 1);
}

const FrameShape* frames_of(const Rod& rod) { return rod.shape.target<FrameShape>(); }

void check_bends(const Rod& rod, const Curve& curve, const std::string& who) {
  const double radius = curve.min_bend_radius(), at = curve.min_bend_radius_at();
  if (radius > rod.section_at(at).radius()) return;
  throw UsageError(who + ": 'shape' bends with a radius of " + number_text(radius / units::mm) + " mm at s = " +
                   number_text(at / units::mm) + " mm, expected more than the rod's own radius" +
                   (radius == 0 ? "; round its corners with curve.pcc" : ""));
}

}  // namespace tendril
