// A settled centre line as the few cubics that a harness file can hold.
#pragma once

#include <vector>

#include "harness/harness_spline.h"
#include "statics/equilibrium.h"

namespace tendril {

/// Cubic B-splines of one span each, one after the other along the rod, that stay within `tolerance` (m) of its centre line:
/// each reaches over as many of the rod's elements as it can.
std::vector<HarnessCurve> settled_curves(const Equilibrium& rod, KnotReading reading, double tolerance);

}  // namespace tendril
