// Envelopes from a script. Builders keep their memory from call to call: one serves a whole session.
#pragma once

#include <memory>

#include "binding/lua_class.h"
#include "binding/scene_classes.h"
#include "binding/variation_classes.h"
#include "method/envelope/envelope.h"

namespace tendril::lua {

void bind_envelope(lua_State* L);
/// variation:envelope and motion:envelope.
void add_envelope_to(Class<VariationHandle>& variation, const std::shared_ptr<EnvelopeBuilder>& builder);
void add_envelope_to(Class<SceneMotion>& motion, const std::shared_ptr<EnvelopeBuilder>& builder);

}  // namespace tendril::lua
