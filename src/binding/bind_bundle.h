// Wires and bundles of them, for scripts.
#pragma once

#include "binding/lua_class.h"

namespace tendril::lua {

/// rod.wire, rod.bundle, and the classes of what they return.
void add_bundles_to(lua_State* L, Module& rod);

}  // namespace tendril::lua
