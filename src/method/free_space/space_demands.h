// What an object asks of its surroundings: what it keeps clear of, and where a metre of it costs more.
#pragma once

#include <optional>
#include <vector>

#include "base/vectors.h"

namespace tendril::routing {

/// What the object asks of its surroundings.
struct SpaceDemands {
  double radius = 0;     ///< m, of the object
  double clearance = 0;  ///< m, between the surfaces, for every obstacle; an obstacle's own larger one stands
  std::optional<Eigen::AlignedBox3d> keep_in;   ///< m: the whole object stays within; sides may be infinitely far
  std::vector<Eigen::AlignedBox3d> keep_out;    ///< m: no part of the object gets into; no clearance is kept there
  /// What a metre costs: 1 + clearance_weight * f(gap to the nearest obstacle that is not to be kept near)
  ///                        + preference * (sum over avoid of f(gap) + sum over near of max(0, 1 - f(gap))),
  /// f(gap) = max(0, 1 - gap / preference_range)^2, gaps between the surfaces (m; no clearance is taken off).
  double clearance_weight = 0;
  double preference = 0;
  double preference_range = 0.1;  ///< m
};

}  // namespace tendril::routing
