// Robots for tests: a planar arm, trees of random joints, arms with a spherical wrist, and a real one where it is there.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "base/units.h"
#include "robot/robot.h"
#include "unit/base/random_numbers.h"

namespace tendril::test {

inline std::vector<Link> named_links(std::size_t count) {
  std::vector<Link> links;
  for (std::size_t i = 0; i < count; ++i) links.push_back({"link_" + std::to_string(i)});
  return links;
}

/// Turns about z, each link along x; the last frame at the tip.
inline Robot planar_arm(const std::vector<double>& lengths) {
  std::vector<Joint> joints;
  for (std::size_t k = 0; k <= lengths.size(); ++k) {
    Joint joint;
    joint.name = "joint_" + std::to_string(k + 1);
    joint.parent = static_cast<int>(k);
    joint.origin.at = {k == 0 ? 0 : lengths[k - 1], 0, 0};
    joint.axis = Vec3::UnitZ();
    if (k < lengths.size()) {
      joint.kind = JointKind::revolute;
      joint.lower = -units::pi;
      joint.upper = units::pi;
    }
    joints.push_back(joint);
  }
  return Robot("planar", named_links(lengths.size() + 2), joints);
}

/// Every kind of joint, with branches and mimicry.
inline Robot random_tree(int count, Random& random) {
  std::vector<Joint> joints;
  for (int k = 0; k < count; ++k) {
    Joint joint;
    joint.name = "j" + std::to_string(k);
    joint.parent = random.below(k + 1);
    joint.origin = {random.point(1), random.rotation()};
    joint.axis = random.in(0.1, 3) * random.direction();
    joint.kind = static_cast<JointKind>(random.below(4));
    joint.lower = -4;
    joint.upper = 4;
    const int other = k > 0 ? random.below(k) : 0;
    if (k > 0 && random.below(4) == 0 && joint.kind != JointKind::fixed && joints[other].kind != JointKind::fixed &&
        joints[other].mimics == -1) {
      joint.mimics = other;
      joint.factor = random.in(-2, 2);
      joint.shift = random.in(-1, 1);
      joint.lower = -40;
      joint.upper = 40;
    }
    joints.push_back(joint);
  }
  return Robot("tree", named_links(joints.size() + 1), joints);
}

inline std::vector<double> random_values(const Robot& robot, Random& random) {
  std::vector<double> q;
  for (int k = 0; k < robot.size(); ++k)
    q.push_back(random.in(std::max(robot.lower()[k], -units::pi), std::min(robot.upper()[k], units::pi)));
  return q;
}

/// How far apart two frames are, m and rad.
inline double difference(const Frame& a, const Frame& b) {
  return (a.at - b.at).norm() + log_rotation(a.rotation.conjugate() * b.rotation).norm();
}

/// The real robot's description, or an empty path where the folder of shared data is not there.
inline std::string real_robot() {
  const char* named = std::getenv("TENDRIL_SHARED");
  const std::filesystem::path file = std::filesystem::path(named ? named : "../shared") / "data/robots/irb6640/irb6640.urdf";
  return std::filesystem::exists(file) ? file.string() : "";
}

}  // namespace tendril::test
