#include "method/variation/clear_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/clearance.h"

namespace tendril::variation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double margin = 1.1;  // rods stretch, and the way between two points bends
constexpr int most_points = 2000;

}  // namespace

ClearWay::ClearWay(const SystemProblem& problem, const std::vector<Equilibrium>& nominal, const ContactField& field)
    : field_(field) {
  for (std::size_t k = 0; k < nominal.size(); ++k) {
    const Rod& design = problem.rods[k].rod;
    const double radius = design.largest_radius();
    const int count =
        std::clamp(static_cast<int>(std::ceil(design.length / std::max(radius, 1e-6 * design.length))), 8, most_points);
    reach_.push_back(radius + margin * 0.5 * design.length / count);
    std::vector<Point>& points = points_.emplace_back();
    for (int i = 0; i <= count; ++i) {
      const double share = static_cast<double>(i) / count;
      const Vec3 at = nominal[k].frame_at(share * design.length).at;
      points.push_back({share, at, field.closest(at, infinity).distance - reach_.back()});
    }
    clear_ = clear_ && nominal[k].contacts.empty() && rod_is_clear(design, nominal[k]);
  }
}

bool ClearWay::rod_is_clear(const Rod& design, const Equilibrium& rod) const {
  const auto distance = [this](const Vec3& p) { return field_.closest(p, infinity); };
  return clearance_of(design, rod, distance, 0, design.length).value > 0;
}

bool ClearWay::clear(int rod, const Rod& design, const Equilibrium& outcome) const {
  bool near = false;
  for (const Point& point : points_[rod]) {
    const Vec3 at = outcome.frame_at(point.share * design.length).at;
    // A longer rod's points lie farther apart.
    const double farther = margin * 0.5 * std::abs(outcome.s.back() / points_[rod].size());
    if ((at - point.at).norm() + std::max(0.0, farther - reach_[rod]) < point.free) continue;
    if (field_.ray(point.at, at)) return false;
    near = near || field_.closest(at, reach_[rod] + farther).obstacle >= 0;
  }
  return !near || rod_is_clear(design, outcome);
}

}  // namespace tendril::variation
