// Local optimisation of candidates in the engine bay of over a million triangles: what one descent, one certified candidate with
// its repair, and one polish cost. The candidates are those of method.preform's own first two steps for random pairs of places.
#include <benchmark/benchmark.h>

#include "bench/bay_routes.h"
#include "method/preform/pcc_optimization.h"

namespace {

using namespace tendril;
using namespace tendril::preform;

struct Pair {
  Options options;
  std::vector<Candidate> candidates;
};

struct Case {
  std::unique_ptr<FreeSpace> space;
  std::vector<Pair> pairs;
  std::size_t candidates = 0;
};

const Case& candidates_in_bay() {
  static const Case made = [] {
    std::mt19937_64 random(4);
    Case c;
    c.space = std::make_unique<FreeSpace>(bench::engine_bay(), bench::bay_space(), std::vector<Vec3>(), 0.2);
    while (c.pairs.size() < 6) {
      Pair pair;
      pair.options.ends = bench::random_ends(*c.space, random);
      pair.options.space = bench::bay_space();
      pair.options.curve = bench::bay_curve();
      const GlobalPaths paths = global_search(*c.space, pair.options);
      if (paths.paths.empty()) continue;
      pair.candidates = pcc_sampling(*c.space, pair.options, paths);
      c.candidates += pair.candidates.size();
      c.pairs.push_back(pair);
    }
    return c;
  }();
  return made;
}

RunContext one_thread() {
  RunContext context;
  context.threads = 1;
  return context;
}

benchmark::Counter each(std::size_t count) {
  return benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void descent_in_bay(benchmark::State& state) {
  const Case& c = candidates_in_bay();
  double queries = 0, iterations = 0;
  for (auto _ : state) {
    queries = iterations = 0;
    for (const Pair& pair : c.pairs)
      for (const Candidate& candidate : pair.candidates) {
        const routing::DescentResult result = descend(*c.space, pair.options.curve, pair.options.ends, candidate.points);
        queries += result.queries;
        iterations += result.iterations;
      }
  }
  state.counters["per_candidate"] = each(c.candidates);
  state.counters["candidates"] = static_cast<double>(c.candidates);
  state.counters["queries"] = queries / static_cast<double>(c.candidates);
  state.counters["iterations"] = iterations / static_cast<double>(c.candidates);
}
BENCHMARK(descent_in_bay)->Unit(benchmark::kMillisecond);

void optimization_in_bay(benchmark::State& state) {
  const Case& c = candidates_in_bay();
  double feasible = 0, shortest = 0;
  for (auto _ : state) {
    feasible = shortest = 0;
    for (const Pair& pair : c.pairs) {
      double best = 10;
      for (const Optimized& one : pcc_optimization(*c.space, pair.options, pair.candidates, one_thread())) {
        if (!one.violations.empty()) continue;
        ++feasible;
        best = std::min(best, one.length);
      }
      shortest += best;
    }
  }
  state.counters["per_candidate"] = each(c.candidates);
  state.counters["feasible"] = feasible / static_cast<double>(c.candidates);
  state.counters["shortest_m"] = shortest;  // summed over the pairs
}
BENCHMARK(optimization_in_bay)->Unit(benchmark::kMillisecond);

/// Only the shortest feasible hose of each pair.
void polish_in_bay(benchmark::State& state) {
  const Case& c = candidates_in_bay();
  std::vector<std::vector<Optimized>> best;
  for (const Pair& pair : c.pairs) {
    std::vector<Optimized> all = pcc_optimization(*c.space, pair.options, pair.candidates, one_thread());
    std::erase_if(all, [](const Optimized& one) { return !one.violations.empty(); });
    const auto shortest = std::min_element(all.begin(), all.end(), [](const Optimized& a, const Optimized& b) { return a.length < b.length; });
    if (shortest != all.end()) best.push_back({*shortest});
    else best.push_back({});
  }
  double gained = 0;
  for (auto _ : state) {
    gained = 0;
    for (std::size_t i = 0; i < best.size(); ++i) {
      std::vector<Optimized> curves = best[i];
      polish(*c.space, c.pairs[i].options, curves, one_thread());
      if (!curves.empty()) gained += 100 * (1 - curves[0].length / best[i][0].length) / static_cast<double>(best.size());
    }
  }
  state.counters["per_curve"] = each(best.size());
  state.counters["shorter_by_percent"] = gained;
}
BENCHMARK(polish_in_bay)->Unit(benchmark::kMillisecond);

void sampling_in_bay(benchmark::State& state) {
  const Case& c = candidates_in_bay();
  std::vector<GlobalPaths> paths;
  for (const Pair& pair : c.pairs) paths.push_back(global_search(*c.space, pair.options));
  for (auto _ : state)
    for (std::size_t i = 0; i < paths.size(); ++i) benchmark::DoNotOptimize(pcc_sampling(*c.space, c.pairs[i].options, paths[i], one_thread()));
  state.counters["per_pair"] = each(c.pairs.size());
}
BENCHMARK(sampling_in_bay)->Unit(benchmark::kMillisecond);

}  // namespace
