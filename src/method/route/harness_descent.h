// All branches of a harness with its junctions' places and directions, together at the least cost.
//
// Unknowns are those of every branch (pcc_unknowns.h) and for each junction its place and the direction of the
// trunk; the other branches leave in any direction. The gradient is exact: what a branch's penalties and length do to its ends goes on to the
// junctions there.
#pragma once

#include "method/route/harness_shape.h"

namespace tendril::routing {

/// Starts from the shape's curves, as near to them as its junctions' directions allow. The result may miss what is demanded by what penalties leave; descents of its single branches
/// between ends that stay make up for that. Deterministic; stops early when `context` says so.
HarnessShape descend_together(const FreeSpace& space, const HarnessOptions& options, const HarnessShape& shape,
                              const RunContext& context = {});

}  // namespace tendril::routing
