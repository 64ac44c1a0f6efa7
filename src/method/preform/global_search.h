// Step 1 (thesis 3.2): a set of collision-free polylines through different regions of free space.
//
// Roadmap on a uniform grid with 26 neighbours. Repeatedly the shortest path; all nodes near it are then excluded, but not near
// the two ends, until no path is left.
#pragma once

#include <vector>

#include "method/preform/options.h"

namespace tendril::preform {

struct GlobalPaths {
  std::vector<std::vector<Vec3>> paths;  ///< from start to finish, m; the shortest first
  long nodes = 0, free_nodes = 0;
  /// Empty, or what keeps the ends apart: "start: 3.2 mm from 'bay', 20 required", "no passage of 36 mm ...".
  std::string obstruction;
};
GlobalPaths global_search(const FreeSpace& space, const Options& options, const RunContext& context = {});

}  // namespace tendril::preform
