// Dress packs for tests and benchmarks: a hose on a planar two-link arm, and one from the upper arm to the hand of a six-axis robot.
#pragma once

#include "method/dress_pack/pack.h"
#include "unit/robot/arms.h"

namespace tendril::test {

using dress_pack::JointPath;
using dress_pack::JointVector;
using dress_pack::PackProblem;

/// EI 2 N m^2, GJ 1.4 N m^2, EA 20 kN, 15 N/m.
inline Section hose_section() {
  Section section;
  section.outer = 0.03;
  section.EA = 20e3;
  section.GA1 = section.GA2 = 8e3;
  section.EI1 = section.EI2 = 2;
  section.GJ = 1.4;
  section.mass = 15 / 9.81;
  return section;
}

inline RodProblem hose(double length, int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(length, hose_section(), segments);
  problem.holds = {{0, {}}, {length, {{0.8 * length, 0, 0}, Quat::Identity()}}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

inline JointVector degrees(std::initializer_list<double> values) {
  JointVector q(static_cast<int>(values.size()));
  int k = 0;
  for (const double value : values) q[k++] = value * units::deg;
  return q;
}

/// A six-axis arm with a hose of 1.6 m from beside its elbow to its hand.
inline PackProblem six_axis_pack(int segments = 16) {
  ArmShape shape;
  shape.limit = 3.1;
  PackProblem pack;
  pack.robot = arm(shape);
  pack.rods = {hose(1.6, segments)};
  pack.attachments = {{0, 0, 3, Frame::looking({0.1, 0, 0.35}, {1, 0, 0}, {0, 0, 1})},
                      {0, 1, 6, Frame::looking({0.05, 0, 0.2}, {1, 0, 0}, {0, 0, 1})}};
  return pack;
}

/// The hose is wrung and hangs taut under the hand on the way; both ends of the path are easy.
inline JointPath problematic_path(int via = 8) {
  return JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 80, -70, 40}), degrees({40, 0, 0, 160, 30, 50})}).resampled(via);
}

/// A planar two-link arm in the plane x, y with a hose from its base to its tip, without weight, and too stiff to leave the plane.
inline PackProblem planar_pack(int segments = 16) {
  PackProblem pack;
  Robot robot = planar_arm({0.6, 0.5});
  pack.robot = std::make_shared<const Robot>(std::move(robot));
  pack.rods = {hose(1.2, segments)};
  pack.rods[0].gravity.setZero();
  Section flat = hose_section();
  flat.EI2 = 80;  // d1 is normal to the plane
  flat.GJ = 56;
  pack.rods[0].rod = Rod::uniform(1.2, flat, segments);
  pack.attachments = {{0, 0, 0, Frame::looking({0, 0.1, 0}, {1, 0, 0}, {0, 0, 1})},
                      {0, 1, 3, Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1})}};
  return pack;
}

/// Random joint values between -reach and reach.
inline JointVector random_values(int size, double reach, Random& random) {
  JointVector q(size);
  for (int k = 0; k < size; ++k) q[k] = random.in(-reach, reach);
  return q;
}

}  // namespace tendril::test
