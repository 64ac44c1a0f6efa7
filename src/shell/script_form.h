// A line of the session as it must stand in a script.
#pragma once

#include <string>

#include <lua.hpp>

namespace tendril::shell {

/// `code` ran as a chunk of its own and gave values that were shown, or none. In a script the same needs print(...) for the
/// values, a block for its locals, and a function where it returns.
std::string script_form(lua_State* L, const std::string& code, bool gave_values);

/// Whether a saved session leaves it out: queries of help, and calls of `session`.
bool is_about_session(const std::string& code);

}  // namespace tendril::shell
