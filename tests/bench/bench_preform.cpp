// method.preform as a whole in the engine bay of over a million triangles: sets of alternatives between five pairs of connections,
// on two threads. Counters: milliseconds of each step, hoses, passages, the length of the shortest one.
#include <benchmark/benchmark.h>

#include "base/units.h"
#include "bench/bay_routes.h"
#include "method/preform/preform.h"

namespace {

using namespace tendril;
using namespace tendril::preform;

struct Connections {
  const char* name;
  Vec3 start, start_along, finish, finish_along;
};
const Connections connections[] = {
    {"heater feed", {0.326, 0.190, 0.500}, {0, 1, 0}, {0.478, 0.814, 0.440}, {0, 1, 0}},
    {"heater return", {0.558, 0.814, 0.440}, {0, -1, 0}, {0.486, 0.470, 0.472}, {1, 0, 0}},
    {"radiator to heater", {0.326, 0.190, 0.500}, {0, 1, 0}, {0.558, 0.814, 0.440}, {0, 1, 0}},
    {"thermostat to heater", {0.486, 0.470, 0.472}, {-1, 0, 0}, {0.478, 0.814, 0.440}, {0, 1, 0}},
    {"front to firewall", {0.360, 0.235, 0.560}, {0, 1, 0}, {0.400, 0.740, 0.500}, {0, 1, 0}},
};

/// Of a coolant hose of 23 mm.
Options between(const Connections& c) {
  Options options;
  options.ends.start = c.start;
  options.ends.start_along = c.start_along;
  options.ends.finish = c.finish;
  options.ends.finish_along = c.finish_along;
  options.space.radius = 11.5 * units::mm;
  options.space.clearance = 8 * units::mm;
  options.curve.radii = {45 * units::mm};
  options.curve.min_straight = options.curve.end_straight = 15 * units::mm;
  options.curve.free_ends = 40 * units::mm;
  return options;
}

RunContext two_threads() {
  RunContext context;
  context.threads = 2;
  return context;
}

void report(benchmark::State& state, const Result& result, double runs) {
  for (const MethodStep& step : result.steps) state.counters[step.name + "_ms"] += 1e3 * step.seconds / runs;
}

/// The first call in a scene; `after_field_ms` is what it takes once the tree and the field are there.
void first_hoses(benchmark::State& state) {
  const Mesh mesh = std::get<std::shared_ptr<const TriangleSurface>>(bench::engine_bay().obstacles().front().body.shape)->mesh();
  double after_field = std::numeric_limits<double>::infinity();
  Result result;
  for (auto _ : state) {
    state.PauseTiming();
    PlacedObstacle bay;
    bay.name = "bay";
    bay.body.shape = std::make_shared<const TriangleSurface>(mesh);
    Scene scene;
    scene.add(std::move(bay));
    state.ResumeTiming();
    result = run(scene, between(connections[0]), two_threads());
    after_field = std::min(after_field, result.seconds - result.steps.front().seconds);
  }
  if (!result.ok) return state.SkipWithError(result.message.c_str());
  report(state, result, 1);
  state.counters["after_field_ms"] = 1e3 * after_field;
}

/// One pair of connections in a scene where the field is known.
void hoses(benchmark::State& state) {
  const Connections& pair = connections[state.range(0)];
  const Options options = between(pair);
  static const bool known = run(bench::engine_bay(), between(connections[0]), two_threads()).ok;
  if (!known) return state.SkipWithError("no hose");
  Result result;
  for (auto _ : state) result = run(bench::engine_bay(), options, two_threads());
  if (!result.ok) return state.SkipWithError(result.message.c_str());
  report(state, result, 1);
  state.counters["hoses"] = static_cast<double>(result.hoses.size());
  state.counters["passages"] = result.passages;
  state.counters["best_mm"] = 1e3 * result.hoses.front().length;
  state.SetLabel(pair.name);
}

/// All five after one another; a pair's mean.
void hoses_of_five(benchmark::State& state) {
  const auto per_pair = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  double runs = 0;
  std::vector<Result> all;
  for (auto _ : state) {
    for (const Connections& pair : connections) all.push_back(run(bench::engine_bay(), between(pair), two_threads()));
    ++runs;
  }
  for (const Result& result : all) {
    if (!result.ok) return state.SkipWithError(result.message.c_str());
    report(state, result, static_cast<double>(all.size()));
    state.counters["hoses_each"] += static_cast<double>(result.hoses.size()) / static_cast<double>(all.size());
  }
  state.counters["per_pair"] = benchmark::Counter(static_cast<double>(std::size(connections)), per_pair);
}

}  // namespace

BENCHMARK(first_hoses)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()->Iterations(2);
BENCHMARK(hoses)->DenseRange(0, std::size(connections) - 1)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(hoses_of_five)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
