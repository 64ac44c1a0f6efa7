// Six-axis arms with a spherical wrist, of all sorts of offsets.
#pragma once

#include <memory>

#include "unit/robot/robots.h"

namespace tendril::test {

struct ArmShape {
  Vec3 shoulder{0.3, 0, 0.4}, elbow{0, 0, 1.05}, fore{0.4, 0, 0.2}, wrist{0.76, 0, 0}, hand{0.2, 0, 0};
  double limit = units::pi;
};

inline std::shared_ptr<const Robot> arm(const ArmShape& s = {}) {
  const Vec3 at[] = {{0, 0, 0.4}, s.shoulder, s.elbow, s.fore, s.wrist, s.hand};
  const Vec3 axis[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()};
  std::vector<Joint> joints;
  for (int k = 0; k < 6; ++k)
    joints.push_back(
        {"joint_" + std::to_string(k + 1), JointKind::revolute, k, {at[k], Quat::Identity()}, axis[k], -s.limit, s.limit});
  joints.push_back({"flange", JointKind::fixed, 6, {{0.1, 0, 0}, exp_rotation({0, 1.3, 0})}});
  return std::make_shared<const Robot>("arm", named_links(8), joints);
}

/// The same arm, or one with sideways offsets, seen in turned and shifted joint frames, with axes pointing either way and
/// another zero position.
inline std::shared_ptr<const Robot> random_arm(Random& random) {
  ArmShape s;
  s.shoulder = {random.in(-0.4, 0.4), random.in(-0.1, 0.1), random.in(0, 0.5)};
  s.elbow = {random.in(-0.2, 0.2), random.in(-0.2, 0.2), random.in(0.5, 1.2)};
  s.fore = {random.in(-0.3, 0.6), random.in(-0.1, 0.2), random.in(-0.2, 0.3)};
  s.wrist = {random.in(0.4, 1.7), 0, 0};
  const auto plain = arm(s);
  std::vector<Joint> joints = plain->joints();
  Quat before = Quat::Identity();
  for (Joint& joint : joints) {  // the same axes in frames turned at will
    const Quat turn = random.rotation();
    joint.origin = {before.conjugate() * joint.origin.at, before.conjugate() * joint.origin.rotation * turn};
    joint.axis = turn.conjugate() * joint.axis;
    if (random.below(2)) joint.axis = -joint.axis;
    if (joint.kind != JointKind::fixed)
      joint.origin.rotation = joint.origin.rotation * exp_rotation(random.in(-3, 3) * joint.axis);
    before = turn;
    joint.origin.rotation.normalize();
  }
  return std::make_shared<const Robot>("arm", named_links(joints.size() + 1), joints);
}

}  // namespace tendril::test
