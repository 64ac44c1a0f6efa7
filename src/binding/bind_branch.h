// Branch points from a script.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// scene:branch and scene.branches.
void add_branch_to(Class<Scene>& scene);

}  // namespace tendril::lua
