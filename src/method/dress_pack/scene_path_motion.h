// A scene whose robot follows a path, quasi-statically, with the rods that it carries.
#pragma once

#include <string_view>

#include "method/dress_pack/pack_simulation.h"
#include "scene/scene_motion.h"

namespace tendril::dress_pack {

/// simulate() for the pack of a scene's robot: an equilibrium of the scene at each time step, snap-throughs with their places. What
/// the simulation says is beyond the robot's limits, or has no equilibrium, is the motion's status and message. Throws UsageError as
/// pack_of() and simulate() do, for rods of the scene that are not attached to this robot, and for values that do not fit the robot.
SceneMotion move_robot(const Scene& scene, std::string_view robot, const JointPath& path, const SimulationOptions& options,
                       const RunContext& context);

}  // namespace tendril::dress_pack
