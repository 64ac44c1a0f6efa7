#include "method/route/route.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/preform/pcc_filtering.h"
#include "scene/formed_rod.h"

namespace tendril::route {

namespace {

using routing::NominalRoute;
using routing::Roadmap;
using routing::StateLattice;

constexpr double same_route = 25e-3;  // m

void require(bool holds, const std::string& what) {
  if (!holds) throw UsageError("route: " + what);
}

void check(const Options& options) {
  require(all_finite(options.from.at) && all_finite(options.to.at), "the ends must be finite places");
  require((options.to.at - options.from.at).norm() > 1e-6, "both ends are in one place");
  require(!options.curve.radii.empty(), "no bend radius was given");
  for (const double radius : options.curve.radii)
    require(std::isfinite(radius) && radius > options.space.radius,
            "the bend radius of " + number_text(radius / units::mm) + " mm is not more than the object's own radius of " +
                number_text(options.space.radius / units::mm) + " mm; bend radii are those of the centre line");
  require(!options.weights.empty(), "no weights were given");
  for (const Weights& w : options.weights)
    require(std::isfinite(w.length) && w.length > 0 && std::isfinite(w.clearance) && w.clearance >= 0,
            "the weight of length must be above 0 and that of clearance at least 0");
  require(std::isfinite(options.grid) && options.grid > 0, "the grid's step is " + number_text(options.grid) + " m; above 0 expected");
}

/// Everything that routes of one scene share.
struct Search {
  const Scene& scene;
  const Options& options;
  const RunContext& context;
  routing::Ends ends;
  StateLattice lattice;

  Search(const Scene& scene, const Options& options, const RunContext& context)
      : scene(scene), options(options), context(context),
        ends{options.from.at, options.from.d3(), options.to.at, options.to.d3()},
        lattice(options.grid, options.curve.radii.front(), 0.5 * options.grid) {}

  std::shared_ptr<const FreeSpace> space(const Weights& weights, double more_clearance = 0) const {
    routing::SpaceDemands demands = options.space;
    demands.clearance_weight = weights.clearance / weights.length;
    demands.clearance += more_clearance;
    const double margin = 2 * options.curve.radii.front() + options.curve.end_straight + demands.radius + demands.clearance;
    return std::make_shared<const FreeSpace>(scene, demands, std::vector<Vec3>{ends.start, ends.finish}, margin, context);
  }
};

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

routing::RefinementOptions refinement_of(const Options& options, const Weights& weights) {
  routing::RefinementOptions refinement = options.refinement;
  refinement.length_weight = 1;
  refinement.clearance_weight = weights.clearance / weights.length;
  refinement.preference_weight = options.space.preference;
  refinement.range = options.space.preference_range;
  refinement.min_bend_radius = options.curve.radii.front();
  refinement.clearance = options.space.clearance;
  refinement.free_ends = options.curve.free_ends;
  refinement.most_clips = 0;
  // A preformed hose gets longer at its finish, where only a straight can.
  if (options.preformed && !(options.curve.end_straight > 0)) refinement.adjust.length = false;
  if (options.curve.min_length > 0) refinement.min_length = options.curve.min_length;
  if (std::isfinite(options.curve.max_length)) refinement.max_length = options.curve.max_length;
  return refinement;
}

/// What a nominal route keeps beyond what is demanded, for gravity to take.
struct Reserve {
  double bend_radius = 1;  ///< factor
  double clearance = 0;    ///< m
};

/// Step 1 for one choice of weights. Nothing where there is no nominal route: `why` says what keeps the ends apart.
std::optional<Route> nominal(const Search& search, const Weights& weights, const Reserve& reserve, MethodStep& count,
                             std::string& why) {
  const std::shared_ptr<const FreeSpace> space = search.space(weights, reserve.clearance);
  const Roadmap roadmap(*space, search.options.grid, search.context);
  routing::NominalOptions nominal_options;
  nominal_options.ends = search.ends;
  nominal_options.curve = search.options.curve;
  for (double& radius : nominal_options.curve.radii) radius *= reserve.bend_radius;
  const NominalRoute found = routing::nominal_routing(*space, roadmap, search.lattice, nominal_options, search.context);
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
  route.objective = found.objective;
  route.design = design_of(search.options, found.points);
  route.ok = true;
  return route;
}

/// More by what gravity took from this design, and a little for what it takes from the next one.
Reserve revised(Reserve reserve, const Route& route) {
  using What = routing::Unmet::What;
  for (const routing::Unmet& unmet : route.refined.unmet) {
    if (unmet.what == What::bend_radius && unmet.value > 0)
      reserve.bend_radius *= std::min(1.5, 1.05 * unmet.demanded / unmet.value);
    if (unmet.what == What::clearance) reserve.clearance += std::min(0.02, 1.5 * std::max(0.0, unmet.demanded - unmet.value) + 1e-3);
  }
  return reserve;
}

/// Step 2. Where refinement fails: once more from a route with something in reserve, then with a revised weight of clearance, at
/// last with clips.
Route refined(const Search& search, Route route, MethodStep& count, MethodStep& nominal_count) {
  const Options& options = search.options;
  const auto refine = [&](Route& r, int clips) {
    routing::RefinementOptions refinement = refinement_of(options, r.weights);
    refinement.most_clips = clips;
    r.refined = routing::refine(search.scene, r.design, refinement, search.context);
    count.counts[0].second += r.refined.evaluations;
    r.ok = r.refined.ok;
  };
  refine(route, 0);
  Route last = route;
  Reserve reserve;
  for (int i = 1; !route.ok && i <= options.restarts && !search.context.stop(); ++i) {
    Weights weights = last.weights;
    reserve = revised(reserve, last);
    if (i > 1) weights.clearance = std::max(2 * weights.clearance, weights.length);
    std::string why;
    std::optional<Route> other = nominal(search, weights, reserve, nominal_count, why);
    if (!other) break;
    refine(*other, 0);
    other->restarts = i;
    count.counts[1].second += 1;
    last = *other;
    if (other->ok || (other->refined.equilibrium && !route.refined.equilibrium)) route = std::move(*other);
  }
  if (!route.ok && options.max_clips > 0 && !search.context.stop()) refine(route, options.max_clips);
  if (route.refined.equilibrium) route.objective = route.refined.objective;
  route.design = route.refined.design;
  return route;
}

bool is_known(const std::vector<Route>& routes, const Route& route) {
  return std::any_of(routes.begin(), routes.end(), [&](const Route& other) {
    return preform::curve_distance(other.nominal, route.nominal) < same_route;
  });
}

void conclude(Result& r, const std::string& why, const RunContext& context) {
  std::vector<Route> ordered;
  for (const bool ok : {true, false})
    for (Route& route : r.routes)
      if (route.ok == ok) ordered.push_back(route);
  r.routes = std::move(ordered);
  r.ok = !r.routes.empty() && r.routes.front().ok;
  const auto kept = std::count_if(r.routes.begin(), r.routes.end(), [](const Route& route) { return route.ok; });
  if (const auto stopped = context.stop(); stopped) {
    r.status = *stopped;
    r.ok = false;
    r.message = std::string(*stopped == Status::timeout ? "out of time" : "cancelled") + "; so far " + std::to_string(kept) + " routes";
  } else if (r.ok) {
    r.status = Status::solved;
    r.message = std::to_string(kept) + (kept == 1 ? " route" : " routes");
  } else {
    r.status = Status::infeasible;
    r.message = r.routes.empty() ? why : "no route keeps all that is demanded in equilibrium: " + r.routes.front().refined.message;
  }
}

}  // namespace

Result run(const Scene& scene, const Options& options, const RunContext& context) {
  check(options);
  Result r;
  r.options = options;
  StepClock clock(r.steps);
  const Search search(scene, options, context);
  r.space = search.space(options.weights.front());
  clock.end("distance_field", {{"primitives", long(search.lattice.primitives())}});

  MethodStep nominal_count{"nominal_routing", 0, {{"states", 0}, {"curves", 0}, {"routes", 0}}};
  std::string why;
  for (const Weights& weights : options.weights) {
    if (context.stop()) break;
    std::optional<Route> route = nominal(search, weights, {}, nominal_count, why);
    if (route && !is_known(r.routes, *route)) r.routes.push_back(std::move(*route));
  }
  nominal_count.counts[2].second = static_cast<long>(r.routes.size());
  clock.end(nominal_count.name, nominal_count.counts);

  if (options.refine) {
    MethodStep count{"local_refinement", 0, {{"equilibria", 0}, {"restarts", 0}}};
    for (Route& route : r.routes)
      if (!context.stop()) route = refined(search, std::move(route), count, nominal_count);
    clock.end(count.name, count.counts);
  }
  r.seconds = clock.seconds();
  conclude(r, why, context);
  return r;
}

}  // namespace tendril::route
