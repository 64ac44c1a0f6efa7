#include "method/preform/settle.h"

#include <algorithm>

#include "scene/formed_rod.h"

namespace tendril::preform {

Rod formed_rod(const Curve& curve, const Section& section, int segments) {
  Rod rod = Rod::uniform(curve.length(), section, segments);
  form(rod, curve);
  rod.check();
  check_bends(rod, curve, "hose");
  return rod;
}

Settled settle(const Scene& scene, const Curve& curve, const Section& section, int segments, const SolveOptions& options,
               const RunContext& context) {
  Scene alone(scene.gravity());
  for (const PlacedObstacle& obstacle : scene.bodies()) alone.add(obstacle);
  alone.add(PlacedRod("hose", formed_rod(curve, section, segments), curve.at(0), curve.at(curve.length())));
  Settled settled{std::make_shared<SceneEquilibrium>(alone.solve(options, context))};
  const Equilibrium& eq = settled.equilibrium->rods.front().equilibrium;
  for (std::size_t i = 0; i < eq.points.size(); ++i) {
    const double moved = (eq.points[i] - curve.at(std::min(eq.s[i], curve.length())).at).norm();
    if (moved > settled.moved) settled = {settled.equilibrium, moved, eq.s[i]};
  }
  return settled;
}

}  // namespace tendril::preform
