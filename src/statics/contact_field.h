// What statics needs to know of the surroundings of a rod; geometry and scene fill it in.
#pragma once

#include <optional>
#include <vector>

#include "base/vectors.h"

namespace tendril {

/// One term of the contact energy at a point: weight * phi(distance). The weights of all terms in range make the
/// inclusion-exclusion sum over faces, edges and vertices of the surroundings.
struct DistanceTerm {
  double weight;    ///< +1 for a face, -(n-1) for an edge of n faces, ... ; solids have one term of weight +1
  double distance;  ///< m, minus the obstacle's offset; negative only inside a closed solid
  Vec3 normal;      ///< gradient of the distance: unit vector from the surface to the point
  Mat3 hessian;     ///< second derivative of the distance, 1/m; zero on a face
  int obstacle;     ///< which obstacle it belongs to
};

/// Where a straight path first meets a surface.
struct RayHit {
  double share;  ///< 0 ... 1 of the way
  Vec3 point;
  Vec3 normal;   ///< unit, facing the start of the ray
  int obstacle;
};

/// The closest surface point.
struct ClosestPoint {
  double distance;  ///< m; `limit` when nothing is nearer
  Vec3 point;
  int obstacle = -1;  ///< -1: nothing within the limit
};

/// The solid surroundings of a rod. All calls are const and safe from several threads.
class ContactField {
 public:
  virtual ~ContactField() = default;

  /// The closest surface point within `limit` (m) of `p`.
  virtual ClosestPoint closest(const Vec3& p, double limit) const = 0;

  /// Appends the distance terms of all primitives nearer than `range` (m) to `p`.
  virtual void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const = 0;

  /// First crossing of a surface on the way from `a` to `b`.
  virtual std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const = 0;
};

}  // namespace tendril
