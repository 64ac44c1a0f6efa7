#include "method/preform/end_lead.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/number_text.h"
#include "base/units.h"

namespace tendril::preform {

using routing::FreeSpace;
using routing::Gap;
using routing::PccDemands;

namespace {

/// Longer free ends are no remedy, m.
constexpr double longest_free_end = 0.5;

std::string mm(double value) { return number_text(std::round(value / units::mm * 10) / 10) + " mm"; }

/// The axis first, then rings at half the cone and all of it.
std::vector<Vec3> directions_within(const Vec3& axis, double cone) {
  std::vector<Vec3> all{axis};
  if (!(cone > 0)) return all;
  constexpr int around = 8;
  const Mat3 frame = shortest_turn(Vec3::UnitZ(), axis).toRotationMatrix();
  for (const double tilt : {0.5 * cone, cone * (1 - 1e-9)})
    for (int k = 0; k < around; ++k) {
      const double turn = 2 * units::pi * k / around;
      all.push_back(frame * Vec3(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)));
    }
  return all;
}

/// The first place of the straight from arc length `from` to `to` that is too near to something.
std::optional<double> first_blocked(const FreeSpace& space, const Vec3& end, const Vec3& along, double from, double to) {
  constexpr double least_step = 1e-4;
  for (double s = from;; s += std::max(least_step, space.gap(end + s * along, to - s + least_step).value)) {
    s = std::min(s, to);
    if (!space.is_free(end + s * along)) return s;
    if (s >= to) return std::nullopt;
  }
}

/// The shortest free end with which the rest of the straight, and a bend radius behind it, keeps clear.
std::optional<double> free_end_that_does(const FreeSpace& space, const PccDemands& demands, const Vec3& end, const Vec3& along, double from) {
  for (double s = from; s < longest_free_end;) {
    const double upto = std::max(demands.end_straight, s + demands.radii.front());
    const auto blocked = first_blocked(space, end, along, s, upto);
    if (!blocked) return s;
    s = *blocked + std::max(1e-5, -space.gap(end + *blocked * along, 0).value);
  }
  return std::nullopt;
}

/// The place of the straight from arc length `from` to `to` that is the nearest to something.
double worst_place(const FreeSpace& space, const Vec3& end, const Vec3& along, double from, double to) {
  const int samples = 1 + static_cast<int>(std::min(1000.0, (to - from) / 2.5e-4));
  double worst = from, least = space.gap(end + from * along, 0).value;
  for (int i = 1; i <= samples; ++i) {
    const double s = from + (to - from) * i / samples, gap = space.gap(end + s * along, 0).value;
    if (gap < least) least = gap, worst = s;
  }
  return worst;
}

std::string obstruction_at(const FreeSpace& space, const PccDemands& demands, const Vec3& end, const Vec3& along, double s,
                           const std::string& who) {
  const Gap gap = space.gap(end + s * along, 0);
  if (gap.obstacle < 0) return who + ": its straight end does not keep clear";
  const std::string& name = space.name(gap.obstacle);
  const bool is_obstacle = gap.obstacle < space.surroundings().size() - static_cast<int>(space.demands().keep_out.size());
  std::string text = who + ": ";
  if (s > 0) text += mm(s) + " along its straight ";
  text += "the hose is " + mm(-gap.value);
  if (is_obstacle) {
    const double required = space.surroundings().obstacle(gap.obstacle).clearance, distance = gap.value + required;
    text += " too near to '" + name + "' (" + (distance < 0 ? mm(-distance) + " into it" : mm(distance) + " away") + ", " + mm(required) +
            " required)";
  } else {
    text += name == "keep_in" ? " outside keep_in" : " inside " + name;
  }
  text += "; move it";
  if (is_obstacle && space.demands().clearance > 0) text += ", ask for less clearance";
  if (const auto enough = free_end_that_does(space, demands, end, along, demands.free_ends))
    text += ", or let 'free_ends' be at least " + mm(std::ceil(*enough / units::mm * 10 - 1e-6) / 10 * units::mm);
  return text;
}

}  // namespace

EndLead end_lead(const FreeSpace& space, const PccDemands& demands, const Vec3& end, const Vec3& outward, double cone, const std::string& who) {
  const double free_end = demands.free_ends, least = std::max(demands.end_straight, free_end), radius = demands.radii.front();
  const std::vector<Vec3> directions = directions_within(outward, cone);
  for (const Vec3& along : directions) {
    if (free_end > 0 && space.surroundings().ray(end, end + free_end * along)) continue;
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
      const double length = least + share * radius;
      const Vec3 tip = end + length * along;
      if (space.region().contains(tip) && space.is_free(Vec3(end + free_end * along), tip)) return {tip, length, ""};
    }
  }
  EndLead lead{end, 0, ""};
  const bool blocked = first_blocked(space, end, outward, free_end, least).has_value();
  const auto hit = free_end > 0 ? space.surroundings().ray(end, end + free_end * outward) : std::nullopt;
  if (hit)
    lead.obstruction = who + ": its straight passes through '" + space.name(hit->obstacle) + "' after " + mm((hit->point - end).norm()) +
                       "; move it, or turn it the other way";
  else if (blocked)
    lead.obstruction = obstruction_at(space, demands, end, outward, worst_place(space, end, outward, free_end, least), who);
  else
    lead.obstruction = who + ": its straight of " + mm(least) + " leaves the region that is searched";
  return lead;
}

}  // namespace tendril::preform
