// Step 2 (thesis 3.2): from each path the best polylines with few, evenly spaced vertices, by shortcuts between its vertices.
#pragma once

#include <vector>

#include "method/preform/global_search.h"

namespace tendril::preform {

/// A candidate and where it comes from.
struct Candidate {
  PccPoints points;
  int path = 0;
};
/// For each path and each number of bends up to Options::max_bends, by dynamic programming over the path's vertices; and seeds
/// from the ends' directions alone that turn as Dubins' words do. Without repetitions.
std::vector<Candidate> pcc_sampling(const FreeSpace& space, const Options& options, const GlobalPaths& paths,
                                    const RunContext& context = {});

}  // namespace tendril::preform
