// Routing of a preformed hose (thesis 3.2, Paper B): a ranked set of clearly different hoses to choose from.
#pragma once

#include "method/preform/options.h"
#include "scene/scene.h"

namespace tendril::preform {

/// Throws UsageError for options that make no sense. A set that is empty is Status::infeasible, and says what stood in the way.
Result run(const Scene& scene, const Options& options, const RunContext& context = {});

}  // namespace tendril::preform
