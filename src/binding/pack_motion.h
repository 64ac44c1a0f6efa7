// Motions of dress packs in Lua.
#pragma once

#include "binding/dress_pack_classes.h"
#include "binding/lua_class.h"

namespace tendril::lua {

/// A scene `s` with a six-axis robot and a hose from its upper arm to its hand, as Lua source for examples.
inline constexpr const char* pack_scene_example =
    "local bot = robot.load(\"builtin:six_axis\")\n"
    "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
    "local hose = rod.new{length = 1.6, section = rod.section{outer = 0.03, inner = 0.02, material = rubber}, segments = 16}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:robot(\"arm\", bot)\n"
    "s:rod(\"hose\", hose)\n"
    "s:attach(\"hose\", \"start\", \"arm\", \"link_2\", frame{at = {0.05, 0.2, 0.75}, along = {1, 0, 1}})\n"
    "s:attach(\"hose\", \"finish\", \"arm\", \"link_6\", frame{at = {0.05, 0, 0.15}, along = {1, 0, 0}})\n";

/// The state of the rods at the time step nearest to t. Throws UsageError for t outside 0 ... 1 and a motion without states.
std::shared_ptr<SceneEquilibrium> frame_at(const PackMotionHandle& h, double t);

}  // namespace tendril::lua
