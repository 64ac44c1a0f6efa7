#include "method/assembly/supplementation.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

bool names_one(const std::vector<Grip>& grips, const std::string& name) {
  return std::any_of(grips.begin(), grips.end(), [&](const Grip& grip) { return grip.name == name; });
}

/// m: how far a grip is from its path at the worst time of a play.
double strayed(const InstalledSystem& system, const Manipulation& all, int grip, const Drive& moved) {
  double farthest = 0;
  for (const Passed& passed : moved.passed)
    farthest = std::max(farthest, (system.pose(passed.equilibrium, all.grips[grip]).at - all.pose(grip, passed.t).at).norm());
  return farthest;
}

struct Pressed {
  int rod = -1;
  double at = 0;
};

Pressed pressed_hardest(const SystemEquilibrium& state) {
  Pressed pressed;
  double most = 0;
  for (std::size_t k = 0; k < state.rods.size(); ++k)
    for (const ContactForce& contact : state.rods[k].contacts)
      if (contact.force.norm() > most) {
        most = contact.force.norm();
        pressed = {static_cast<int>(k), contact.s};
      }
  return pressed;
}

}  // namespace

Manipulation with_grips(const Manipulation& all, const std::vector<std::string>& names) {
  Manipulation some;
  some.times = all.times;
  for (std::size_t g = 0; g < all.grips.size(); ++g) {
    if (std::find(names.begin(), names.end(), all.grips[g].name) == names.end()) continue;
    some.grips.push_back(all.grips[g]);
    some.poses.push_back(all.poses[g]);
  }
  return some;
}

std::string supplementary_grip(const InstalledSystem& system, const Manipulation& all, const Manipulation& played, const Played& result) {
  // Connectors are gripped: where they go is prescribed, whatever else is.
  if (result.moved.end == Drive::End::collision) return {};
  std::string best;
  double farthest = system.radius;
  for (std::size_t g = 0; g < all.grips.size(); ++g) {
    if (names_one(played.grips, all.grips[g].name)) continue;
    const double way = strayed(system, all, static_cast<int>(g), result.moved);
    if (way <= farthest) continue;
    farthest = way;
    best = all.grips[g].name;
  }
  if (!best.empty() || result.moved.passed.empty()) return best;
  const Pressed pressed = pressed_hardest(result.moved.passed.back().equilibrium);
  double nearest = INFINITY;
  for (const Grip& grip : all.grips) {
    if (names_one(played.grips, grip.name) || grip.branch >= 0) continue;
    const double way = grip.rod == pressed.rod ? std::abs(grip.at - pressed.at) : 1e3;
    if (way >= nearest) continue;
    nearest = way;
    best = grip.name;
  }
  return best;
}

}  // namespace tendril::assembly
