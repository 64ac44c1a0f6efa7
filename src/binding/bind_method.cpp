#include "binding/bind_method.h"

#include "binding/bind_envelope.h"
#include "binding/bind_motion.h"
#include "binding/method_steps.h"
#include "binding/open.h"

namespace tendril::lua {

void bind_method(lua_State* L) {
  const auto builder = std::make_shared<EnvelopeBuilder>();
  bind_assembly(L);
  bind_dress_pack(L);
  bind_pack_design(L);
  bind_pack_motion(L);
  bind_envelope(L);
  bind_motion(L, builder);
  bind_flatten(L);
  bind_harness(L);
  bind_preform(L);
  bind_refine(L);
  bind_route(L);
  bind_route_all(L);
  bind_steps(L);
  bind_stability(L);
  bind_variation(L, builder);
  Module method(L, "method", "What engineers do with scenes: analyses and searches that take a scene and never change it");
  add_assembly_to(method);
  add_dress_pack_to(method);
  add_pack_design_to(method);
  add_flatten_to(method);
  add_harness_to(method);
  add_preform_to(method);
  add_refine_to(method);
  add_route_to(method);
  add_route_all_to(method);
  add_stability_to(method);
  add_variation_to(method);
}

}  // namespace tendril::lua
