// The errors that each reference case must not exceed.
#pragma once

#include <vector>

#include "validation/reference.h"

namespace tendril::validation {

/// Bounds at `segments`: measured errors plus a quarter. Half the segments give the order of convergence.
struct ExpectedErrors {
  const char* name;
  int segments;
  Errors se3, staggered, thesis;
};

const std::vector<ExpectedErrors>& expected_errors();

}  // namespace tendril::validation
