// Step 2 (thesis 3.2): from each path the best polylines with few, evenly spaced vertices, by shortcuts between its vertices.
#pragma once

#include <vector>

#include "method/preform/global_search.h"

namespace tendril::preform {

/// A candidate and where it comes from.
struct Candidate {
  PccPoints points;
  int path = 0;  ///< number of the path; -1: from the ends alone
};
/// First the straight, a single bend, and the optima of open space (end_seeds.h); then for each path and each number of bends
/// up to Options::max_bends the polyline with the smallest
///   sum over edges: |e| + 2 (|e| - mean)^2 / mean + 3 (length that the distance field takes for blocked)
/// by dynamic programming over the path's vertices, with the first and last vertex on the ends' directions. Every bend has the
/// smallest radius. Without repetitions.
std::vector<Candidate> pcc_sampling(const FreeSpace& space, const Options& options, const GlobalPaths& paths,
                                    const RunContext& context = {});

}  // namespace tendril::preform
