#include "binding/clearance_value.h"

namespace tendril::lua {

ClearanceValue clearance_value(const SceneEquilibrium& eq, const SolvedRod& rod, const Clearance& clearance) {
  if (clearance.obstacle < 0) return {clearance, "", 0, false};
  const PlacedObstacle& obstacle = eq.obstacles[clearance.obstacle];
  const double radius = rod.problem.rod.section_at(clearance.s).radius();
  return {clearance, obstacle.name, obstacle.clearance, too_close(clearance.value, obstacle.clearance, radius)};
}

Schema clearance_options() {
  return {
      option<std::string>("from", "", "The rod; may be left out when there is only one"),
      option<std::string>("to", "", "The obstacle; default: the nearest of all"),
  };
}

ClearanceValue clearance_between(const SceneEquilibrium& eq, const Options& o) {
  if (!o.has("from") && eq.rods.size() != 1)
    throw UsageError("equilibrium:clearance: 'from' is missing: there are " + std::to_string(eq.rods.size()) + " rods");
  const SolvedRod& rod = o.has("from") ? eq.rod(o.get<std::string>("from")) : eq.rods.front();
  const int to = o.has("to") ? eq.obstacle(o.get<std::string>("to")) : -1;
  return clearance_value(eq, rod, eq.clearance(rod, to));
}

}  // namespace tendril::lua
