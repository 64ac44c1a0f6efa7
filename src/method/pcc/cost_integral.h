// What a curve costs: the integral of FreeSpace::cost along it, by exact distances.
#pragma once

#include "method/free_space/free_space.h"
#include "method/pcc/pcc_curve.h"

namespace tendril::routing {

/// m: the length and what its surroundings add. Adaptive Simpson's rule over each straight and arc, good to 1e-4 of the result;
/// the length to rounding where nothing is preferred. Infinite where the curve has places that are not finite.
double cost_integral(const FreeSpace& space, const PccPoints& curve);

}  // namespace tendril::routing
