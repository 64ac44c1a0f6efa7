// What the other side of the standard streams can do.
#pragma once

namespace tendril::shell {

struct Terminal {
  bool input = false;     ///< standard input is a terminal
  bool output = false;    ///< standard output is a terminal
  bool messages = false;  ///< standard error is a terminal
  bool dumb = false;      ///< TERM says it understands no escapes
  bool colour = false;    ///< colours are welcome on standard error
  bool unicode = false;   ///< the locale's characters are UTF-8

  bool can_edit() const { return input && output && !dumb; }
  bool can_progress() const { return messages && !dumb; }
};

Terminal look_at_terminal();

}  // namespace tendril::shell
