// Where `require` looks.
#pragma once

#include <string>

namespace tendril::shell {

/// The folder of a script with a slash at the end: "studies/" of "studies/hose.lua", "./" of "hose.lua" and of "".
std::string folder_of(const std::string& script);

/// Lua's package.path: beside the script, then the folders of TENDRIL_LUA (when `with_environment`), then the lua/ folder
/// that came with the program.
std::string module_path(const std::string& script_folder, bool with_environment);

}  // namespace tendril::shell
