// Scenes in files, for scripts.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// scene:save.
void add_scene_file_to(Class<Scene>& scene);

/// scene.load.
void add_scene_file_to(Module& scene);

}  // namespace tendril::lua
