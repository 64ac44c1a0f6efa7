// Harness files of the car industry into scenes.
#pragma once

#include "binding/lua_class.h"

namespace tendril::lua {

/// Adds scene.import and the classes of what it tells.
void add_import(lua_State* L, Module& scene);

}  // namespace tendril::lua
