// The smallest gap between a rod and an obstacle, as a script asks for it and gets it.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// With the obstacle's name and what it requires.
ClearanceValue clearance_value(const SceneEquilibrium& equilibrium, const SolvedRod& rod, const Clearance& clearance);

/// from, to.
Schema clearance_options();
/// What those options ask for. Throws UsageError without `from` where there are several rods, and for unknown names.
ClearanceValue clearance_between(const SceneEquilibrium& equilibrium, const Options& o);

}  // namespace tendril::lua
