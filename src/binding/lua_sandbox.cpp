#include "binding/lua_sandbox.h"

#include <lua.hpp>

#include <string_view>

namespace tendril::lua {
namespace {

void remove_global(lua_State* L, const char* name) {
  lua_pushnil(L);
  lua_setglobal(L, name);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);  // else `require` would hand it out
  lua_pushnil(L);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

/// A new table in place of a library, with some of its functions.
void keep_only(lua_State* L, const char* library, std::initializer_list<const char*> names) {
  lua_getglobal(L, library);
  lua_newtable(L);
  for (const char* name : names) {
    lua_getfield(L, -2, name);
    lua_setfield(L, -2, name);
  }
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_pushvalue(L, -2);
  lua_setfield(L, -2, library);
  lua_pop(L, 1);
  lua_setglobal(L, library);
  lua_pop(L, 1);
}

/// Upvalue 1: the library's own collectgarbage. What tunes or stops the collector would move the limit of memory.
int collect_garbage(lua_State* L) {
  const std::string_view wanted = luaL_optstring(L, 1, "collect");
  for (const char* allowed : {"collect", "count", "step", "isrunning"})
    if (wanted == allowed) return lua_tocfunction(L, lua_upvalueindex(1))(L);
  return luaL_error(L, "collectgarbage: '%s' is not allowed in the sandbox", wanted.data());
}

void seal_strings(lua_State* L) {
  lua_getglobal(L, "string");
  lua_pushnil(L);
  lua_setfield(L, -2, "dump");
  lua_pop(L, 1);
  lua_pushliteral(L, "");
  lua_getmetatable(L, -1);
  lua_pushliteral(L, "string");
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 2);
}

}  // namespace

void restrict_to_sandbox(lua_State* L) {
  for (const char* name : {"io", "debug", "package", "dofile", "loadfile"}) remove_global(L, name);
  keep_only(L, "os", {"time", "clock", "date", "difftime"});
  lua_getglobal(L, "collectgarbage");
  lua_pushcclosure(L, collect_garbage, 1);
  lua_setglobal(L, "collectgarbage");
  seal_strings(L);
}

}  // namespace tendril::lua
