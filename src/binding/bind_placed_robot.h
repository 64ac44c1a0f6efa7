// The part of a scene's class that places robots and attaches rods to them.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

void add_robots_to(Class<Scene>& scene);

}  // namespace tendril::lua
