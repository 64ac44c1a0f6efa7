// Whether the terminal shows pictures, from what it says of itself in the environment, else by asking it.
#pragma once

#include <optional>
#include <string>

#include "shell/terminal.h"
#include "view/inline_picture.h"

namespace tendril::shell {

/// What a terminal's answers say: attribute 4 of its primary device attributes (ESC [ ? 62 ; 4 c) are sixels, a report of its
/// cells' size is ESC [ 6 ; height ; width t. Nothing where neither is in the text.
struct PictureAnswer {
  bool complete = false;  ///< the attributes are in it: nothing more will come
  bool sixels = false;
  int cell_width = 0, cell_height = 0;  ///< pixels; 0: not said
};
PictureAnswer picture_answer(const std::string& text);

class PictureQuery {
 public:
  /// Asks the terminal at most once, and waits for half a second at most; looks at its size every time.
  PictureTerminal look(const Terminal& terminal);

 private:
  struct Found {
    PictureProtocol protocol = PictureProtocol::none;
    int cell_width = 0, cell_height = 0;
    std::string why;
  };
  static Found find(const Terminal& terminal);

  std::optional<Found> found_;
};

}  // namespace tendril::shell
