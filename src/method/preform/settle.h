// How far gravity moves a preformed hose: the method assumes that it hardly does (thesis 3.2), and here is how well that holds.
#pragma once

#include <memory>

#include "geometry/curve.h"
#include "rod/section.h"
#include "scene/scene.h"

namespace tendril::preform {

/// The design of a hose formed as `curve`, of one section. Throws UsageError where the section's radius is not below the smallest
/// bend radius.
Rod formed_rod(const Curve& curve, const Section& section, int segments);

struct Settled {
  std::shared_ptr<SceneEquilibrium> equilibrium;  ///< of one rod, "hose", with the scene's gravity and obstacles
  double moved = 0;  ///< m, the farthest that a point of the centre line moves from the curve
  double at = 0;     ///< m, arc length where
};

/// The hose held at both ends as it was formed, in static equilibrium under the scene's gravity, in contact with its obstacles
/// where it touches them. The scene's own rods do not take part.
Settled settle(const Scene& scene, const Curve& curve, const Section& section, int segments, const SolveOptions& options = {},
               const RunContext& context = {});

}  // namespace tendril::preform
