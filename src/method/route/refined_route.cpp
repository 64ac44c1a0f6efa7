#include "method/route/refined_route.h"

#include <algorithm>
#include <cmath>

namespace tendril::route {

namespace {

// States of the lattice that a restart may touch: these, and so many times those of the first route.
constexpr long enough_states = 100'000, states_of_first = 50;
constexpr int restarts_before_clips = 1;  // where clips may be added: what one revised route does not mend, more seldom do

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

/// Held by clips on its nominal route, on that of the last restart, at last on such as have more in reserve.
void clip(const Search& search, Route& route, const Route& last, MethodStep& count, MethodStep& nominal_count) {
  const auto held = [&](const Route& on, int restarts) {
    Route trial = on;
    routing::RefinementOptions refinement = refinement_of(search.options, trial.weights);
    refinement.most_clips = search.options.max_clips;
    trial.refined = routing::refine_clipped(search.scene, trial.design, refinement, search.context);
    trial.ok = trial.refined.ok;
    trial.restarts = restarts;
    count.counts[0].second += trial.refined.evaluations;
    return trial;
  };
  Route best = held(route, route.restarts);
  if (!best.ok && last.restarts > route.restarts)
    if (Route other = held(last, last.restarts); other.ok) best = std::move(other);
  Reserve reserve;
  reserve.most_states = enough_states + states_of_first * route.lattice_states;
  for (int i = 1; !best.ok && i <= search.options.restarts && !search.context.stop(); ++i) {
    reserve.bend_radius *= 1.2;
    reserve.clearance += 2e-3;
    std::string why;
    std::optional<Route> other = nominal(search, route.weights, reserve, nominal_count, why);
    if (!other) break;
    count.counts[1].second += 1;
    if (Route trial = held(*other, last.restarts + i); trial.ok) best = std::move(trial);
  }
  if (best.refined.equilibrium || !route.refined.equilibrium) route = std::move(best);
  else if (!best.refined.message.empty()) route.refined.message += "; " + best.refined.message;
}

}  // namespace

Route refined(const Search& search, Route route, MethodStep& count, MethodStep& nominal_count) {
  const Options& options = search.options;
  const auto refine = [&](Route& r) {
    r.refined = routing::refine(search.scene, r.design, refinement_of(options, r.weights), search.context);
    count.counts[0].second += r.refined.evaluations;
    r.ok = r.refined.ok;
  };
  refine(route);
  Route last = route;
  Reserve reserve;
  reserve.most_states = enough_states + states_of_first * route.lattice_states;
  const int restarts = options.max_clips > 0 ? std::min(options.restarts, restarts_before_clips) : options.restarts;
  for (int i = 1; !route.ok && i <= restarts && !search.context.stop(); ++i) {
    Weights weights = last.weights;
    reserve = revised(reserve, last);
    if (i > 1) weights.clearance = std::max(2 * weights.clearance, weights.length);
    std::string why;
    std::optional<Route> other = nominal(search, weights, reserve, nominal_count, why);
    if (!other) break;
    refine(*other);
    other->restarts = i;
    count.counts[1].second += 1;
    last = *other;
    if (other->ok || (other->refined.equilibrium && !route.refined.equilibrium)) route = std::move(*other);
  }
  if (!route.ok && options.max_clips > 0 && !search.context.stop()) clip(search, route, last, count, nominal_count);
  if (route.refined.equilibrium) route.objective = route.refined.objective;
  route.design = route.refined.design;
  return route;
}

}  // namespace tendril::route
