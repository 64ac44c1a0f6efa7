// What a harness is measured by, for scripts.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// equilibrium:quantities, and the classes of what it returns.
void add_quantities_to(lua_State* L, Class<SceneEquilibrium>& equilibrium);

}  // namespace tendril::lua
