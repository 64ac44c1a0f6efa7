// How the interactive session prints a result.
#pragma once

#include <lua.hpp>

namespace tendril::shell {

/// A Lua C function: prints its arguments as `print` does, except that a table without a text of its own is shown by its
/// first entries.
int show_values(lua_State* L);

}  // namespace tendril::shell
