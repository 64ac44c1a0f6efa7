#include "method/free_space/place_cost.h"

#include <algorithm>
#include <cmath>

#include "method/free_space/distance_gradient.h"

namespace tendril::routing {
namespace {

/// A field is worth its making for meshes of more triangles.
constexpr std::size_t small_mesh = 1000;
/// What a bound is raised by (m), so that a surface at exactly that distance is found.
constexpr double beyond_rounding = 1e-9;

bool by_nearest(const PlacedObstacle& placed, const SpaceDemands& demands) {
  return demands.clearance_weight > 0 && placed.prefer != Preference::near;
}

bool by_preference(const PlacedObstacle& placed, const SpaceDemands& demands) {
  return demands.preference > 0 && placed.prefer != Preference::neutral;
}

/// f of the gap and its slope, 1/m.
std::pair<double, double> nearness(double gap, double range) {
  const double x = std::max(0.0, 1 - gap / range);
  return {x * x, -2 * x / range};
}

}  // namespace

bool PlaceCost::differs(const Scene& scene, const SpaceDemands& demands) {
  const auto& all = scene.bodies();
  return std::any_of(all.begin(), all.end(), [&](const PlacedObstacle& placed) {
    return by_nearest(placed, demands) || by_preference(placed, demands);
  });
}

PlaceCost::PlaceCost(const Scene& scene, const SpaceDemands& demands, const Eigen::AlignedBox3d& inner, const Eigen::AlignedBox3d& region,
                     double spacing, const RunContext& context)
    : demands_(demands) {
  std::size_t triangles = 0;
  for (const PlacedObstacle& placed : scene.bodies()) {
    Obstacle body = placed.body;
    body.name = placed.name;
    body.clearance = 0;
    if (by_nearest(placed, demands_)) {
      nearest_.add(body);
      triangles += placed.triangles();
    }
    if (!by_preference(placed, demands_)) continue;
    preferred_.add(body);
    near_.push_back(placed.prefer == Preference::near);
    preferred_fields_.emplace_back();
    if (placed.triangles() <= small_mesh) continue;
    Surroundings alone;
    alone.add(body);
    preferred_fields_.back() = scene.fields()->field(alone, inner, region, 2 * spacing, context);
    if (!preferred_fields_.back()->ok()) preferred_fields_.back().reset();
  }
  if (triangles <= small_mesh && nearest_.size() < 8) return;
  nearest_field_ = scene.fields()->field(nearest_, inner, region, spacing, context);
  if (!nearest_field_->ok()) nearest_field_.reset();
}

double PlaceCost::term(double distance, double weight, bool near) const {
  const double f = nearness(distance - demands_.radius, demands_.preference_range).first;
  return weight * (near ? std::max(0.0, 1 - f) : f);
}

double PlaceCost::exact(const Vec3& p, Vec3* gradient) const {
  double cost = 1;
  if (gradient) gradient->setZero();
  if (!all_finite(p)) return cost;
  const double limit = reach();
  const auto add = [&](const Surroundings& obstacles, const ClosestPoint& found, double weight, bool near) {
    const auto [f, slope] = nearness(found.distance - demands_.radius, demands_.preference_range);
    cost += weight * (near ? std::max(0.0, 1 - f) : f);
    if (gradient && found.obstacle >= 0 && !(near && f >= 1))
      *gradient += (near ? -weight : weight) * slope * distance_gradient(obstacles, p, found, found.distance);
  };
  if (nearest_.size() > 0) {
    // What the field knows keeps the trees from looking farther than there is something, and altogether where there is nothing.
    DistanceField::Bounds known{-limit, limit};
    if (nearest_field_) known = nearest_field_->at(p);
    ClosestPoint found{limit, p, -1};
    if (known.low < limit) {
      const double most = std::min(limit, known.high + beyond_rounding);
      found = nearest_.closest(p, most);
      if (found.obstacle < 0 && most < limit) found = nearest_.closest(p, limit);
    }
    add(nearest_, found, demands_.clearance_weight, false);
  }
  for (int i = 0; i < preferred_.size(); ++i) add(preferred_, preferred_.closest_on(i, p, limit), demands_.preference, near_[i]);
  return cost;
}

double PlaceCost::by_field(const Vec3& p) const {
  double cost = 1;
  if (!all_finite(p)) return cost;
  const auto distance = [&](const std::shared_ptr<const DistanceField>& field, auto&& exactly) {
    const double known = field ? field->interpolated(p) : std::numeric_limits<double>::quiet_NaN();
    return std::isnan(known) ? exactly().distance : known;
  };
  if (nearest_.size() > 0)
    cost += term(distance(nearest_field_, [&] { return nearest_.closest(p, reach()); }), demands_.clearance_weight, false);
  for (int i = 0; i < preferred_.size(); ++i)
    cost += term(distance(preferred_fields_[i], [&] { return preferred_.closest_on(i, p, reach()); }), demands_.preference, near_[i]);
  return cost;
}

}  // namespace tendril::routing
