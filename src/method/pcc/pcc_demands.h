// What a bent tube or hose must keep, besides its distance to the surroundings.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "method/pcc/pcc_curve.h"

namespace tendril::routing {

struct PccDemands {
  std::vector<double> radii;        ///< m, of the bending tools, rising; at least one. Every bend has one of them
  double min_straight = 0;          ///< m, between two bends
  double end_straight = 0;          ///< m, between an end and its nearest bend
  double min_length = 0, max_length = std::numeric_limits<double>::infinity();  ///< m
  double max_turn = 3.0;            ///< rad, of one bend
  double start_cone = 0, finish_cone = 0;  ///< rad, half angle within which the direction of an end may turn; pi: any direction
  /// Arc length (m) at either end within which obstacles need not be kept clear of: the object has to reach what it is plugged to.
  double free_ends = 0;
  bool free_start = true, free_finish = true;  ///< which ends that holds for
  double start_free() const { return free_start ? free_ends : 0; }    ///< m
  double finish_free() const { return free_finish ? free_ends : 0; }  ///< m
};

/// How far a curve is from keeping one of its demands.
struct Violation {
  /// crossing: the centre line passes through a surface within the free ends; by: m, the whole of what is demanded.
  enum class Kind { clearance, keep_in, keep_out, straight, end_straight, length, turn, cone, radius, crossing };
  Kind kind = Kind::clearance;
  double by = 0;              ///< m or rad, > 0
  double s = 0;               ///< m, where along the curve
  Vec3 at = Vec3::Zero();     ///< m
  int obstacle = -1;          ///< number in FreeSpace, of a clearance, zone, wall or crossing
};
/// "clearance", "keep_in", ... as the kinds above.
const char* name_of(Violation::Kind kind);

}  // namespace tendril::routing
