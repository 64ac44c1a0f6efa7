// Pictures in the terminal, for what can be drawn and for files that were drawn.
#pragma once

#include <functional>
#include <string>

#include "binding/lua_value.h"
#include "view/inline_picture.h"

namespace tendril::lua {

/// A picture that was shown in the terminal, or why not.
struct ShownPicture {
  Status status = Status::solved;
  std::string message;   ///< "shown", or why not and what to do instead
  std::string by;        ///< the protocol, "" when it was not shown
  double seconds = 0;
};

template <> inline constexpr const char* class_name<ShownPicture> = "shown_picture";

/// Asks the terminal what it can show; where it can, `draw` gives a PNG made for it (empty: stopped, with the status), which is
/// written to standard output. `instead`: what the user may do where it cannot.
ShownPicture show_picture(lua_State* L, const char* instead,
                          const std::function<std::string(const PictureTerminal& terminal, Status& status)>& draw);

}  // namespace tendril::lua
