// Closest points on one segment and one triangle, in double precision, sound for slivers and degenerate triangles.
#pragma once

#include <algorithm>
#include <array>

#include "base/vectors.h"

namespace tendril {

/// The closest point of a segment a-b. end: 0 or 1 when it is a or b, -1 when it lies between.
struct SegmentFoot {
  Vec3 point;
  double squared;  ///< distance squared, m^2
  int end;
};

inline SegmentFoot closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, from_a = p - a;
  const double share = along.dot(from_a), whole = along.squaredNorm();
  if (!(share > 0)) return {a, from_a.squaredNorm(), 0};
  if (share >= whole) return {b, (p - b).squaredNorm(), 1};
  const Vec3 point = a + (share / whole) * along;
  return {point, (p - point).squaredNorm(), -1};
}

/// The closest point of a triangle and of each of its sides (side k: corner k to corner k + 1). inside: the foot of the
/// perpendicular lies within the face; else the closest point is that of side `side`.
struct TriangleFoot {
  SegmentFoot sides[3];
  Vec3 point;
  double squared;
  bool inside;
  int side;
};

inline TriangleFoot closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  TriangleFoot foot{{closest_on_segment(p, a, b), closest_on_segment(p, b, c), closest_on_segment(p, c, a)}, {}, 0, false, 0};
  for (int k = 1; k < 3; ++k)
    if (foot.sides[k].squared < foot.sides[foot.side].squared) foot.side = k;
  foot.point = foot.sides[foot.side].point;
  foot.squared = foot.sides[foot.side].squared;

  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Vec3 normal = ab.cross(ac);
  const double nn = normal.squaredNorm(), longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  if (!(nn > 1e-24 * longest * longest)) return foot;  // no face to speak of: its sides say all
  const Vec3 q = ap.cross(normal);
  const double u = -ac.dot(q), v = ab.dot(q);
  if (!(u > 0 && v > 0 && u + v < nn)) return foot;
  const double height = normal.dot(ap);
  const double squared = height * height / nn;
  if (!(squared <= foot.squared)) return foot;
  foot.inside = true;
  foot.squared = squared;
  foot.point = p - normal * (height / nn);
  return foot;
}

}  // namespace tendril
