// Robots by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/robot.h"

namespace tendril {

/// The robots that come with the program, without the "builtin:" in front.
const std::vector<std::string>& builtin_robots();

/// "builtin:NAME" or the path of a URDF file. What comes with the program lies in its folder of assets (base/installation.h). Throws
/// UsageError as load_urdf() does, for an unknown builtin name, and for one whose files are missing.
std::shared_ptr<const Robot> load_robot(const std::string& name);

}  // namespace tendril
