// Scripts are source text. A binary chunk can crash the interpreter, and a native library may be built against another
// Lua: neither is loaded.
#include <cstring>

#include "base/file_access.h"
#include "binding/lua_context.h"

namespace tendril::lua {
namespace {

/// Makes the mode argument at `index` "t"; false when the caller wants binary chunks only.
bool force_text_mode(lua_State* L, int index) {
  if (lua_gettop(L) < index) lua_settop(L, index);
  const char* mode = luaL_optstring(L, index, "t");
  if (!std::strchr(mode, 't')) return false;
  lua_pushliteral(L, "t");
  lua_replace(L, index);
  return true;
}

/// Upvalues: the library's own load or loadfile, and where its mode stands.
int load_text(lua_State* L) {
  const lua_CFunction original = lua_tocfunction(L, lua_upvalueindex(1));
  const int mode = static_cast<int>(lua_tointeger(L, lua_upvalueindex(2)));
  if (force_text_mode(L, mode)) return original(L);
  lua_pushnil(L);
  lua_pushliteral(L, "binary chunks are not loaded (mode is 'b')");
  return 2;
}

int finish_dofile(lua_State* L, int, lua_KContext) { return lua_gettop(L) - 1; }

int dofile(lua_State* L) {
  const char* name = luaL_optstring(L, 1, nullptr);
  lua_settop(L, 1);
  if (luaL_loadfilex(L, name, "t") != LUA_OK) return lua_error(L);
  lua_callk(L, 0, LUA_MULTRET, 0, finish_dofile);
  return finish_dofile(L, LUA_OK, 0);
}

/// The searcher of `require` for Lua modules: package.path, text only. Upvalues: the table `package`, its function searchpath.
int search_module(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_pushstring(L, name);
  if (lua_getfield(L, lua_upvalueindex(1), "path") != LUA_TSTRING) return luaL_error(L, "'package.path' must be a string");
  lua_call(L, 2, 2);
  if (lua_isnil(L, -2)) return 1;  // why not, for require's own message
  const char* file = lua_tostring(L, -2);
  if (!may_read(file)) return luaL_error(L, "module '%s' lies outside of what may be read", name);
  if (luaL_loadfilex(L, file, "t") != LUA_OK)
    return luaL_error(L, "error loading module '%s' from file '%s':\n\t%s", name, file, lua_tostring(L, -1));
  lua_pushstring(L, file);
  return 2;
}

void replace_loader(lua_State* L, const char* name, int mode) {
  lua_getglobal(L, name);
  lua_pushinteger(L, mode);
  lua_pushcclosure(L, load_text, 2);
  lua_setglobal(L, name);
}

}  // namespace

namespace detail {

void accept_source_only(lua_State* L) {
  replace_loader(L, "load", 3);
  replace_loader(L, "loadfile", 2);
  lua_register(L, "dofile", dofile);

  lua_getglobal(L, "package");
  lua_getfield(L, -1, "searchers");
  lua_pushvalue(L, -2);
  lua_getfield(L, -3, "searchpath");
  lua_pushcclosure(L, search_module, 2);
  lua_rawseti(L, -2, 2);
  for (int native = 4; native > 2; --native) {
    lua_pushnil(L);
    lua_rawseti(L, -2, native);
  }
  lua_pop(L, 1);
  lua_pushliteral(L, "");
  lua_setfield(L, -2, "cpath");
  lua_pushnil(L);
  lua_setfield(L, -2, "loadlib");
  lua_pop(L, 1);
}

}  // namespace detail
}  // namespace tendril::lua
