#include "binding/shell_services.h"

namespace tendril::lua {
namespace {

constexpr char key = 0;  // its address is the key in Lua's registry

}  // namespace

void provide(lua_State* L, const ShellServices& services) {
  lua_pushlightuserdata(L, const_cast<ShellServices*>(&services));
  lua_rawsetp(L, LUA_REGISTRYINDEX, &key);
}

const ShellServices& shell_services(lua_State* L) {
  static const ShellServices none;
  lua_rawgetp(L, LUA_REGISTRYINDEX, &key);
  const auto* provided = static_cast<const ShellServices*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return provided ? *provided : none;
}

}  // namespace tendril::lua
