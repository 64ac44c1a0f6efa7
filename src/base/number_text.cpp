#include "base/number_text.h"

#include <cstdio>

namespace tendril {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace tendril
