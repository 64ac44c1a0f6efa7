// Scene files of older versions.
#pragma once

#include <string>

#include "harness/json.h"

namespace tendril {

/// Brings the content of a scene file to the version of today, one version after the other. Throws UsageError, opening with `who`,
/// for what is no scene file and for a version that is newer. What else is wrong is left for the reader to tell.
void bring_up_to_date(Json& file, const std::string& who);

}  // namespace tendril
