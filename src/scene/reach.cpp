#include "scene/reach.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double stretch = 1.2;  // far more than a rod that keeps its linear law

/// From a place in world axes, m; 0 inside.
double distance_to(const PlacedObstacle& obstacle, const Vec3& at) {
  const Vec3 local = (obstacle.body.pose.inverse() * Frame{at, Quat::Identity()}).at;
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape))
    return std::sqrt((*surface)->box().squaredExteriorDistance(local));
  return std::max(0.0, tendril::distance_to(std::get<Solid>(obstacle.body.shape), local).distance);
}

}  // namespace

bool can_reach(const PlacedRod& rod, const PlacedObstacle& obstacle) {
  const double reach = stretch * rod.rod().length + rod.rod().largest_radius() + obstacle.clearance;
  double both = 0;
  for (const Hold& hold : rod.holds()) {
    if (!hold.position) continue;
    const double distance = distance_to(obstacle, hold.frame.at);
    if (distance > reach) return false;
    const bool at_end = hold.at == 0 || hold.at == rod.rod().length;
    if (at_end) both += distance;
  }
  const bool held_at_both = rod.hold_at(0) && rod.hold_at(rod.rod().length);
  return !held_at_both || both <= reach;
}

}  // namespace tendril
