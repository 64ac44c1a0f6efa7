// What could stand at the cursor: globals, members of objects and modules, option names of a call, choices of an option.
#pragma once

#include <string>

#include "binding/lua_context.h"
#include "shell/line_reader.h"

namespace tendril::shell {

/// For the text up to the cursor. Runs no Lua code: members of a call's result are found by its declared type.
Completion complete(lua_State* L, const std::string& text);

}  // namespace tendril::shell
