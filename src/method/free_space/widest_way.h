// The way along which the thickest object passes.
#pragma once

#include <vector>

#include "base/run_context.h"
#include "geometry/distance_transform.h"
#include "method/free_space/free_space.h"

namespace tendril::routing {

/// The way between places of a lattice whose smallest gap is the largest (a bottleneck shortest path with 26 neighbours). Gaps
/// above 0 count as 0, and no way leads through a surface, or through a ball that is closed.
struct WidestWay {
  std::vector<Vec3> places;      ///< from a source to a sink, m; empty where every way leads through a surface
  std::vector<double> gaps;      ///< m, by place; at most 0
  long reached = 0;              ///< nodes
  std::vector<long> in_the_way;  ///< by number of obstacle: edges that lead through its surface, and nodes on or in it
};
struct Ball {
  Vec3 middle;
  double radius;  ///< m
};
WidestWay widest_way(const FreeSpace& space, const NodeLattice& lattice, const std::vector<int>& sources, const std::vector<int>& sinks,
                     const std::vector<Ball>& closed = {}, const RunContext& context = {});

}  // namespace tendril::routing
