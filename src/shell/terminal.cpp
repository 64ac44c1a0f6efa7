#include "shell/terminal.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace tendril::shell {

Terminal look_at_terminal() {
  Terminal terminal;
  terminal.input = ::isatty(STDIN_FILENO);
  terminal.output = ::isatty(STDOUT_FILENO);
  terminal.messages = ::isatty(STDERR_FILENO);
  const char* type = std::getenv("TERM");
  terminal.dumb = !type || std::string_view(type).empty() || std::string_view(type) == "dumb";
  const char* plain = std::getenv("NO_COLOR");
  terminal.colour = terminal.messages && !terminal.dumb && !(plain && *plain);
  return terminal;
}

}  // namespace tendril::shell
