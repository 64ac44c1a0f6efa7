// Step 4 (thesis 3.2): infeasible curves are dropped, curves that are the same merged, the rest ranked and told apart by passage.
#pragma once

#include <string>
#include <vector>

#include "method/preform/passage_match.h"
#include "method/pcc/curve_distance.h"
#include "method/preform/pcc_optimization.h"

namespace tendril::preform {

using routing::curve_distance;

/// Indices of the feasible curves that stay, the best first: of curves nearer together than Options::same all along, the best.
/// Since curves are not yet at their optimum to the last digit, one with fewer bends stays beside it while it is nearly as good.
std::vector<int> distinct(const std::vector<Optimized>& curves, const Options& options);

/// Hoses, the best first, with passages counted from 1 in their order, clearances and labels. Of curves that are the same the
/// best stays, the one with fewer bends where both are equally good. When `context` stops, each hose that was not compared
/// counts as a passage of its own.
std::vector<Hose> pcc_filtering(const FreeSpace& space, const Options& options, const std::vector<Optimized>& curves,
                                const RunContext& context = {});

}  // namespace tendril::preform
