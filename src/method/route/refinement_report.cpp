#include "method/route/refinement_report.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/route/gap_profile.h"

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string mm(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", length / units::mm);
  return text;
}

std::string place(double s, double length) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f m", s);
  return s <= 1e-9 * length ? "the start" : s >= length * (1 - 1e-9) ? "the finish" : text;
}

/// The smallest gap to an obstacle (-1: any) over the stretches where one is demanded; the whole rod where there is none.
Clearance smallest_gap(const SceneEquilibrium& eq, const std::vector<std::pair<double, double>>& stretches, int to) {
  Clearance best;
  best.value = infinity;
  for (const auto& [begin, end] : stretches) {
    const Clearance here = eq.clearance(eq.rods.front(), to, begin, end);
    if (here.value < best.value) best = here;
  }
  return best;
}

void judge_gaps(const RefinementOptions& options, RefinementResult& result) {
  const SceneEquilibrium& eq = *result.equilibrium;
  const RodProblem& problem = eq.rods.front().problem;
  const auto stretches = judged_stretches(problem, options);
  result.clearance = smallest_gap(eq, stretches, -1);
  if (result.clearance.obstacle >= 0) result.clearance_to = eq.obstacles[result.clearance.obstacle].name;
  for (int k = 0; k < static_cast<int>(eq.obstacles.size()); ++k) {
    const PlacedObstacle& obstacle = eq.obstacles[k];
    const Clearance gap = k == result.clearance.obstacle ? result.clearance
                          : obstacle.clearance > 0       ? smallest_gap(eq, stretches, k)
                                                         : Clearance{infinity, 0, {}, {}, -1};
    if (gap.obstacle < 0 || !too_close(gap.value, obstacle.clearance, problem.rod.section_at(gap.s).radius())) continue;
    const std::string missed = gap.value < 0 ? "penetrates '" + obstacle.name + "' by " + mm(-gap.value) + " mm"
                                             : mm(gap.value) + " mm to '" + obstacle.name + "'";
    const bool at_end = gap.s <= stretches.front().first || gap.s >= stretches.back().second;
    result.unmet.push_back({Unmet::What::clearance, gap.value, obstacle.clearance, gap.s, gap.at, obstacle.name,
                            missed + " at " + place(gap.s, problem.rod.length) + ", " + mm(obstacle.clearance) + " mm required" +
                                (at_end ? " (where the connection leaves no choice: move it, or let ends be nearer with free_ends)" : "")});
  }
}

void judge_rod(const RefinementOptions& options, RefinementResult& result) {
  const Equilibrium& rod = result.equilibrium->rods.front().equilibrium;
  const double length = result.equilibrium->rods.front().problem.rod.length;
  const std::vector<double> radii = rod.bend_radii();
  const std::size_t sharpest = std::min_element(radii.begin(), radii.end()) - radii.begin();
  result.settled_length = rod.settled_length();
  result.min_bend_radius = radii[sharpest];
  result.min_bend_radius_at = rod.s[sharpest];
  if (result.min_bend_radius < options.min_bend_radius)
    result.unmet.push_back({Unmet::What::bend_radius, result.min_bend_radius, options.min_bend_radius, rod.s[sharpest],
                            rod.points[sharpest], "",
                            "bend radius " + mm(result.min_bend_radius) + " mm at " + place(rod.s[sharpest], length) + ", " +
                                mm(options.min_bend_radius) + " mm required"});
  const double tension = rod.largest_tension(), strain = rod.largest_strain();
  if (tension > options.max_tension)
    result.unmet.push_back({Unmet::What::tension, tension, options.max_tension, 0, rod.points.front(), "",
                            "tension " + number_text(tension) + " N, at most " + number_text(options.max_tension) + " N allowed"});
  if (strain > options.max_strain)
    result.unmet.push_back({Unmet::What::strain, strain, options.max_strain, 0, rod.points.front(), "",
                            "strain " + number_text(strain) + ", at most " + number_text(options.max_strain) + " allowed"});
  if (!rod.stable)
    result.unmet.push_back({Unmet::What::stability, double(rod.negative_pivots), 0, 0, rod.points.front(), "",
                            "the equilibrium is not stable"});
}

/// By how much, as a share of what is demanded.
double share_missed(const Unmet& u, double radius) {
  switch (u.what) {
    case Unmet::What::bend_radius: return 1 - u.value / u.demanded;
    case Unmet::What::clearance: return (u.demanded - u.value) / std::max(u.demanded, radius);
    case Unmet::What::tension: case Unmet::What::strain: return u.value / u.demanded - 1;
    default: return infinity;
  }
}

}  // namespace

void judge(const SurroundingsByUse& around, const RefinementOptions& options, RefinementResult& result) {
  result.unmet.clear();
  const SolvedRod& rod = result.equilibrium->rods.front();
  if (!rod.equilibrium.ok()) {
    result.unmet.push_back({Unmet::What::equilibrium, 0, 0, 0, Vec3::Zero(), "", "no equilibrium: " + rod.equilibrium.message});
    if (rod.equilibrium.s.empty()) return;
  }
  judge_rod(options, result);
  if (around.all) judge_gaps(options, result);
  const double radius = rod.problem.rod.largest_radius();
  std::stable_sort(result.unmet.begin(), result.unmet.end(),
                   [&](const Unmet& a, const Unmet& b) { return share_missed(a, radius) > share_missed(b, radius); });
}

std::string text_of(const std::vector<Unmet>& unmet) {
  std::string text;
  for (const Unmet& u : unmet) text += (text.empty() ? "" : "; ") + u.text;
  return text;
}

}  // namespace tendril::routing
