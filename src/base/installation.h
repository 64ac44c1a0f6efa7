// Where the files that belong to the program lie: beside it in a build, below lib and share once it is installed.
#pragma once

#include <string>

namespace tendril {

/// The folder of the running program, links followed, without a slash at the end; "" when the system does not say.
std::string program_folder();

/// What comes with the program in folders of their own.
///   modules  PROGRAM/modules or PROGRAM/../lib/tendril; TENDRIL_MODULES names another
///   assets   PROGRAM/assets or PROGRAM/../share/tendril/assets; TENDRIL_ASSETS names another
///   lua      PROGRAM/lua or PROGRAM/../share/tendril/lua
enum class Part { modules, assets, lua };

/// The folder that the environment names, whether it exists or not, else the first of the two that does; "" for neither.
std::string part_folder(Part part);

/// Where part_folder() looks for `file`, for a message: "'a/file' or 'b/file'".
std::string part_places(Part part, const std::string& file);

}  // namespace tendril
