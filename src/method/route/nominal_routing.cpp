#include "method/route/nominal_routing.h"

#include <algorithm>

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"
#include "method/pcc/cost_integral.h"
#include "method/preform/global_search.h"
#include "method/preform/pcc_optimization.h"
#include "method/preform/pcc_sampling.h"

namespace tendril::routing {

namespace {

using preform::Candidate;
using preform::GlobalPaths;
using preform::Optimized;

/// Other passages that are tried beside the chain's: its lattice errs by a tenth, so that it may have taken the second best.
constexpr int few_paths = 3, more_paths = 6;
constexpr double small_detour = 1.15;
/// Bends of curves that come from them; polishing leaves little for more.
constexpr int most_bends_beside = 5;

/// What the steps of preformed routing are told, which smooth and repair here as there.
preform::Options smoothing_options(const FreeSpace& space, const Roadmap& roadmap, const NominalOptions& options) {
  preform::Options smoothing;
  smoothing.ends = options.ends;
  smoothing.space = space.demands();
  smoothing.curve = options.curve;
  smoothing.max_bends = options.max_bends;
  smoothing.grid = roadmap.step();
  smoothing.max_paths = few_paths;
  smoothing.max_detour = small_detour;
  smoothing.fewer_bends = 5e-4;
  return smoothing;
}

/// The cheapest feasible curve that the paths lead to; false where there is none.
bool smooth(const FreeSpace& space, const preform::Options& options, const GlobalPaths& paths, NominalRoute& route,
            const RunContext& context) {
  std::vector<Candidate> candidates = preform::pcc_sampling(space, options, paths, context);
  std::erase_if(candidates, [](const Candidate& c) { return c.path > 0 && c.points.bends() > most_bends_beside; });
  std::vector<Optimized> curves = preform::pcc_optimization(space, options, candidates, context);
  route.candidates += static_cast<int>(candidates.size());
  std::erase_if(curves, [](const Optimized& c) { return !c.violations.empty(); });
  if (curves.empty()) return false;
  const auto best = std::min_element(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.objective < b.objective; });
  std::vector<Optimized> winner{*best};
  preform::polish(space, options, winner, context);
  const Optimized& curve = winner.front().violations.empty() ? winner.front() : *best;
  route.points = curve.points;
  route.length = curve.length;
  route.objective = curve.objective;
  route.status = NominalRoute::Status::found;
  return true;
}

/// The chain as it is, where it keeps everything.
bool keep_chain(const FreeSpace& space, const NominalOptions& options, const LatticePath& path, NominalRoute& route) {
  PccDemands demands = options.curve;
  demands.radii = path.chain.radii;  // of the lattice's own arcs, each at least the smallest demanded
  if (!violations(space, demands, options.ends, path.chain).empty()) return false;
  route.points = path.chain;
  route.length = path.chain.length();
  route.objective = cost_integral(space, path.chain);
  route.status = NominalRoute::Status::found;
  return true;
}

std::string obstruction_of(const LatticePath& path, const StateLattice& lattice, const GlobalPaths& paths) {
  if (!paths.obstruction.empty()) return paths.obstruction;
  const std::string radius = number_text(lattice.radius() / units::mm) + " mm";
  if (path.outcome == LatticePath::Outcome::capped)
    return "the search was given up after " + std::to_string(path.states) + " states without a way that bends with " + radius +
           "; a coarser 'grid' searches farther";
  if (path.outcome == LatticePath::Outcome::found)
    return "ways were found, but none that keeps all that is demanded between the grid's places; try a finer 'grid'";
  return "places are connected, but with a bend radius of " + radius + " the grid's step of " + number_text(lattice.step() / units::mm) +
         " mm has no way from one end's direction to the other's";
}

}  // namespace

NominalRoute nominal_routing(const FreeSpace& space, const Roadmap& roadmap, const StateLattice& lattice,
                             const NominalOptions& options, const RunContext& context) {
  NominalRoute route;
  LatticeSearchOptions search = options.search;
  search.end_straight = options.curve.end_straight;
  search.free_ends = options.curve.free_ends;
  preform::Options smoothing = smoothing_options(space, roadmap, options);
  LatticePath path;
  GlobalPaths paths, seeds;
  run_workers(std::min(2, thread_count(context.threads)), [&](int worker) {
    if (worker == 0) path = lattice_search(space, roadmap, lattice, options.ends, search, context);
    if (worker == 1 || thread_count(context.threads) == 1) paths = preform::global_search(space, roadmap, smoothing, context);
  });
  route.states = path.states;
  if (path.outcome == LatticePath::Outcome::found) {
    route.lattice_length = path.chain.length();
    seeds.paths.push_back(path.chain.curve().sampled(0.5 * roadmap.step()));
  }
  seeds.paths.insert(seeds.paths.end(), paths.paths.begin(), paths.paths.end());
  if (!context.stop() && !seeds.paths.empty() && smooth(space, smoothing, seeds, route, context)) return route;
  // Whatever leads there, however far around.
  smoothing.max_paths = more_paths;
  smoothing.max_detour = preform::Options().max_detour;
  if (!context.stop() && !paths.paths.empty()) paths = preform::global_search(space, roadmap, smoothing, context);
  if (!context.stop() && !paths.paths.empty() && smooth(space, smoothing, paths, route, context)) return route;
  if (path.outcome == LatticePath::Outcome::found && keep_chain(space, options, path, route)) return route;
  route.status = context.stop() ? NominalRoute::Status::stopped : NominalRoute::Status::infeasible;
  route.obstruction = obstruction_of(path, lattice, paths);
  return route;
}

}  // namespace tendril::routing
