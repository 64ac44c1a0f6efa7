// What a metre of an object costs at a place, by its distances to those obstacles that matter for that (SpaceDemands).
#pragma once

#include <memory>
#include <vector>

#include "base/run_context.h"
#include "geometry/distance_field.h"
#include "geometry/surroundings.h"
#include "method/free_space/space_demands.h"
#include "scene/scene.h"

namespace tendril::routing {

/// Immutable, safe from several threads. Shares the scene's meshes, trees and fields.
class PlaceCost {
 public:
  /// Whether places differ in what they cost: there is a weight, and an obstacle that it concerns.
  static bool differs(const Scene& scene, const SpaceDemands& demands);

  /// Takes fields from the scene's store, or has them made, `spacing` (m) between nodes for the nearest of all, twice that for
  /// single obstacles to keep near or away from; they cover `inner` and, where they must be made, `region` (m). Where `context`
  /// stops their making there are none.
  PlaceCost(const Scene& scene, const SpaceDemands& demands, const Eigen::AlignedBox3d& inner, const Eigen::AlignedBox3d& region,
            double spacing, const RunContext& context = {});

  /// Per metre, at least 1; `gradient` (1/m) may be null. 1 where p is not finite.
  double exact(const Vec3& p, Vec3* gradient = nullptr) const;
  /// The same by distances from the fields (DistanceField::interpolated), each off by up to 1.8 of its spacing: a search through
  /// tens of thousands of places is over before the trees would have answered. Exact for solids, small meshes, and where there is
  /// no field.
  double by_field(const Vec3& p) const;

  /// m, from the centre line: farther obstacles make no difference, but that those to keep near cost their whole weight.
  double reach() const { return demands_.preference_range + demands_.radius; }
  const SpaceDemands& demands() const { return demands_; }

 private:
  /// One term of the cost, by the distance of the centre line (m).
  double term(double distance, double weight, bool near) const;

  SpaceDemands demands_;
  Surroundings nearest_;         ///< those that cost by the nearest; empty where that has no weight
  Surroundings preferred_;       ///< those to keep near or away from; empty where that has no weight
  std::vector<bool> near_;       ///< by number in preferred_
  std::shared_ptr<const DistanceField> nearest_field_;                  ///< may be null
  std::vector<std::shared_ptr<const DistanceField>> preferred_fields_;  ///< by number in preferred_; each may be null
};

}  // namespace tendril::routing
