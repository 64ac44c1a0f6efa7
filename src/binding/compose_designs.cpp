#include "binding/compose_designs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/units.h"
#include "binding/card.h"
#include "binding/compose_tubes.h"
#include "method/preform/bending_table.h"
#include "view/colour_map.h"

namespace tendril {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The clearance that all obstacles ask for alike, m.
std::optional<double> common_demand(const Surroundings& surroundings) {
  if (surroundings.size() == 0) return std::nullopt;
  for (int i = 1; i < surroundings.size(); ++i)
    if (surroundings.clearance(i) != surroundings.clearance(0)) return std::nullopt;
  return surroundings.clearance(0);
}

/// At points that are equally far apart along a curve of this length. Within the free ends no gap is asked for, and none shown.
std::vector<double> gaps_along(const preform::Result& result, const std::vector<Vec3>& points, double length) {
  const Surroundings& surroundings = result.space->surroundings();
  const double most = common_demand(surroundings) ? 0 : infinity, free = result.options.curve.free_ends;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = length * i / (points.size() - 1);
    const bool is_free = s < free || s > length - free;
    gaps.push_back(is_free ? std::numeric_limits<double>::quiet_NaN()
                           : (surroundings.closest_kept(points[i], infinity, most).distance - result.options.space.radius) / units::mm);
  }
  return gaps;
}

std::string bends_text(int count) { return std::to_string(count) + (count == 1 ? " bend" : " bends"); }

PictureLabel gap_label(const routing::CurveGap& gap, double radius) {
  const double way = (gap.on - gap.at).norm();
  PictureLabel label;
  label.at = way > 0 ? Vec3(gap.at + (gap.on - gap.at) * std::min(1.0, radius / way)) : gap.at;
  label.to = gap.on;
  label.text = "gap " + quantity(gap.value, "m");
  return label;
}

std::vector<PictureCard::Row> rows_of(const preform::Result& result, const preform::Hose& hose) {
  std::vector<PictureCard::Row> rows{{"what", hose.label, false}, {"length", quantity(hose.length, "m"), false},
                                     {"bends", std::to_string(hose.points.bends()), false}};
  if (hose.clearance.obstacle >= 0)
    rows.push_back({"min. clearance", quantity(hose.clearance.value, "m") + " to " + hose.clearance_to, false});
  const double free = result.options.curve.free_ends;
  if (free > 0) rows.push_back({"no clearance asked for within", quantity(free, "m") + " of the ends", false});
  constexpr std::size_t most = 8;  // bends with rows of their own; more would not fit the card
  const std::vector<preform::Bend> bends = preform::bends_of(hose.points);
  for (std::size_t i = 0; i < std::min(most, bends.size()); ++i) {
    char line[96];
    std::snprintf(line, sizeof line, "after %.1f mm, turned %.1f deg, bent %.1f deg", bends[i].straight_before / units::mm,
                  bends[i].plane / units::deg, bends[i].angle / units::deg);
    rows.push_back({"bend " + std::to_string(i + 1), line, false});
  }
  return rows;
}

std::string line_of(const preform::Hose& hose) {
  std::string line = quantity(hose.length, "m") + ", " + bends_text(hose.points.bends());
  if (hose.clearance.obstacle >= 0) line += ", gap " + quantity(hose.clearance.value, "m");
  return line + ", passage " + std::to_string(hose.passage);
}

/// The point of a design that is farthest from all others.
Vec3 lonely_point(const std::vector<PictureDesign>& designs, std::size_t index) {
  const std::vector<Vec3>& points = designs[index].points;
  Vec3 best = points[points.size() / 2];
  double farthest = -1;
  for (std::size_t i = points.size() / 5; i < points.size() - points.size() / 5; ++i) {
    double nearest = infinity;
    for (std::size_t k = 0; k < designs.size(); ++k)
      if (k != index)
        for (const Vec3& other : designs[k].points) nearest = std::min(nearest, (other - points[i]).squaredNorm());
    if (nearest > farthest && std::isfinite(nearest)) {
      farthest = nearest;
      best = points[i];
    }
  }
  return best;
}

}  // namespace

std::vector<PictureDesign> designs_of(const preform::Result& result, std::optional<int> only) {
  std::vector<PictureDesign> designs;
  for (int i = 0; i < static_cast<int>(result.hoses.size()); ++i) {
    if (only && i != *only) continue;
    const preform::Hose& hose = result.hoses[i];
    PictureDesign design;
    design.name = std::to_string(i + 1);
    design.radius = result.options.space.radius;
    design.points = hose.points.curve().sampled(0.5 * design.radius);
    if (only) {
      if (result.space->has_obstacles()) design.gaps = gaps_along(result, design.points, hose.length);
      if (hose.clearance.obstacle >= 0) design.gap = gap_label(hose.clearance, design.radius);
      design.rows = rows_of(result, hose);
    } else {
      design.rows = {{"hose " + design.name, line_of(hose), false}};
    }
    designs.push_back(std::move(design));
  }
  return designs;
}

std::vector<PictureDesign> designs_of(const route::Result& result) {
  std::vector<PictureDesign> designs;
  for (std::size_t i = 0; i < result.routes.size(); ++i) {
    const route::Route& route = result.routes[i];
    PictureDesign design;
    design.name = std::to_string(i + 1);
    design.radius = result.options.space.radius;
    design.points = route.nominal.curve().sampled(0.5 * design.radius);
    design.rows = {{"route " + design.name, quantity(route.nominal_length, "m") + ", clearance weighs " + plain_number(route.weights.clearance / route.weights.length), false}};
    designs.push_back(std::move(design));
  }
  return designs;
}

ColourScale gap_scale(const preform::Result& result) { return scale_of_gaps(common_demand(result.space->surroundings())); }

void add_designs(const std::vector<PictureDesign>& designs, Picture& picture) {
  constexpr std::size_t most = 12;  // designs with rows of their own; more would not fit the card
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const PictureDesign& design = designs[i];
    PictureTube tube;
    tube.name = design.name;
    tube.points = design.points;
    tube.radius = design.radius;
    tube.values = design.gaps;
    tube.colour = category_colour(i);
    picture.tubes.push_back(std::move(tube));
    if (designs.size() > 1) picture.labels.push_back({lonely_point(designs, i), std::nullopt, design.name, false});
    if (design.gap) picture.labels.push_back(*design.gap);
    if (i < most) picture.card.rows.insert(picture.card.rows.end(), design.rows.begin(), design.rows.end());
  }
  if (designs.size() > most) picture.card.rows.push_back({"and", std::to_string(designs.size() - most) + " more", false});
}

}  // namespace tendril
