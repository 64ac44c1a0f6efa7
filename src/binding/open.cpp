#include "binding/open.h"

#include "binding/lua_class.h"

namespace tendril::lua {

void open_tendril(lua_State* L) {
  Module(L, "", "Global functions");
  bind_units(L);
  bind_vec(L);
  bind_frame(L);
  bind_rod(L);
  bind_curve(L);
  bind_scene(L);
  bind_branch(L);
  bind_equilibrium(L);
  bind_robot(L);
  bind_placed_robot(L);
  bind_gradient(L);
  bind_method(L);
  bind_view(L);
  bind_study(L);
  bind_session(L);
  bind_help(L);
  bind_time(L);
}

}  // namespace tendril::lua
