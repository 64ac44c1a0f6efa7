#include "method/route/route.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/units.h"
#include "method/preform/pcc_filtering.h"
#include "method/route/refined_route.h"

namespace tendril::route {

namespace {

// m: alternatives nearer to each other than this all along are one.
constexpr double same_route = 2e-3;
constexpr double farthest_clearance = 0.5;  // m, looked for

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

double Route::clearance() const {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (refined.equilibrium) return refined.clearance_to.empty() ? none : refined.clearance.value;
  return nominal_clearance.to.empty() ? none : nominal_clearance.gap.value;
}

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
    if (!route || is_known(r.routes, *route)) continue;
    const double free = options.curve.free_ends;
    route->nominal_clearance = routing::clearance_of(*r.space, route->nominal, free, free, farthest_clearance);
    r.routes.push_back(std::move(*route));
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
