// Lua for tests: a state with everything of tendril in it.
#pragma once

#include <string>

#include "binding/lua_context.h"
#include "binding/open.h"

class Script {
 public:
  Script() : L(tendril::lua::open_state(context)) { tendril::lua::open_tendril(L); }
  ~Script() { lua_close(L); }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// What the code returns, each value as tostring gives it, separated by ", "; or the error's message.
  std::string operator()(const std::string& code) {
    lua_settop(L, 0);
    const bool good = luaL_loadbuffer(L, code.data(), code.size(), "=code") == LUA_OK && lua_pcall(L, 0, LUA_MULTRET, 0) == LUA_OK;
    std::string text;
    const int count = lua_gettop(L);
    for (int i = good ? 1 : count; i <= count; ++i) {
      text += (text.empty() ? "" : ", ") + std::string(luaL_tolstring(L, i, nullptr));
      lua_pop(L, 1);
    }
    return text;
  }

  tendril::lua::Context context;
  lua_State* L;
};
