// method: what engineers do with scenes. Each method binds in a file of its own.
#pragma once

#include <memory>

#include "binding/lua_class.h"
#include "method/envelope/envelope.h"

namespace tendril::lua {

void bind_assembly(lua_State* L);
void bind_dress_pack(lua_State* L);
void bind_pack_design(lua_State* L);
void bind_pack_motion(lua_State* L);
void bind_flatten(lua_State* L);
void bind_harness(lua_State* L);
void bind_preform(lua_State* L);
void bind_refine(lua_State* L);
void bind_route(lua_State* L);
void bind_route_all(lua_State* L);
void bind_stability(lua_State* L);
void bind_variation(lua_State* L, const std::shared_ptr<EnvelopeBuilder>& builder);
void add_assembly_to(Module& method);
void add_dress_pack_to(Module& method);
void add_pack_design_to(Module& method);
void add_flatten_to(Module& method);
void add_harness_to(Module& method);
void add_preform_to(Module& method);
void add_refine_to(Module& method);
void add_route_to(Module& method);
void add_route_all_to(Module& method);
void add_stability_to(Module& method);
void add_variation_to(Module& method);

}  // namespace tendril::lua
