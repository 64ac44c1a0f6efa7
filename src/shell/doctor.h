// tendril doctor: what the program finds on this machine, and what is missing.
#pragma once

#include <string>
#include <vector>

#include "shell/terminal.h"

namespace tendril::shell {

/// One thing that was looked at. `broken`: something that the program needs is missing or does not work.
struct Finding {
  std::string group, name, value;
  bool broken = false;
};

/// Looks at everything: loads every module, makes an OpenGL context, starts gnuplot. Takes about a second; throws nothing.
std::vector<Finding> examine(const Terminal& terminal);

/// One line a finding under its group's name, a cross before what is broken, and a verdict at the end.
std::string report_text(const std::vector<Finding>& findings);

}  // namespace tendril::shell
