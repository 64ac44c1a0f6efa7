// A place and orientation of a rod's section, in world axes.
#pragma once

#include "base/vectors.h"

namespace tendril {

/// Position (m) and rotation of a section. The columns of the rotation are the directors d1, d2, d3; d3 is the section
/// normal, which is the tangent of the unstressed rod.
struct Frame {
  Vec3 at = Vec3::Zero();
  Quat rotation = Quat::Identity();

  Vec3 d1() const { return rotation * Vec3::UnitX(); }
  Vec3 d2() const { return rotation * Vec3::UnitY(); }
  Vec3 d3() const { return rotation * Vec3::UnitZ(); }

  /// This frame followed by `local`, which is given in this frame's own axes.
  Frame operator*(const Frame& local) const { return {at + rotation * local.at, rotation * local.rotation}; }
  Frame inverse() const { return {rotation.conjugate() * (-at), rotation.conjugate()}; }

  /// Moved by `by` (m, world axes) and turned by `angle` (rad) about the world axis `axis` through the frame's own place.
  Frame moved(const Vec3& by, const Vec3& axis = Vec3::UnitZ(), double angle = 0) const;

  /// d3 along `along`, d1 from `up` made normal to it. Without an `up` (zero vector) the world axis farthest from
  /// `along`, z first, is used. Throws UsageError for a zero or non-finite `along` and for an `up` parallel to it.
  static Frame looking(const Vec3& at, const Vec3& along, const Vec3& up = Vec3::Zero());
};

/// The smallest rotation that takes the unit vector `from` to the unit vector `to`; for opposite vectors a half turn
/// about some axis normal to both.
Quat shortest_turn(const Vec3& from, const Vec3& to);

/// exp of a rotation vector (rad) and its inverse; the logarithm has a length of at most pi.
Quat exp_rotation(const Vec3& rotation_vector);
Vec3 log_rotation(const Quat& rotation);

}  // namespace tendril
