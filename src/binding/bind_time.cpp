#include <chrono>

#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

Pushed time(lua_State* L, const Function& run) {
  const auto start = std::chrono::steady_clock::now();
  const int below = lua_gettop(L);
  run.push(L);
  lua_call(L, 0, LUA_MULTRET);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  lua_pushnumber(L, passed.count());
  lua_insert(L, below + 1);
  return {lua_gettop(L) - below};
}

}  // namespace

void bind_time(lua_State* L) {
  Module(L, "", "").function("time", {.takes = {"run"}, .returns = "number, any",
                                      .does = "Calls a function: the seconds it took, then what it returned.",
                                      .example = "local seconds, sum = time(function() return 1 + 1 end)\n"
                                                 "assert(seconds >= 0 and sum == 2)"},
                             time);
}

}  // namespace tendril::lua
