#include "method/route/signed_gap.h"

#include <algorithm>
#include <array>
#include <limits>

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_passes = 16;

}  // namespace

/// Where the first mesh is met that is passed an odd number of times.
std::optional<RayHit> SignedGap::entry(const Vec3& p, const Vec3& outside) const {
  std::array<RayHit, most_passes> passed;
  int passes = 0;
  Vec3 from = outside;
  const double way = (p - outside).norm();
  while (passes < most_passes && way > 0) {
    const std::optional<RayHit> hit = field_->ray(from, p);
    if (!hit) break;
    if (!std::holds_alternative<Solid>(field_->obstacle(hit->obstacle).shape)) passed[passes++] = *hit;
    // Beyond the surface by more than rounding, so that it is not met again.
    const Vec3 next = hit->point + (1e-9 + 1e-12 / way) * (p - outside);
    if ((p - outside).dot(p - next) <= 0) break;
    from = next;
  }
  for (int i = 0; i < passes; ++i) {
    int times = 0;
    for (int k = 0; k < passes; ++k) times += passed[k].obstacle == passed[i].obstacle;
    if (times % 2 == 1) return passed[i];
  }
  return std::nullopt;
}

SignedGap::Value SignedGap::at(const Vec3& p, const Vec3& outside, double limit) const {
  if (!field_ || field_->size() == 0) return {limit, Vec3::Zero(), p, -1};
  if (const std::optional<RayHit> behind = entry(p, outside)) {
    const double depth = std::max(0.0, behind->normal.dot(behind->point - p));
    return {-depth - field_->clearance(behind->obstacle), behind->normal, behind->point, behind->obstacle};
  }
  const ClosestPoint closest = field_->closest_kept(p, limit, infinity);
  if (closest.obstacle < 0) return {limit, Vec3::Zero(), p, -1};
  const double distance = closest.distance + field_->clearance(closest.obstacle);
  if (distance == 0) return {closest.distance, Vec3::Zero(), closest.point, closest.obstacle};
  return {closest.distance, (p - closest.point) / distance, closest.point, closest.obstacle};
}

}  // namespace tendril::routing
