// What statics starts from when a rod is to lie along a given curve.
#pragma once

#include <optional>

#include "method/route/local_refinement.h"

namespace tendril::routing {

/// The rod along its design's route, twisted no more than its ends and turns ask for; of a preformed rod without a route its
/// shape from `from`, where that ends within a tenth of its length of `to`. Nothing: statics' own guess.
std::optional<Equilibrium> guess_along_route(const Design& design);

}  // namespace tendril::routing
