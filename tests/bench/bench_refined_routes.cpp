// Refinement of really routed hoses between random places of the engine bay of over a million triangles (assets/engine_bay.ply
// beside the program): preformed, and straight with clips along its route. `gradient_share`: the median over the pairs of the
// seconds with exact gradients over those of the search without, both to the better objective but for a ten-thousandth.
// route_and_refine: nominal route and refinement together, after trees and field.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/bay_routes.h"
#include "method/route/clipped_design.h"
#include "method/route/route.h"

namespace {

using namespace tendril;
using namespace tendril::routing;

constexpr int pairs = 7;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gravity is off where only places are compared; here hoses hang.
const Scene& bay() {
  static const Scene scene = [] {
    Scene built{Vec3(0, 0, -9.81)};
    for (const PlacedObstacle& obstacle : bench::engine_bay().obstacles()) built.add(obstacle);
    return built;
  }();
  return scene;
}

/// Reinforced rubber, filled with water.
Section hose() { return Section::round(0.020, 0.012, Material::from_poisson(40e6, 0.45, 1700)); }

route::Options options_for(const Ends& ends, bool preformed) {
  route::Options options;
  options.from = Frame::looking(ends.start, ends.start_along);
  options.to = Frame::looking(ends.finish, ends.finish_along);
  options.section = hose();
  options.preformed = preformed;
  options.space.radius = options.section.radius();
  options.space.clearance = 0.005;
  options.curve = bench::bay_curve();
  options.curve.free_ends = 0.02;
  options.max_clips = 8;
  return options;
}

const std::vector<Ends>& ends() {
  static const std::vector<Ends> all = [] {
    SpaceDemands demands;
    demands.radius = hose().radius();
    demands.clearance = 0.005;
    const FreeSpace space(bay(), demands, {}, 0.22);
    std::mt19937_64 random(1);
    std::vector<Ends> found;
    for (int k = 0; k < pairs; ++k) found.push_back(bench::random_ends(space, random));
    return found;
  }();
  return all;
}

RefinementOptions demands_for(const route::Options& options) {
  RefinementOptions demands;
  demands.clearance_weight = 0.5;
  demands.min_bend_radius = 0.8 * options.curve.radii.front();
  demands.clearance = options.space.clearance;
  demands.free_ends = options.curve.free_ends;
  demands.adjust.from_tilt = demands.adjust.to_tilt = true;
  demands.adjust.clips = true;
  demands.most_clips = options.max_clips;
  return demands;
}

struct Task {
  Design design;
  RefinementOptions demands;
};

/// Where refinement begins: the nominal routes' designs, with the clips that they need.
std::vector<Task> tasks(bool preformed) {
  std::vector<Task> all;
  const RunContext context;
  for (const Ends& pair : ends()) {
    route::Options options = options_for(pair, preformed);
    options.refine = false;
    const route::Result nominal = route::run(bay(), options);
    if (nominal.routes.empty()) continue;
    Task task{nominal.routes.front().design, demands_for(options)};
    if (const auto clipped = clipped_along_way(SurroundingsByUse(bay(), task.demands), bay().gravity(), task.design, task.demands, context);
        clipped && clipped->found)
      task.design = clipped->design;
    task.demands.most_clips = 0;
    if (refine(bay(), task.design, task.demands).ok) all.push_back(task);
  }
  return all;
}

/// Seconds from the first design looked at, whose equilibrium both solvers share.
double seconds_to(const RefinementResult& result, double goal) {
  for (const RefinementRecord& record : result.history)
    if (record.violation <= 5e-6 && record.objective <= goal) return record.seconds - result.history.front().seconds;
  return infinity;
}
double seconds_of(const RefinementResult& result) { return result.history.back().seconds - result.history.front().seconds; }

double median(std::vector<double> values) {
  if (values.empty()) return infinity;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void against_gradient_free(benchmark::State& state) {
  static const std::vector<Task> by_kind[] = {tasks(false), tasks(true)};
  const std::vector<Task>& all = by_kind[state.range(0)];
  std::vector<double> shares, fast, slow, equilibria;
  for (auto _ : state) {
    shares = fast = slow = equilibria = {};
    for (const Task& task : all) {
      RefinementOptions without = task.demands;
      without.solver = RefinementSolver::gradient_free;
      without.max_evaluations = 5000;
      const RefinementResult a = refine(bay(), task.design, task.demands), b = refine(bay(), task.design, without);
      const double goal = std::min(a.objective, b.ok ? b.objective : infinity) * (1 + 1e-4);
      // A solver that never gets there needs at least as long as until it gave up.
      fast.push_back(seconds_to(a, goal));
      slow.push_back(std::min(seconds_to(b, goal), seconds_of(b)));
      shares.push_back(fast.back() / slow.back());
      equilibria.push_back(a.evaluations);
    }
  }
  state.counters["hoses"] = static_cast<double>(all.size());
  state.counters["gradient_share"] = median(shares);
  state.counters["worst_share"] = shares.empty() ? infinity : *std::max_element(shares.begin(), shares.end());
  state.counters["gradient_ms"] = 1e3 * median(fast);
  state.counters["free_ms"] = 1e3 * median(slow);
  state.counters["gradient_equilibria"] = median(equilibria);
}

void route_and_refine(benchmark::State& state) {
  std::vector<double> seconds;
  int kept = 0;
  for (auto _ : state) {
    seconds.clear();
    kept = 0;
    for (const Ends& pair : ends()) {
      const route::Result result = route::run(bay(), options_for(pair, state.range(0)));
      kept += result.ok;
      seconds.push_back(result.seconds - result.steps.front().seconds);
    }
  }
  state.counters["pairs"] = pairs;
  state.counters["kept"] = kept;
  state.counters["median_s"] = median(seconds);
  state.counters["worst_s"] = *std::max_element(seconds.begin(), seconds.end());
}

}  // namespace

BENCHMARK(against_gradient_free)->ArgName("preformed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(route_and_refine)->ArgName("preformed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);
