// Where a rod that runs along a way might be fastened.
#pragma once

#include <functional>
#include <vector>

#include "geometry/surroundings.h"
#include "scene/placed_obstacle.h"
#include "statics/problem.h"

namespace tendril::routing {

/// What clips may be fastened to, and how near it must be.
struct ClipSites {
  const Surroundings* around = nullptr;       ///< thickened by the clearances that are demanded; null: nothing
  const std::vector<PlacedObstacle>* obstacles = nullptr;  ///< numbered as in `around`; those with `clip` take clips
  double reach = 0.05;                        ///< m, from the rod's surface

  /// Whether a section of this radius (m) may be clipped here: clear of everything by what that demands, within reach of something.
  bool take(const Vec3& at, double radius) const;
};

/// Places in order, `spacing` (m) or a little less apart, along a way of this length (m), at least `ends` from its ends; each a full
/// hold in the way's frame. Left out: those where nothing is in reach.
std::vector<Hold> clip_places(const std::function<Frame(double)>& way, double length, double radius, double spacing, double ends,
                              const ClipSites& sites);

/// How far from other holds a clip must stay for it to make sense, m.
double room_at_holds(double length, double radius);

}  // namespace tendril::routing
