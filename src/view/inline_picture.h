// Pictures between the lines of a terminal.
#pragma once

#include <string>

namespace tendril {

/// How a terminal takes pictures.
///   kitty  APC G: kitty, Ghostty, Konsole        https://sw.kovidgoyal.net/kitty/graphics-protocol
///   iterm  OSC 1337 File: iTerm2, WezTerm, mintty  https://iterm2.com/documentation-images.html
///   sixel  DCS q: xterm, foot, mlterm and others (DEC's STD 070)
enum class PictureProtocol { none, kitty, iterm, sixel };

const char* name_of(PictureProtocol protocol);  ///< "kitty's protocol"

struct PictureTerminal {
  PictureProtocol protocol = PictureProtocol::none;
  int columns = 80, rows = 24;   ///< characters
  int cell_width = 10, cell_height = 20;  ///< pixels
  std::string why;               ///< there is none

  /// The largest picture of this shape that fits above a prompt, at most `most` pixels wide: {width, height}.
  struct Size {
    int width, height;
  };
  Size fitting(double width_over_height, int most = 1600) const;
};

/// The bytes that show a PNG, with a newline at the end. Larger ones are shown smaller. Throws UsageError for what is no
/// PNG, for a terminal without a protocol, and for sixels when the drawing module cannot be loaded.
std::string inline_picture(const std::string& png, const PictureTerminal& terminal);

}  // namespace tendril
