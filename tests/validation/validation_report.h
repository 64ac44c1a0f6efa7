// The committed report of errors against every reference.
#pragma once

#include <string>

namespace tendril::validation {

/// As Markdown; solves all of them anew.
std::string validation_report();

}  // namespace tendril::validation
