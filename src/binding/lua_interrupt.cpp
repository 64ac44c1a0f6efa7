// Ctrl-C in Lua code. The signal handler arms a count hook on the coroutine that runs; the hook raises an error, stays
// armed so that no pcall loop swallows it, and is handed from a coroutine to the one that resumed it.
//
// The error is raised as Lua's memory error, the one that calls no message handler: a handler given to xpcall would run
// inside the hook, where no further hook can end it. Nobody sees its text: before the next instruction the hook strikes
// again, and at the end the shell tells `Context::struck_at`.
#include "binding/lua_context.h"

namespace tendril::lua {
namespace {

void strike(lua_State* L, lua_Debug*) {
  if (!interrupted(L)) {
    lua_sethook(L, nullptr, 0, 0);  // left over from an interrupt that has been dealt with
    return;
  }
  lua_sethook(L, strike, LUA_MASKCOUNT, 1);
  Context& c = context(L);
  if (c.struck_at.empty()) {
    luaL_where(L, 0);  // a hook is no level of the stack: 0 is the function it struck
    c.struck_at = lua_tostring(L, -1) + std::string("interrupted");
  }
  lua_pushliteral(L, "not enough memory");
  lua_error(L);
}

void arm(lua_State* L) { lua_sethook(L, strike, LUA_MASKCOUNT, 1); }

/// While it lives, `coroutine` is the running one; then `L` is again, and inherits a pending interrupt.
class Running {
 public:
  Running(lua_State* L, lua_State* coroutine) : L_(L) { context(L).running = coroutine ? coroutine : L; }
  ~Running() {
    context(L_).running = L_;
    if (interrupted(L_)) arm(L_);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  lua_State* L_;
};

/// Upvalue 1: the library's own coroutine.resume, which has no upvalues and can be called in place.
int resume(lua_State* L) {
  const lua_CFunction original = lua_tocfunction(L, lua_upvalueindex(1));
  const Running running(L, lua_tothread(L, 1));
  return original(L);
}

/// Upvalue 1: the coroutine, where the library's own function expects it; 2: that function.
int resume_wrapped(lua_State* L) {
  const lua_CFunction original = lua_tocfunction(L, lua_upvalueindex(2));
  const Running running(L, lua_tothread(L, lua_upvalueindex(1)));
  return original(L);
}

/// Upvalue 1: the library's own coroutine.wrap.
int wrap(lua_State* L) {
  const int results = lua_tocfunction(L, lua_upvalueindex(1))(L);
  lua_getupvalue(L, -1, 1);
  lua_pushcfunction(L, lua_tocfunction(L, -2));
  lua_pushcclosure(L, resume_wrapped, 2);
  return results;
}

void replace(lua_State* L, const char* name, lua_CFunction wrapper) {
  lua_getfield(L, -1, name);
  lua_pushcclosure(L, wrapper, 1);
  lua_setfield(L, -2, name);
}

}  // namespace

bool interrupted(lua_State* L) {
  const std::atomic<bool>* cancel = context(L).cancel;
  return cancel && cancel->load(std::memory_order_relaxed);
}

void interrupt(Context& context) noexcept {
  if (lua_State* L = context.running.load()) arm(L);
}

void rearm(lua_State* L) {
  lua_sethook(L, nullptr, 0, 0);
  Context& c = context(L);
  c.grace_given = false;
  c.struck_at.clear();
  c.running = L;
}

void give_grace(lua_State* L) {
  Context& c = context(L);
  if (!c.cancel_polled || c.grace_given || !interrupted(L)) return;
  constexpr int instructions = 12;
  c.grace_given = true;
  lua_sethook(L, strike, LUA_MASKCOUNT, instructions);
}

namespace detail {

void track_coroutines(lua_State* L) {
  lua_getglobal(L, "coroutine");
  replace(L, "resume", resume);
  replace(L, "wrap", wrap);
  lua_pop(L, 1);
}

}  // namespace detail
}  // namespace tendril::lua
