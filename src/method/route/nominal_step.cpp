#include "method/route/nominal_step.h"

#include <algorithm>
#include <cmath>

#include "scene/formed_rod.h"

namespace tendril::route {

namespace {

using routing::NominalRoute;
using routing::Roadmap;

int segments_for(const Options& options, double length) {
  if (options.segments > 0) return options.segments;
  return std::max(40, static_cast<int>(std::ceil(4 * length / options.curve.radii.front())));
}

routing::Design design_of(const Options& options, const PccPoints& nominal) {
  routing::Design design;
  const Curve curve = nominal.curve();
  design.rod = Rod::uniform(curve.length(), options.section, segments_for(options, curve.length()));
  if (options.preformed) form(design.rod, curve);
  else design.route = curve;
  design.from = options.from;
  design.to = options.to;
  return design;
}

}  // namespace

Search::Search(const Scene& scene, const Options& options, const RunContext& context)
    : scene(scene), options(options), context(context),
      ends{options.from.at, options.from.d3(), options.to.at, options.to.d3()},
      lattice(options.grid, options.curve.radii.front(), 0.5 * options.grid) {}

std::shared_ptr<const FreeSpace> Search::space(const Weights& weights, double more_clearance) const {
  routing::SpaceDemands demands = options.space;
  demands.clearance_weight = weights.clearance / weights.length;
  demands.clearance += more_clearance;
  const double margin = 2 * options.curve.radii.front() + options.curve.end_straight + demands.radius + demands.clearance;
  return std::make_shared<const FreeSpace>(scene, demands, std::vector<Vec3>{ends.start, ends.finish}, margin, context);
}

std::shared_ptr<const Ground> Search::ground(const Weights& weights, double more_clearance) const {
  // Far more room asked for is another maze: a search that does not know it looks into all of its dead ends.
  if (more_clearance > 0.25 * options.grid) {
    const std::shared_ptr<const FreeSpace> around = space(weights, more_clearance);
    return std::make_shared<const Ground>(Ground{around, Roadmap(*around, options.grid, context)});
  }
  const std::lock_guard lock(making_);
  std::shared_ptr<const Ground>& known = grounds_[weights.clearance / weights.length];
  if (!known) {
    const std::shared_ptr<const FreeSpace> around = space(weights);
    known = std::make_shared<const Ground>(Ground{around, Roadmap(*around, options.grid, context)});
  }
  return known;
}

std::optional<Route> nominal(const Search& search, const Weights& weights, const Reserve& reserve, MethodStep& count,
                             std::string& why) {
  const std::shared_ptr<const Ground> ground = search.ground(weights, reserve.clearance);
  const bool as_asked = ground->space->demands().clearance == search.options.space.clearance + reserve.clearance;
  const auto space = as_asked ? ground->space : search.space(weights, reserve.clearance);
  routing::NominalOptions nominal_options;
  nominal_options.ends = search.ends;
  nominal_options.curve = search.options.curve;
  for (double& radius : nominal_options.curve.radii) radius *= reserve.bend_radius;
  if (reserve.most_states > 0) nominal_options.search.most_states = reserve.most_states;
  const NominalRoute found = routing::nominal_routing(*space, ground->roadmap, search.lattice, nominal_options, search.context);
  count.counts[0].second += found.states;
  count.counts[1].second += found.candidates;
  if (found.status != NominalRoute::Status::found) {
    why = found.obstruction;
    return std::nullopt;
  }
  Route route;
  route.weights = weights;
  route.nominal = found.points;
  route.nominal_length = found.length;
  route.lattice_length = found.lattice_length;
  route.lattice_states = found.states;
  route.objective = found.objective;
  route.design = design_of(search.options, found.points);
  route.ok = true;
  return route;
}

}  // namespace tendril::route
