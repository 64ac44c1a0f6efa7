// The two formulations of paths for dress packs on the same cases: builtin:six_axis with a hose of 1.6 m from its upper arm to its hand, 16
// elements, 8 via points, 40 time steps, no obstacles; the paths of bench_dress_pack.cpp. Counters: objective before and after, iterations
// (reduced: of the trust region; direct: of Ipopt), rounds of the direct one, seconds of the search alone, and the largest violation: of
// equilibrium for the reduced formulation (N, or N m over length, on the path that was found), of all equations and limits for the direct
// one (scaled: direct.h). `starts`: the reduced search from 16 starts; how many come within 5 % of the best.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "method/dress_pack/direct.h"
#include "method/dress_pack/multi_start.h"
#include "robot/load_robot.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::dress_pack;
using tendril::test::degrees;

namespace {

enum Case { problematic, taut, easy };

PackProblem six_axis_hose() {
  PackProblem pack;
  pack.robot = load_robot("builtin:six_axis");
  pack.rods = {test::hose(1.6, 16)};
  pack.attachments = {{0, 0, pack.robot->link("link_2"), Frame::looking({0.05, 0.2, 0.75}, {1, 0, 1}, {0, 0, 1})},
                      {0, 1, pack.robot->link("link_6"), Frame::looking({0.05, 0, 0.15}, {1, 0, 0}, {0, 0, 1})}};
  return pack;
}

JointPath path_of(int which) {
  const JointVector start = degrees({0, 0, 0, 0, 0, 0});
  if (which == problematic) return JointPath({start, degrees({30, 10, -80, 80, 45, 25}), degrees({60, 0, -10, 160, 0, 50})}).resampled(8);
  if (which == taut) return JointPath({start, degrees({30, 10, -75, 20, 40, 0}), degrees({60, 0, 0, 0, 0, 0})}).resampled(8);
  return JointPath({start, degrees({30, 5, -20, 20, 10, 10}), degrees({60, 0, 0, 40, 0, 0})}).resampled(8);
}

ReducedOptions options_of() {
  ReducedOptions options;
  options.demands.force = {50, 50};
  options.demands.twist = {2, 0.5};
  options.demands.curvature = {8, 2};
  return options;
}

void count(benchmark::State& run, const ReducedResult& found, double violation) {
  if (!found.ok()) run.SkipWithError(found.message.c_str());
  run.counters["f_before"] = found.objective_before;
  run.counters["f"] = found.objective;
  run.counters["iterations"] = found.iterations;
  run.counters["search_s"] = found.search_seconds;
  run.counters["violation"] = violation;
}

void reduced(benchmark::State& run) {
  const PackProblem pack = six_axis_hose();
  ReducedResult found;
  for (auto _ : run) found = optimise(pack, path_of(static_cast<int>(run.range(0))), options_of());
  double residual = 0;
  for (const PackStep& step : found.after.steps) residual = std::max(residual, step.residual);
  count(run, found, residual);
}

void direct(benchmark::State& run) {
  const PackProblem pack = six_axis_hose();
  DirectResult found;
  for (auto _ : run) found = optimise_direct(pack, path_of(static_cast<int>(run.range(0))), options_of());
  count(run, found, found.violation);
  run.counters["rounds"] = static_cast<double>(found.history.size());
  run.counters["variables"] = found.variables;
}
BENCHMARK(reduced)->ArgName("path")->Arg(easy)->Arg(taut)->Arg(problematic)->Unit(benchmark::kSecond)->Iterations(3);
BENCHMARK(direct)->ArgName("path")->Arg(easy)->Arg(taut)->Arg(problematic)->Unit(benchmark::kSecond)->Iterations(1);

void starts(benchmark::State& run) {
  const PackProblem pack = six_axis_hose();
  MultiStartOptions options;
  options.search = options_of();
  options.starts = 16;
  MultiStartResult found;
  for (auto _ : run) found = optimise_from_starts(pack, path_of(static_cast<int>(run.range(0))), options);
  count(run, found, 0);
  run.counters["f_given"] = found.starts[0].objective;
  run.counters["near_best"] =
      static_cast<double>(std::count_if(found.starts.begin(), found.starts.end(), [&](const StartReport& one) { return one.objective < 1.05 * found.objective; }));
}
BENCHMARK(starts)->ArgName("path")->Arg(taut)->Arg(problematic)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
