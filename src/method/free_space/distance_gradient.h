// How the distance to an obstacle changes with the place that it is measured from.
#pragma once

#include "geometry/surroundings.h"

namespace tendril::routing {

/// Of the distance (m, without clearance) to what was found on one of the surroundings' obstacles: unit, away from the surface;
/// inside a solid the shortest way out. Zero exactly on a mesh, where there is no such direction.
Vec3 distance_gradient(const Surroundings& surroundings, const Vec3& p, const ClosestPoint& found, double distance);

}  // namespace tendril::routing
