#include "shell/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>
#include <string_view>

namespace tendril::shell {

namespace {

/// As setlocale() would find it, which would also be asked for the locale's files.
bool has_utf8_locale() {
  for (const char* value : {std::getenv("LC_ALL"), std::getenv("LC_CTYPE"), std::getenv("LANG")}) {
    if (!value || !*value) continue;
    std::string name = value;
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.find("utf-8") != std::string::npos || name.find("utf8") != std::string::npos;
  }
  return false;
}

}  // namespace

Terminal look_at_terminal() {
  Terminal terminal;
  terminal.input = ::isatty(STDIN_FILENO);
  terminal.output = ::isatty(STDOUT_FILENO);
  terminal.messages = ::isatty(STDERR_FILENO);
  const char* type = std::getenv("TERM");
  terminal.dumb = !type || std::string_view(type).empty() || std::string_view(type) == "dumb";
  const char* plain = std::getenv("NO_COLOR");
  terminal.colour = terminal.messages && !terminal.dumb && !(plain && *plain);
  terminal.unicode = has_utf8_locale() && !(terminal.output && terminal.dumb);
  return terminal;
}

}  // namespace tendril::shell
