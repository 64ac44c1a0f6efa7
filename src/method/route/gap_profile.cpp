#include "method/route/gap_profile.h"

#include <algorithm>
#include <cmath>

namespace tendril::routing {

std::vector<std::pair<double, double>> judged_stretches(const RodProblem& problem, const RefinementOptions& options) {
  std::vector<std::pair<double, double>> stretches;
  const int last = static_cast<int>(problem.holds.size()) - 1;
  double begin = options.free_ends;
  for (int k = 1; k <= last; ++k) {
    const double free = k == last ? options.free_ends : options.free_clips;
    const double end = problem.holds[k].at - free;
    if (end > begin) stretches.push_back({begin, end});
    begin = std::max(begin, problem.holds[k].at + free);
  }
  return stretches;
}

Room GapProfile::at(const Rod& rod, const Equilibrium& equilibrium, double s) const {
  const double outside = s / rod.length * outside_->s.back();
  const double radius = rod.section_at(s).radius();
  const SignedGap::Value value =
      field_->at(equilibrium.frame_at(s).at, outside_->frame_at(outside).at, limit_ + radius);
  return {s, value.gap - radius, value.normal, value.on, value.obstacle};
}

/// Golden-section search: the room has kinks where the closest triangle changes.
Room GapProfile::lowest_between(const Rod& rod, const Equilibrium& equilibrium, double a, double b) const {
  constexpr double golden = 0.6180339887498949, tolerance = 1e-5;
  Room left = at(rod, equilibrium, b - golden * (b - a)), right = at(rod, equilibrium, a + golden * (b - a));
  while (b - a > tolerance) {
    if (left.value < right.value) {
      b = right.s;
      right = left;
      left = at(rod, equilibrium, b - golden * (b - a));
    } else {
      a = left.s;
      left = right;
      right = at(rod, equilibrium, a + golden * (b - a));
    }
  }
  return left.value < right.value ? left : right;
}

std::vector<Room> GapProfile::along(const Rod& rod, const Equilibrium& equilibrium,
                                    const std::vector<std::pair<double, double>>& stretches) const {
  std::vector<Room> all;
  if (!field_->field() || field_->field()->size() == 0) return all;
  for (const auto& [begin, end] : stretches) {
    const int pieces = std::clamp(static_cast<int>(std::ceil((end - begin) / (2 * rod.largest_radius()))), 1, 2000);
    const double step = (end - begin) / pieces;
    std::vector<Room> here;
    for (int i = 0; i <= pieces; ++i) here.push_back(at(rod, equilibrium, begin + i * step));
    for (int i = 0; i <= pieces; ++i) {
      const bool below_last = i == 0 || here[i].value <= here[i - 1].value;
      const bool below_next = i == pieces || here[i].value < here[i + 1].value;
      here[i].lowest = here[i].obstacle >= 0 && below_last && below_next;
      // Farther off than this, nothing between the neighbours can be too near: the room changes by at most the way.
      if (!here[i].lowest || i == 0 || i == pieces || here[i].value > 2 * step) {
        all.push_back(here[i]);
        continue;
      }
      Room between = lowest_between(rod, equilibrium, here[i - 1].s, here[i + 1].s);
      if (!(between.value < here[i].value)) between = here[i];
      between.lowest = true;
      all.push_back(between);
    }
  }
  return all;
}

}  // namespace tendril::routing
