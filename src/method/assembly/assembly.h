// Assembly verification (thesis 3.4, Paper D): is there a manipulation that installs a system of rods?
#pragma once

#include "method/assembly/options.h"

namespace tendril::assembly {

/// constraint_relaxation, handle_path_planning, path_smoothing, grip_point_supplementation. Throws UsageError for names that are
/// unknown, rods that do not hang together, connectors that make no sense.
Result run(const Scene& scene, const Options& options, const RunContext& context = {});

}  // namespace tendril::assembly
