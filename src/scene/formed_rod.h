// Rods that have the shape of a curve without load.
#pragma once

#include <algorithm>
#include <vector>

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

/// A rod's shape that remembers the frames it runs through: between two neighbours it is a screw, of constant curvature and torsion.
struct FrameShape {
  std::vector<double> s;      ///< m, rising from 0
  std::vector<Frame> frames;  ///< as many
  Frame operator()(double arc_length) const;
};

/// Gives the rod the shape through frames at arc lengths from 0 to its length. Vertices come to lie at all of them, so that the shape
/// is met exactly whatever happens between them in the drawing: bends far sharper than an element is long do no harm. Throws UsageError
/// unless there are as many frames as arc lengths, which rise from 0 to the rod's length, and all are finite.
void form(Rod& rod, const FrameShape& shape);

/// The frames that a rod was formed through; null for others.
const FrameShape* frames_of(const Rod& rod);

/// A tube cannot be bent about an axis inside itself; a corner is the extreme of that. Throws UsageError "who: ..." where the
/// curve bends as sharply as the rod is thick.
void check_bends(const Rod& rod, const Curve& curve, const std::string& who);

}  // namespace tendril
