// Nominal routing (method.route, step 1) in the engine bay of over a million triangles, after tree and field: ten random pairs of
// connections 0.6 to 1.3 m apart, object of 12 mm radius and 8 mm clearance, bends of 50 mm, grid of 20 mm; without a weight of
// clearance, and with one of 1 over 100 mm. Of each pair the fastest of the runs: the roadmap, the state lattice's search, paths
// and smoothing, as method.route does them for each of its weights; the lattice's search alone is in lattice_ms, the
// processor time of all threads in ..._processor_ms.
#include <benchmark/benchmark.h>

#include <ctime>
#include <limits>

#include "bench/bay_routes.h"
#include "method/route/nominal_routing.h"

namespace {

using namespace tendril;

constexpr double grid = 20e-3;
constexpr int pairs = 10;

/// As method.route asks it.
routing::FreeSpace space_between(const routing::Ends& ends, double weight) {
  routing::SpaceDemands demands = bench::bay_space();
  demands.clearance_weight = weight;
  const routing::PccDemands curve = bench::bay_curve();
  const double margin = 2 * curve.radii.front() + curve.end_straight + demands.radius + demands.clearance;
  return routing::FreeSpace(bench::engine_bay(), demands, {ends.start, ends.finish}, margin);
}

const std::vector<routing::Ends>& all_ends() {
  static const std::vector<routing::Ends> all = [] {
    const routing::FreeSpace space(bench::engine_bay(), bench::bay_space(), {}, 0.3);
    std::mt19937_64 random(5);
    std::vector<routing::Ends> ends;
    for (int i = 0; i < pairs; ++i) ends.push_back(bench::random_ends(space, random));
    return ends;
  }();
  return all;
}

double seconds_since(RunContext::Clock::time_point began) { return std::chrono::duration<double>(RunContext::Clock::now() - began).count(); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// The weight in tenths, and the threads.
void nominal(benchmark::State& state) {
  const double weight = 0.1 * static_cast<double>(state.range(0));
  RunContext context;
  context.threads = static_cast<int>(state.range(1));
  const routing::StateLattice lattice(grid, bench::bay_curve().radii.front(), 0.5 * grid);
  for (const routing::Ends& ends : all_ends()) space_between(ends, weight);  // tree and field
  std::vector<double> seconds(pairs, std::numeric_limits<double>::infinity()), lattices = seconds, processor = seconds;
  int found = 0;
  for (auto _ : state) {
    found = 0;
    for (int i = 0; i < pairs; ++i) {
      const std::clock_t began_processor = std::clock();
      const auto began = RunContext::Clock::now();
      const routing::FreeSpace space = space_between(all_ends()[i], weight);
      const routing::Roadmap roadmap(space, grid, context);
      routing::NominalOptions options;
      options.ends = all_ends()[i];
      options.curve = bench::bay_curve();
      const routing::NominalRoute route = routing::nominal_routing(space, roadmap, lattice, options, context);
      const double all = seconds_since(began);
      processor[i] = std::min(processor[i], double(std::clock() - began_processor) / CLOCKS_PER_SEC);
      const auto again = RunContext::Clock::now();
      routing::LatticeSearchOptions search;
      search.end_straight = options.curve.end_straight;
      benchmark::DoNotOptimize(routing::lattice_search(space, roadmap, lattice, options.ends, search, context).states);
      lattices[i] = std::min(lattices[i], seconds_since(again));
      found += route.status == routing::NominalRoute::Status::found;
      seconds[i] = std::min(seconds[i], all);
    }
  }
  state.counters["found"] = found;
  state.counters["median_ms"] = 1e3 * median(seconds);
  state.counters["median_processor_ms"] = 1e3 * median(processor);
  state.counters["worst_processor_ms"] = 1e3 * *std::max_element(processor.begin(), processor.end());
  state.counters["lattice_ms"] = 1e3 * median(lattices);
  state.counters["worst_ms"] = 1e3 * *std::max_element(seconds.begin(), seconds.end());
}

/// What a grid's step and a bend radius cost once.
void state_lattice(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(routing::StateLattice(grid, bench::bay_curve().radii.front(), 0.5 * grid).primitives());
}

}  // namespace

BENCHMARK(nominal)->ArgNames({"weight", "threads"})->Args({0, 2})->Args({10, 2})->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);
BENCHMARK(state_lattice)->Unit(benchmark::kMillisecond);
