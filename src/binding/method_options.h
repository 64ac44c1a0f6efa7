// The options that every method takes from a script.
#pragma once

#include "binding/solve_options.h"

namespace tendril::lua {

/// seed, threads, timeout, progress.
Schema method_schema();

/// The shell's cancel flag, and what method_schema() describes. `progress` is called on the thread that runs Lua.
RunContext method_context(lua_State* L, const Options& o);

/// The state to call kept functions in: the coroutine that runs now. For functions that outlive the call that got them.
lua_State* running_state(lua_State* L);

}  // namespace tendril::lua
