// Refinement of really routed hoses between random places of the engine bay of over a million triangles (assets/engine_bay.ply
// beside the program): preformed, and straight with clips along its route. `gradient_share`: the median over the pairs of the
// seconds with exact gradients over those of the search without, both to the better objective but for a ten-thousandth.
// route_and_refine: nominal route and refinement together, after trees and field.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/routed_hoses.h"

namespace {

using namespace tendril;
using namespace tendril::bench;
using namespace tendril::routing;

/// Seconds from the first design looked at, whose equilibrium both solvers share.
double seconds_to(const RefinementResult& result, double goal) {
  for (const RefinementRecord& record : result.history)
    if (record.violation <= 5e-6 && record.objective <= goal) return record.seconds - result.history.front().seconds;
  return infinity;
}
double seconds_of(const RefinementResult& result) { return result.history.back().seconds - result.history.front().seconds; }

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
