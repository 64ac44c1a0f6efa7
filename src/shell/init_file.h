// What a user wants in every interactive session.
#pragma once

#include <string>

#include "shell/session.h"

namespace tendril::shell {

/// $XDG_CONFIG_HOME/tendril/init.lua or ~/.config/tendril/init.lua; "" without a home.
std::string init_path();

/// Runs the file where there is one. An error in it is told; the session goes on. True when it ran to its end.
bool run_init_file(Session& session, const std::string& path);

}  // namespace tendril::shell
