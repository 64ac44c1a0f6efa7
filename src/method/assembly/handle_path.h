// A way out for a ball at the handle, through free space to where the whole system has room (thesis 3.4, handle path planning).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/free_space/free_space.h"

namespace tendril::assembly {

struct HandlePathOptions {
  double radius = 0;      ///< m, of the thickest rod: no ball is smaller
  double arm = 0;         ///< m, the longest way along the system from the handle to an end: so far out it ends
  double grid = 0;        ///< m; 0: chosen from the scene's size
  /// Where it must end, m; nothing: anywhere with room for the arm.
  std::optional<Vec3> exit;
  int most_paths = 4;
};

struct HandlePath {
  std::vector<Vec3> points;   ///< m, from the handle's routed place outwards, smoothed
  double clearance = 0;       ///< m: the largest ball that passes all along, measured exactly; from where it first has its radius
  double length = 0;          ///< m
};

struct HandlePaths {
  std::vector<HandlePath> paths;  ///< the most promising first
  /// Where there is none: the widest ball that gets out at all, where it sticks and between what.
  double widest = 0;
  Vec3 narrow = Vec3::Zero();
  std::string why;
};

/// A* over a grid on the distance field, a metre costing (1 + (4 radius / d)^2) at distance d, with least distances that rise
/// from the radius on; smoothed without losing clearance. Throws UsageError for options that make no sense.
HandlePaths handle_paths(const routing::FreeSpace& space, const Vec3& from, const HandlePathOptions& options, const RunContext& context = {});

}  // namespace tendril::assembly
