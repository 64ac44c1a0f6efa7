// The branches of a harness as straights and arcs, each between ends that stay, and all of them together.
#pragma once

#include "method/pcc/pcc_check.h"
#include "method/route/harness_shape.h"

namespace tendril::routing {

/// By branch what it violates, worst first.
using ShapeViolations = std::vector<std::vector<Violation>>;

/// Fills the branches' curves, each to the local optimum between its ends as they are.
ShapeViolations smooth(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, const RunContext& context = {});

/// Moves junctions and branches together, then each branch again; the shape stays as it was where that is no better.
void improve(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, ShapeViolations& violations,
             const RunContext& context = {});

/// Integral of FreeSpace::cost - 1 along a curve, m.
double preference_along(const FreeSpace& space, const PccPoints& curve);

}  // namespace tendril::routing
