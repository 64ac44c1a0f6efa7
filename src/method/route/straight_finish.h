// A preformed rod gets longer or shorter at its finish, where its shape is straight: its bends stay as they are.
#pragma once

#include "geometry/curve.h"
#include "rod/rod.h"

namespace tendril::routing {

/// m, of the straight that the curve ends with; 0 when it ends in a bend, or is neither a polyline nor one of constant curvatures.
double straight_finish(const Curve& curve);

/// Throws UsageError for a rod whose shape is not a curve that ends straight.
void check_straight_finish(const Rod& rod);

/// The curve with its last straight `by` (m) longer; a negative `by` must leave something of it.
Curve with_finish_moved(const Curve& curve, double by);

}  // namespace tendril::routing
