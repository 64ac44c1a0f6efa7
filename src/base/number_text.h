// Numbers in messages.
#pragma once

#include <string>

namespace tendril {

/// Up to six significant digits, no trailing zeros: 0.06, 1e-09, nan.
std::string number_text(double value);

}  // namespace tendril
