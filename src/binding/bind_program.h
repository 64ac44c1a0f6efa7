// Programs of robot controllers, as methods of robots.
#pragma once

#include "binding/lua_class.h"
#include "binding/robot_classes.h"

namespace tendril::lua {

/// bot:program and bot:read_program.
void add_programs(Class<RobotValue>& bound);

}  // namespace tendril::lua
