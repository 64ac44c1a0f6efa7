// Moving holds from a script.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// scene:motion.
void add_motion_to(Class<Scene>& scene);

}  // namespace tendril::lua
