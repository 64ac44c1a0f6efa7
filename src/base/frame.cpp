#include "base/frame.h"

#include <cmath>

#include "base/error.h"

namespace tendril {

Frame Frame::moved(const Vec3& by, const Vec3& axis, double angle) const {
  const double length = axis.norm();
  if (!(length > 0)) throw UsageError("frame: the axis of a turn must not be zero");
  return {at + by, (exp_rotation(axis * (angle / length)) * rotation).normalized()};
}

Frame Frame::looking(const Vec3& at, const Vec3& along, const Vec3& up) {
  if (!all_finite(at)) throw UsageError("frame: 'at' must be finite numbers");
  const double length = along.norm();
  if (!std::isfinite(length) || length == 0) throw UsageError("frame: 'along' must be a finite vector other than zero");
  const Vec3 d3 = along / length;
  Vec3 wanted = up;
  if (up.isZero(0)) wanted = std::abs(d3.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 d1 = wanted - d3 * d3.dot(wanted);
  if (!all_finite(d1) || d1.norm() <= 1e-9 * wanted.norm())
    throw UsageError("frame: 'up' must not be parallel to 'along'");
  Mat3 axes;
  axes.col(0) = d1.normalized();
  axes.col(2) = d3;
  axes.col(1) = d3.cross(axes.col(0));
  return {at, Quat(axes).normalized()};
}

Quat shortest_turn(const Vec3& from, const Vec3& to) {
  const double cosine = from.dot(to);
  if (cosine > -1 + 1e-12) {
    const Vec3 axis = from.cross(to);
    return Quat(1 + cosine, axis.x(), axis.y(), axis.z()).normalized();
  }
  const Vec3 axis = from.unitOrthogonal();
  return Quat(0, axis.x(), axis.y(), axis.z());
}

Quat exp_rotation(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double half = 0.5 * angle;
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48 : std::sin(half) / angle;
  return {std::cos(half), scale * rotation_vector.x(), scale * rotation_vector.y(), scale * rotation_vector.z()};
}

Vec3 log_rotation(const Quat& rotation) {
  Vec3 axis = rotation.vec();
  double w = rotation.w();
  if (w < 0) {
    axis = -axis;
    w = -w;
  }
  const double sine = axis.norm();
  if (sine < 1e-5) return axis * (2 / w) * (1 - sine * sine / (3 * w * w));
  return axis * (2 * std::atan2(sine, w) / sine);
}

}  // namespace tendril
