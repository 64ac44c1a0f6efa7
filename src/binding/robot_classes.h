// Robots as scripts hold them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "binding/lua_value.h"
#include "robot/inverse.h"
#include "robot/robot_collision.h"

namespace tendril::lua {

/// A robot, and what was prepared for the questions asked so far.
struct RobotValue {
  std::shared_ptr<const Robot> robot;
  std::map<int, std::shared_ptr<const InverseKinematics>> inverse = {};  ///< by link
  std::shared_ptr<const RobotCollision> collision = nullptr;             ///< with itself
  std::shared_ptr<const RobotCollision> surrounded = nullptr;            ///< with the obstacles of the last scene asked about
  std::string surroundings = {};                                         ///< which those were
};

/// A joint that moves by itself.
struct JointValue {
  std::shared_ptr<const Robot> robot;
  int variable = 0;
  const Joint& joint() const { return robot->variable(variable); }
};

template <> inline constexpr const char* class_name<RobotValue> = "robot";
template <> inline constexpr const char* class_name<JointValue> = "joint";

}  // namespace tendril::lua
