#include "binding/open.h"

#include "binding/lua_class.h"

namespace tendril::lua {

void open_tendril(lua_State* L) {
  Module(L, "", "Global functions");
  bind_units(L);
  bind_vec(L);
  bind_frame(L);
  bind_help(L);
  bind_time(L);
}

}  // namespace tendril::lua
