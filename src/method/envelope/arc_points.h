// The curved centre line between two vertices of a rod.
#pragma once

#include "base/vectors.h"

namespace tendril::envelope {

/// The centre line of an SE(3) element: the screw motion that takes one end's frame to the other's,
///   c(t) = a + t v + (1 - cos t w)/w^2 (omega x v) + (t w - sin t w)/w^3 (omega x (omega x v)),  w = |omega|,
/// a helix on which strains are constant (Sonneville, Cardona, Bruels, Comput. Methods Appl. Mech. Eng. 268 (2014)).
class ElementArc {
 public:
  /// `a`, `b`: position (m) and unit quaternion w, x, y, z, seven numbers each.
  ElementArc(const double* a, const double* b);

  Vec3 at(double share) const;  ///< 0 ... 1

  /// How far the centre line can be from `pieces` chords of equal share, m: |c''| / 8 of the worst piece, an upper bound.
  double sagitta(int pieces) const { return turned_speed_ / (8.0 * pieces * pieces); }

 private:
  Vec3 start_, velocity_, turned_, twice_turned_;
  double angle_, turned_speed_;
};

}  // namespace tendril::envelope
