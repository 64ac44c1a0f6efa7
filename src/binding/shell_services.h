// What the shell around a Lua state offers to bound functions. A state without a shell (a test's) has none of it.
#pragma once

#include <functional>

#include <lua.hpp>

#include "view/inline_picture.h"

namespace tendril::lua {

struct Transcript;

struct ShellServices {
  std::function<PictureTerminal()> picture_terminal;  ///< asks what the terminal can show
  Transcript* transcript = nullptr;  ///< of the interactive session; null in a script
  bool unicode = false;              ///< what prints may have characters beyond ASCII
};

/// `services` must outlive the state.
void provide(lua_State* L, const ShellServices& services);

/// What was provided, or services of which there are none.
const ShellServices& shell_services(lua_State* L);

}  // namespace tendril::lua
