// What statics starts from when a rod is to lie along a given curve.
#pragma once

#include <functional>
#include <optional>

#include "method/route/local_refinement.h"

namespace tendril::routing {

/// The frame of a rod's section at an arc length (m) of the rod.
using Way = std::function<Frame(double)>;

/// Where the rod is to lie: along its design's route, twisted no more than its ends and turns ask for; of a preformed rod without a route its
/// shape from `from`, where that ends within a tenth of its length of `to`. Nothing: it has no way of its own.
std::optional<Way> way_of(const Design& design);

/// The rod on its way. Nothing: statics' own guess.
std::optional<Equilibrium> guess_along_route(const Design& design);

}  // namespace tendril::routing
