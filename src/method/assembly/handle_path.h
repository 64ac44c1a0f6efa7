// A way out for a ball at the handle, through free space to where the whole system has room (thesis 3.4, handle path planning).
#pragma once

#include <memory>
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
};

struct HandlePath {
  std::vector<Vec3> points;   ///< m, from the handle's routed place outwards, smoothed
  double clearance = 0;       ///< m: the largest ball that passes all along, measured exactly; from where it first has its radius
  double length = 0;          ///< m
};

/// The widest way out, for a ball that may be thinner than the rods.
struct WidestWay {
  double radius = 0;          ///< m, of the ball, once it has left the handle's own place; 0: no way of any width
  Vec3 narrow = Vec3::Zero();
  int obstacle = -1;          ///< nearest to the narrow place
};

/// Ways out, one after the other as they are asked for, the widest balls first. A* over a grid on the distance field, a metre costing
/// (1 + (4 radius / d)^2) at distance d, with least distances that rise from the radius on; shortened without losing clearance.
class HandlePaths {
 public:
  /// Throws UsageError for options that make no sense.
  HandlePaths(const routing::FreeSpace& space, const Vec3& from, const HandlePathOptions& options, const RunContext& context = {});
  ~HandlePaths();
  HandlePaths(const HandlePaths&) = delete;
  HandlePaths& operator=(const HandlePaths&) = delete;

  std::optional<HandlePath> next();

  const WidestWay& widest() const { return widest_; }
  /// Why there is no way for the rod's radius, and where.
  std::string why() const;

 private:
  class Grid;
  class Search;

  const routing::FreeSpace& space_;
  Vec3 from_;
  HandlePathOptions options_;
  RunContext context_;
  std::unique_ptr<Grid> grid_;  // null: no obstacles
  WidestWay widest_;
  std::size_t tried_ = 0;
  std::vector<HandlePath> found_;
};

}  // namespace tendril::assembly
