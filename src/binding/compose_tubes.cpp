#include "binding/compose_tubes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace tendril {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr Rgb body_colour{0.36f, 0.38f, 0.42f};

/// Piecewise linear through (x, y), constant beyond its ends. x ascends.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (x.empty()) return unknown;
  const auto right = std::upper_bound(x.begin(), x.end(), at);
  if (right == x.begin()) return y.front();
  if (right == x.end()) return y.back();
  const std::size_t i = static_cast<std::size_t>(right - x.begin());
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return (1 - share) * y[i - 1] + share * y[i];
}

std::vector<double> middles(const std::vector<double>& s) {
  std::vector<double> middle;
  for (std::size_t i = 1; i < s.size(); ++i) middle.push_back(0.5 * (s[i - 1] + s[i]));
  return middle;
}

/// Values of a rod at some arc lengths; straight lines between them.
struct Profile {
  std::vector<double> s, value;
};

Profile profile_of(const Equilibrium& eq, RodColour colour) {
  Profile profile;
  if (colour == RodColour::curvature) {
    profile.s = eq.s;
    for (const double radius : eq.bend_radii()) profile.value.push_back(1 / radius);
    return profile;
  }
  profile.s = middles(eq.s);
  for (std::size_t i = 0; i < eq.forces.size(); ++i)
    profile.value.push_back(colour == RodColour::twist
                                ? eq.curvatures[i].z()
                                : eq.forces[i].dot((eq.points[i + 1] - eq.points[i]).normalized()));
  return profile;
}

/// mm.
Profile moves_of(const Equilibrium& eq, const std::vector<double>& moves) {
  Profile profile{eq.s, {}};
  for (const double move : moves) profile.value.push_back(move / units::mm);
  return profile;
}

/// What contact leaves of a penetration is none in a picture: where no clearance is required, touching is no offence.
double shown_gap(double gap, double required, double radius) {
  const bool touches = required == 0 && gap < 0 && !too_close(gap, required, radius);
  return touches ? 0 : gap - required;
}

/// Smallest of gap minus `required` over the obstacles, or the plain gap to the nearest when all require the same. mm.
double gap_at(const SceneEquilibrium& eq, const SolvedRod& rod, double s, const Vec3& p, double radius, std::optional<double> alike) {
  double least = std::numeric_limits<double>::infinity();
  if (alike) {
    const ClosestPoint closest = eq.closest(rod, s, p);
    if (closest.obstacle >= 0) least = shown_gap(closest.distance - radius, *alike, radius) + *alike;
  } else {
    for (int k = 0; k < static_cast<int>(eq.obstacles.size()); ++k) {
      const ClosestPoint closest = eq.closest(rod, s, p, k);
      if (closest.obstacle >= 0)
        least = std::min(least, shown_gap(closest.distance - radius, eq.obstacles[k].clearance, radius));
    }
  }
  return std::isfinite(least) ? least / units::mm : unknown;
}

PictureTube compose_tube(const SceneEquilibrium& eq, const SolvedRod& rod, const PictureWish& wish, std::optional<double> alike) {
  const Rod& design = rod.problem.rod;
  PictureTube tube;
  tube.name = rod.name;
  tube.radius = design.largest_radius();
  tube.colour = wish.plain;
  const bool by_profile = wish.colour != RodColour::plain && wish.colour != RodColour::clearance;
  Profile profile = by_profile && wish.colour != RodColour::moves ? profile_of(rod.equilibrium, wish.colour) : Profile();
  if (wish.colour == RodColour::moves) profile = moves_of(rod.equilibrium, wish.moves[&rod - eq.rods.data()]);
  // Fine enough for a smooth tube and a sharp colour border, coarse enough for a rod of a million segments.
  const double spacing = std::max(0.5 * tube.radius, design.length / 4000);
  double last = -design.length;
  for (const Equilibrium::Sample& sample : rod.equilibrium.sampled(spacing)) {
    if (sample.s - last < 0.2 * spacing && sample.s < design.length) continue;
    last = sample.s;
    const double radius = design.section_at(sample.s).radius();
    tube.points.push_back(sample.frame.at);
    if (design.parts.size() > 1) tube.radii.push_back(radius);
    if (by_profile) tube.values.push_back(interpolated(profile.s, profile.value, sample.s));
    if (wish.colour == RodColour::clearance && !eq.obstacles.empty())
      tube.values.push_back(gap_at(eq, rod, sample.s, sample.frame.at, radius, alike));
  }
  return tube;
}

/// What is rigid at a branch point: from its place to every section that is joined at a distance.
void add_branch_bodies(const SceneEquilibrium& eq, const SolvedSystem& system, std::vector<PictureTube>& tubes) {
  for (std::size_t b = 0; b < system.branches.size(); ++b) {
    const SolvedBranch& branch = eq.branches[system.branches[b]];
    for (const JoinedSection& section : system.problem.branches[b].sections) {
      const SolvedRod& rod = eq.rods[system.rods[section.rod]];
      const Vec3 at = rod.equilibrium.frame_at(section.at).at;
      const double radius = rod.problem.rod.section_at(section.at).radius();
      if ((at - branch.frame.at).norm() < 0.01 * radius) continue;
      PictureTube tube;
      tube.name = branch.name;
      tube.points = {branch.frame.at, at};
      tube.radius = radius;
      tube.colour = body_colour;
      tubes.push_back(tube);
    }
  }
}

}  // namespace

std::optional<double> common_clearance(const std::vector<PlacedObstacle>& obstacles) {
  if (obstacles.empty()) return std::nullopt;
  for (const PlacedObstacle& obstacle : obstacles)
    if (obstacle.clearance != obstacles.front().clearance) return std::nullopt;
  return obstacles.front().clearance;
}

ColourScale scale_of_gaps(std::optional<double> required) {
  ColourScale scale;
  scale.meaning = ColourMeaning::clearance;
  scale.name = required ? "clearance" : "margin to required clearance";
  scale.unit = "mm";
  scale.limit = required.value_or(0) / units::mm;
  scale.broken = LimitSide::below;
  return scale;
}

ColourScale clearance_scale(const std::vector<PlacedObstacle>& obstacles) { return scale_of_gaps(common_clearance(obstacles)); }

std::vector<PictureTube> compose_tubes(const SceneEquilibrium& eq, const PictureWish& wish) {
  const std::optional<double> alike = common_clearance(eq.obstacles);
  std::vector<PictureTube> tubes;
  for (const SolvedRod& rod : eq.rods) tubes.push_back(compose_tube(eq, rod, wish, alike));
  for (const SolvedSystem& system : eq.systems) add_branch_bodies(eq, system, tubes);
  return tubes;
}

ColourScale compose_scale(const SceneEquilibrium& eq, RodColour colour) {
  ColourScale scale;
  switch (colour) {
    case RodColour::clearance: return clearance_scale(eq.obstacles);
    case RodColour::curvature:
      scale.name = "curvature";
      scale.unit = "1/m";
      scale.low = 0;
      break;
    case RodColour::moves:
      scale.name = "move within the tolerances";
      scale.unit = "mm";
      scale.low = 0;
      break;
    case RodColour::tension:
      scale.meaning = ColourMeaning::diverging;
      scale.name = "tension";
      scale.unit = "N";
      break;
    case RodColour::twist:
      scale.meaning = ColourMeaning::diverging;
      scale.name = "twist";
      scale.unit = "rad/m";
      break;
    case RodColour::plain: break;
  }
  return scale;
}

}  // namespace tendril
