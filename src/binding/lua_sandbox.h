// What a stranger's script may use of Lua.
#pragma once

struct lua_State;

namespace tendril::lua {

/// Leaves of Lua's standard libraries what cannot reach beyond the script: no `io`, `debug`, `package`, `dofile`, `loadfile` and
/// `string.dump`; of `os` time, clock, date and difftime; of `collectgarbage` what tells and collects; the methods of strings are
/// read-only. `require` still finds the modules on `package.path` as it is now, where they may be read (base/file_access.h).
/// Call it once everything is open.
void restrict_to_sandbox(lua_State* L);

}  // namespace tendril::lua
