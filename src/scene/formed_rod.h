// Rods that have the shape of a curve without load.
#pragma once

#include <algorithm>

#include "geometry/curve.h"
#include "rod/rod.h"

namespace tendril {

/// A rod's shape that remembers the curve it came from.
struct CurveShape {
  Curve curve;
  Frame operator()(double s) const { return curve.at(std::clamp(s, 0.0, curve.length())); }
};

/// Gives the rod the curve's shape and length; its parts stay as they are.
void form(Rod& rod, const Curve& curve);

/// The curve that a rod was formed as; null for a straight one and one with another shape.
const Curve* curve_of(const Rod& rod);

/// A tube cannot be bent about an axis inside itself; a corner is the extreme of that. Throws UsageError "who: ..." where the
/// curve bends as sharply as the rod is thick.
void check_bends(const Rod& rod, const Curve& curve, const std::string& who);

}  // namespace tendril
