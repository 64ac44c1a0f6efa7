#include "method/dress_pack/triangle_pair.h"

#include <algorithm>
#include <limits>

#include "geometry/closest_point.h"

namespace tendril::dress_pack {
namespace {

/// The closest points of two segments (Ericson: Real-Time Collision Detection, 2005, section 5.1.9).
TrianglePair closest_of_segments(const Vec3& p, const Vec3& p_end, const Vec3& q, const Vec3& q_end) {
  const Vec3 d = p_end - p, e = q_end - q, r = p - q;
  const double a = d.squaredNorm(), c = e.squaredNorm(), f = e.dot(r);
  double s = 0, t = 0;
  if (a > 0 && c > 0) {
    const double b = d.dot(e), g = d.dot(r), denominator = a * c - b * b;
    if (denominator > 1e-14 * a * c) s = std::clamp((b * f - g * c) / denominator, 0.0, 1.0);
    t = (b * s + f) / c;
    if (t < 0) t = 0, s = std::clamp(-g / a, 0.0, 1.0);
    else if (t > 1) t = 1, s = std::clamp((b - g) / a, 0.0, 1.0);
  } else if (a > 0) {
    s = std::clamp(-d.dot(r) / a, 0.0, 1.0);
  } else if (c > 0) {
    t = std::clamp(f / c, 0.0, 1.0);
  }
  const Vec3 on_p = p + s * d, on_q = q + t * e;
  return {(on_p - on_q).norm(), on_p, on_q};
}

/// Where a side of one triangle passes through the face of the other.
bool pierces(const Vec3& from, const Vec3& to, const Vec3 (&face)[3], Vec3& at) {
  const Vec3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
  const double before = normal.dot(from - face[0]), after = normal.dot(to - face[0]);
  if (before == after || (before > 0) == (after > 0)) return false;
  at = from + before / (before - after) * (to - from);
  for (int k = 0; k < 3; ++k)
    if (normal.dot((face[(k + 1) % 3] - face[k]).cross(at - face[k])) < 0) return false;
  return true;
}

}  // namespace

TrianglePair closest_of_triangles(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
  TrianglePair best{std::numeric_limits<double>::infinity(), Vec3::Zero(), Vec3::Zero()};
  Vec3 at;
  for (int k = 0; k < 3; ++k)
    if (pierces(a[k], a[(k + 1) % 3], b, at) || pierces(b[k], b[(k + 1) % 3], a, at)) return {0, at, at};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const TrianglePair pair = closest_of_segments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
      if (pair.distance < best.distance) best = pair;
    }
  for (int k = 0; k < 3; ++k) {
    const TriangleFoot on_b = closest_on_triangle(a[k], b[0], b[1], b[2]), on_a = closest_on_triangle(b[k], a[0], a[1], a[2]);
    if (on_b.squared < best.distance * best.distance) best = {std::sqrt(on_b.squared), a[k], on_b.point};
    if (on_a.squared < best.distance * best.distance) best = {std::sqrt(on_a.squared), on_a.point, b[k]};
  }
  return best;
}

}  // namespace tendril::dress_pack
