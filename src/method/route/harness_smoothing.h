// The branches of a harness as straights and arcs, each between ends that stay, and all of them together.
#pragma once

#include "method/pcc/pcc_check.h"
#include "method/route/harness_shape.h"

namespace tendril::routing {

/// By branch what it violates, worst first.
using ShapeViolations = std::vector<std::vector<Violation>>;

/// Fills the branches' curves, each to the local optimum between its ends as they are, where its direction at a junction may turn
/// by `cone` (rad). 0: trunks are chosen and keep their directions.
ShapeViolations smooth(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, double cone,
                       const RunContext& context = {});

/// Moves junctions and branches together from the curves there are, then each branch again between ends that stay.
ShapeViolations improve(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, const RunContext& context = {});

/// The number of branches that miss something, and a share for how much.
double misses(const ShapeViolations& violations);

/// m: by branches' factors, with preferences.
double weighted_cost(const FreeSpace& space, const HarnessShape& shape);

/// Integral of FreeSpace::cost - 1 along a curve, m.
double preference_along(const FreeSpace& space, const PccPoints& curve);

}  // namespace tendril::routing
