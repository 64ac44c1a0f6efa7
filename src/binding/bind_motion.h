// Moving holds from a script.
#pragma once

#include "binding/lua_class.h"
#include "binding/scene_classes.h"
#include "method/envelope/envelope.h"

namespace tendril::lua {

void bind_motion(lua_State* L, const std::shared_ptr<EnvelopeBuilder>& builder);

/// scene:motion.
void add_motion_to(Class<Scene>& scene);

/// study.motion.
void add_sampled_motion_to(Module& study);

}  // namespace tendril::lua
