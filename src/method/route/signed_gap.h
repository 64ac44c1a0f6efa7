// Distances that know when they are on the wrong side: a mesh's distance has no sign of its own, but the way from a place that is
// known to be outside, through the surface, tells.
#pragma once

#include <memory>
#include <optional>

#include "geometry/surroundings.h"

namespace tendril::routing {

/// Immutable, safe from several threads.
class SignedGap {
 public:
  /// Null: nothing around.
  explicit SignedGap(std::shared_ptr<const Surroundings> field) : field_(std::move(field)) {}

  struct Value {
    double gap = 0;             ///< m, from the surface thickened by the obstacle's clearance; negative: too near or behind it
    Vec3 normal = Vec3::Zero(); ///< gradient of the gap, unit
    Vec3 on = Vec3::Zero();     ///< closest surface point
    int obstacle = -1;          ///< -1: nothing within the limit
  };
  /// At `p`; `outside` is a place in front of all surfaces, best a near one. A mesh that the straight from there passes an odd
  /// number of times is one that `p` lies behind: then the gap is the depth below the face where the straight first meets it.
  Value at(const Vec3& p, const Vec3& outside, double limit) const;

  const Surroundings* field() const { return field_.get(); }

 private:
  std::optional<RayHit> entry(const Vec3& p, const Vec3& outside) const;

  std::shared_ptr<const Surroundings> field_;
};

}  // namespace tendril::routing
