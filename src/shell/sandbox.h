// A stranger's script, held in.
#pragma once

#include <string>

struct lua_State;

namespace tendril::shell {

/// Closes the state and the program for a stranger's script: what Lua offers (binding/lua_sandbox.h), modules of the program alone,
/// files only below `folder` (base/file_access.h), which becomes the working folder. `folder` empty: that of `script`, or the
/// working folder without one. Gives the script's path as it is to be opened. Throws UsageError when `folder` is no folder.
std::string enter_sandbox(lua_State* L, std::string folder, const std::string& script);

}  // namespace tendril::shell
