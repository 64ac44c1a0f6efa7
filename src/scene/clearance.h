// The smallest distance between a rod's surface and something solid.
#pragma once

#include <functional>
#include <string>

#include "rod/rod.h"
#include "statics/equilibrium.h"

namespace tendril {

/// The smallest gap between a rod and its surroundings, in m; negative where they penetrate each other. Infinite when
/// nothing is within the limit that was asked for.
struct Clearance {
  double value = 0;
  double s = 0;               ///< arc length of the place on the rod, m
  Vec3 at = Vec3::Zero();     ///< on the centre line, m
  Vec3 on = Vec3::Zero();     ///< closest point on the obstacle, m
  int obstacle = -1;          ///< -1: nothing within the limit
};

/// True when a gap (m) falls short of the required one. Where none is required rods may touch: only a penetration of
/// more than a hundredth of the rod's radius, well beyond what contact leaves, counts.
bool too_close(double gap, double required, double radius);

/// The closest surface point to `p`; signed inside a closed solid; obstacle -1: there is none.
using DistanceTo = std::function<ClosestPoint(const Vec3& p)>;

/// The smallest value of distance(centre line) - radius over the arc lengths `begin` ... `end` (m) of the rod, over the
/// true curved centre line and not only its vertices. The rod is divided until the distance, which changes by at most
/// the way travelled, cannot hide a smaller gap of more than a hundredth of a radius, and each remaining minimum is
/// then found to 1e-9 of the rod's length.
Clearance clearance_of(const Rod& rod, const Equilibrium& equilibrium, const DistanceTo& distance, double begin,
                       double end);

}  // namespace tendril
