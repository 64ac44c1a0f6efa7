// Scenes, equilibria and motions into files that other programs show.
#pragma once

#include "binding/lua_class.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "scene/scene_surfaces.h"

namespace tendril::lua {

/// scene:export.
void add_export_to(Class<Scene>& scene);
/// equilibrium:save.
void add_save_to(Class<SceneEquilibrium>& equilibrium);
/// motion:save.
void add_save_to(Class<SceneMotion>& motion);

/// What a moving scene shows, as options of a save.
Schema animation_options();

/// Writes an animated .glb of the states at `times` (s, rising; what does not rise in single precision is left out). Throws UsageError,
/// opening with `who`, for another suffix and fewer than two states.
SavedFile save_animation(const std::string& who, const std::string& path, const std::vector<double>& times,
                         const std::vector<std::shared_ptr<const SceneEquilibrium>>& states, const std::vector<CarriedBody>& carried,
                         const Options& o);

}  // namespace tendril::lua
