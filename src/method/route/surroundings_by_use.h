// The obstacles of a scene, sorted by what they mean to a design that is refined.
#pragma once

#include <memory>
#include <vector>

#include "method/route/local_refinement.h"
#include "method/route/signed_gap.h"

namespace tendril::routing {

struct SurroundingsByUse {
  /// Numbers are those of the scene.
  SurroundingsByUse(const Scene& scene, const RefinementOptions& options);

  std::vector<PlacedObstacle> obstacles;            ///< with the clearances demanded
  std::shared_ptr<const Surroundings> all;          ///< thickened by them; null without obstacles
  /// Those that the rod may touch, by contact; null: none. The others are kept clear of, so they exert no force on a design that
  /// keeps what is demanded.
  std::shared_ptr<const Surroundings> touchable;

  /// Obstacles that cost something, without clearances: the nearest of those that are not to be kept near; each that is to be
  /// avoided; each that is to be kept near.
  SignedGap nearest;
  std::vector<SignedGap> avoided, kept_near;
  bool has_costs = false;

  SignedGap demanded;                               ///< those with a clearance
  std::vector<int> demanded_numbers;                ///< of the scene
};

}  // namespace tendril::routing
