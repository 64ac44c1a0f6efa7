// What several examples of help begin with. Each example is a chunk that runs by itself.
#pragma once

#include <string>

namespace tendril::lua {

/// `rest` after a design `r`, a scene `s` and the rod `p` placed in it, held at both ends.
inline std::string with_hose(const std::string& rest) {
  return "local rubber = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
         "local r = rod.new{length = 1, section = rod.section{outer = 0.02, material = rubber}}\n"
         "local s = scene.new{gravity = {0, 0, -9.81}}\n"
         "local p = s:rod(\"hose\", r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}},\n"
         "                            to = frame{at = {0.9, 0, 0}, along = {1, 0, 0}}})\n" +
         rest;
}

/// ... and its equilibrium `eq`.
inline std::string with_equilibrium(const std::string& rest) { return with_hose("local eq = s:solve{}\n" + rest); }

/// `rest` after a scene `s` with a six-axis robot `arm`.
inline std::string with_robot(const std::string& rest) {
  return "local s = scene.new{gravity = {0, 0, -9.81}}\n"
         "local arm = s:robot(\"arm\", robot.load(\"builtin:six_axis\"))\n" +
         rest;
}

}  // namespace tendril::lua
