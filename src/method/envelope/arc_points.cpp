#include "method/envelope/arc_points.h"

#include <cmath>

namespace tendril::envelope {
namespace {

/// (1 - cos a) / a^2, (a - sin a) / a^3 and (1 - (a / 2) cot(a / 2)) / a^2, also near zero.
double cosine_rest(double a) {
  const double s = a * a;
  return s < 1e-3 ? 0.5 - s / 24 + s * s / 720 : (1 - std::cos(a)) / s;
}
double sine_rest(double a) {
  const double s = a * a;
  return s < 1e-3 ? 1.0 / 6 - s / 120 + s * s / 5040 : (a - std::sin(a)) / (s * a);
}
double cotangent_rest(double a) {
  const double s = a * a;
  return s < 1e-3 ? 1.0 / 12 + s / 720 + s * s / 30240 : (1 - 0.5 * a / std::tan(0.5 * a)) / s;
}

}  // namespace

ElementArc::ElementArc(const double* a, const double* b) : start_(a[0], a[1], a[2]) {
  const Quat turn = Quat(b[3], b[4], b[5], b[6]) * Quat(a[3], a[4], a[5], a[6]).conjugate();
  const double sign = turn.w() < 0 ? -1 : 1, sine = turn.vec().norm();
  const double half = std::atan2(sine, sign * turn.w());
  const Vec3 omega = sign * turn.vec() * (sine > 1e-12 ? 2 * half / sine : 2.0);
  angle_ = omega.norm();
  const Vec3 chord = Vec3(b[0], b[1], b[2]) - start_;
  const Vec3 across = omega.cross(chord);
  velocity_ = chord - 0.5 * across + cotangent_rest(angle_) * omega.cross(across);
  turned_ = omega.cross(velocity_);
  twice_turned_ = omega.cross(turned_);
  turned_speed_ = turned_.norm();
}

Vec3 ElementArc::at(double share) const {
  const double a = share * angle_;
  return start_ + share * velocity_ + share * share * cosine_rest(a) * turned_ +
         share * share * share * sine_rest(a) * twice_turned_;
}

}  // namespace tendril::envelope
