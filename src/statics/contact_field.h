// What statics needs to know of the surroundings of a rod; geometry and scene fill it in.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vectors.h"

namespace tendril {

/// One term of the contact energy at a point: weight * phi(distance). The weights of all terms in range make the
/// inclusion-exclusion sum over faces, edges and vertices of the surroundings.
struct DistanceTerm {
  double weight;    ///< +1 for a face, -(n-1) for an edge of n faces, ... ; solids have one term of weight +1
  double distance;  ///< m; negative inside a closed solid or a kept clearance
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
///
/// An obstacle may require a clearance. closest() and terms() measure from its surface all the same; closest_kept() and
/// terms_kept() from where it acts when the clearance is kept: every obstacle is thickened by its clearance, but by no
/// more than `most` (m). Points and rays are those of the surface itself.
class ContactField {
 public:
  virtual ~ContactField() = default;

  /// The closest surface point within `limit` (m) of `p`.
  virtual ClosestPoint closest(const Vec3& p, double limit) const = 0;

  /// Appends the distance terms of all primitives nearer than `range` (m) to `p`.
  virtual void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const = 0;

  /// First crossing of a surface on the way from `a` to `b`.
  virtual std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const = 0;

  /// The clearance that an obstacle requires (m).
  virtual double clearance(int /*obstacle*/) const { return 0; }
  virtual double largest_clearance() const { return 0; }
  virtual ClosestPoint closest_kept(const Vec3& p, double limit, double /*most*/) const { return closest(p, limit); }
  virtual void terms_kept(const Vec3& p, double range, double /*most*/, std::vector<DistanceTerm>& out) const {
    terms(p, range, out);
  }

  /// The same without some of its obstacles; the others keep their numbers. Throws UsageError for a number
  /// that there is not.
  virtual std::shared_ptr<const ContactField> without(const std::vector<int>& /*obstacles*/) const {
    throw UsageError("surroundings: these cannot leave out obstacles");
  }

  /// What messages call an obstacle.
  virtual std::string name(int /*obstacle*/) const { return "an obstacle"; }
};

}  // namespace tendril
