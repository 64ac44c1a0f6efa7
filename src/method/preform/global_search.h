// Step 1 (thesis 3.2): a set of collision-free polylines through different regions of free space.
//
// Roadmap on a uniform grid with 26 neighbours. Repeatedly the shortest path; all nodes near it are then excluded, but not near
// the two ends, until no path is left that costs at most max_detour times the first one.
#pragma once

#include <string>
#include <vector>

#include "method/free_space/roadmap.h"
#include "method/preform/options.h"

namespace tendril::preform {

struct GlobalPaths {
  /// From start to finish, m; the cheapest first. The first and last edges are the straights at the ends.
  std::vector<std::vector<Vec3>> paths;
  long nodes = 0, free_nodes = 0;
  /// Empty, or what keeps the ends apart: "start: the hose is 3.2 mm too near to 'bay' ...", "no passage for a radius + clearance of
  /// 20 mm: the widest one found, at ...".
  std::string obstruction;
};

/// Throws UsageError for a grid with too many nodes (Roadmap). Stopped by `context`: the paths found so far, and no obstruction.
GlobalPaths global_search(const FreeSpace& space, const Options& options, const RunContext& context = {});
/// On a roadmap that is there, of the step Options::grid.
GlobalPaths global_search(const FreeSpace& space, const routing::Roadmap& roadmap, const Options& options, const RunContext& context = {});

}  // namespace tendril::preform
