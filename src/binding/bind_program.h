// Programs of robot controllers, as methods of robots.
#pragma once

#include "binding/lua_class.h"
#include "binding/robot_classes.h"
#include "binding/schema.h"

namespace tendril::lua {

/// How a path is written, whatever the dialect: name, speed, zone, axes.
Schema program_form();

/// `path`: joint values; `o`: of program_form().
std::string program_text(const Robot& robot, const std::vector<std::vector<double>>& path, const std::string& dialect, const Options& o);

/// bot:program and bot:read_program.
void add_programs(Class<RobotValue>& bound);

}  // namespace tendril::lua
