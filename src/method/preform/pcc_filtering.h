// Step 4 (thesis 3.2): infeasible curves are dropped, curves that are the same merged, the rest ranked by passage and objective
// and told apart.
#pragma once

#include <string>
#include <vector>

#include "method/preform/pcc_optimization.h"

namespace tendril::preform {

/// The largest distance between points at equal shares of the arc length, m; 48 of them.
double curve_distance(const PccPoints& a, const PccPoints& b);

/// Whether one curve can be moved into the other through free space along straight rungs: a monotone matching of both whose
/// rungs are free. A yes is certain; a no means that no such matching was found. `blocking`: numbers of the obstacles that stand
/// between them then.
bool same_passage(const FreeSpace& space, const PccPoints& a, const PccPoints& b, std::vector<int>* blocking = nullptr);

/// Indices of the feasible curves that stay, the best first.
std::vector<int> distinct(const std::vector<Optimized>& curves, const Options& options);

/// With passages, clearances and labels.
std::vector<Hose> pcc_filtering(const FreeSpace& space, const Options& options, const std::vector<Optimized>& curves,
                                const RunContext& context = {});

}  // namespace tendril::preform
