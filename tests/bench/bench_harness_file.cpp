// A car's main harness from its KBL file: import, and rest under gravity from nothing. Without the file (TENDRIL_SHARED, or
// ../shared beside the source) the benchmarks say so.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "harness/import_harness.h"

namespace {

using namespace tendril;

std::string harness_file() {
  const char* folder = std::getenv("TENDRIL_SHARED");
  return (folder ? std::string(folder) : "../shared") + "/data/kbl/old_beetle_main.kbl";
}

bool missing(benchmark::State& state) {
  if (std::filesystem::exists(harness_file())) return false;
  state.SkipWithError("no harness file");
  return true;
}

HarnessImportOptions options_of(const benchmark::State& state) {
  HarnessImportOptions options;
  options.gravity = {0, 0, -9.81};
  if (state.range(0) > 0) options.slip = 0.01 * static_cast<double>(state.range(0));
  return options;
}

/// The first import of a process: nothing is in the caches.
void import_kbl_first(benchmark::State& state) {
  if (missing(state)) return;
  for (auto _ : state) {
    Scene scene;
    benchmark::DoNotOptimize(import_harness(read_harness(harness_file()), {}, scene).segments.data());
  }
}
BENCHMARK(import_kbl_first)->Unit(benchmark::kMillisecond)->Iterations(1);

void import_kbl(benchmark::State& state) {
  if (missing(state)) return;
  std::vector<double> off;
  for (auto _ : state) {
    Scene scene;
    const ImportedHarness harness = import_harness(read_harness(harness_file()), {}, scene);
    off.clear();
    for (const ImportedSegment& segment : harness.segments) off.push_back(std::abs(segment.length - segment.stated_length));
  }
  std::sort(off.begin(), off.end());
  state.counters["segments"] = static_cast<double>(off.size());
  state.counters["median_off_um"] = off.empty() ? NAN : 1e6 * off[off.size() / 2];
  state.counters["largest_off_um"] = off.empty() ? NAN : 1e6 * off.back();
}
BENCHMARK(import_kbl)->Unit(benchmark::kMillisecond);

/// Slip in per cent; 0: the default of bundles.
void settle(benchmark::State& state) {
  if (missing(state)) return;
  const HarnessImportOptions options = options_of(state);
  Scene scene(options.gravity);
  import_harness(read_harness(harness_file()), options, scene);
  SceneEquilibrium last;
  for (auto _ : state) last = scene.solve();
  if (!last.ok()) state.SkipWithError("not solved");
  state.counters["iterations"] = last.iterations();
  state.counters["fallbacks"] = last.rods.front().equilibrium.fallbacks;
  state.counters["residual_N"] = last.residual();
}
BENCHMARK(settle)->ArgName("slip")->Arg(0)->Arg(70)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
