// A number by which a study is known again.
#pragma once

#include <string>

#include "method/variation/study.h"

namespace tendril::variation {

/// Sixteen hexadecimal digits that another scene, design or set of options does not have: of all that the outcomes depend on but
/// the seed, and functions.
std::string fingerprint(const Study& study);

}  // namespace tendril::variation
