// Routing of a flexible object (thesis 3.1, Paper A): a reference design of least cost that keeps bend radius and clearance in
// static equilibrium under gravity.
#pragma once

#include "method/route/options.h"
#include "scene/scene.h"

namespace tendril::route {

/// Throws UsageError for options that make no sense.
Result run(const Scene& scene, const Options& options, const RunContext& context = {});

}  // namespace tendril::route
