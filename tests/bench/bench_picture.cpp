// Seconds of a 1600 x 1200 sheet (three views and a card) over a surface of 1 M triangles, first cold: with loading the
// drawing module, OSMesa's context, shaders, mesh preparation and PNG, without the file's writing. Then what its parts
// cost.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "golden/picture_scenes.h"
#include "view/chart.h"
#include "view/prepared_mesh.h"

namespace {

using namespace tendril;

const Picture& fine_picture() {
  static const Picture picture = scenes::hose_over_fine_bay(1'000'000);
  return picture;
}

void draw(benchmark::State& state, const Picture& picture) {
  PictureReport report;
  for (auto _ : state) benchmark::DoNotOptimize(picture_png(picture, {}, &report).size());
  state.counters["triangles"] = static_cast<double>(report.triangles);
  state.counters["edges"] = static_cast<double>(report.edges);
  for (const PictureReport::Step& step : report.steps) state.counters[step.name + "_s"] = step.seconds;
}

// The first benchmark of the process, once: nothing is loaded yet.
void sheet_1M_cold(benchmark::State& state) { draw(state, fine_picture()); }
void sheet_1M_warm(benchmark::State& state) { draw(state, fine_picture()); }
void sheet_8k_warm(benchmark::State& state) { draw(state, scenes::hose_in_bay()); }

void prepare_mesh_1M(benchmark::State& state) {
  const PictureSurface& surface = fine_picture().surfaces.back();
  std::size_t edges = 0;
  for (auto _ : state) edges = prepare_mesh(surface, Vec3::Zero()).edges.size() / 2;
  state.counters["triangles"] = static_cast<double>(surface.triangles.size());
  state.counters["edges"] = static_cast<double>(edges);
}

void chart_lines_svg(benchmark::State& state) {
  Chart chart;
  chart.series = {{"series", {1, 2, 3}, {1, 4, 9}}};
  for (auto _ : state) save_chart(chart, (std::filesystem::temp_directory_path() / "tendril_bench_chart.svg").string());
}

}  // namespace

BENCHMARK(sheet_1M_cold)
    ->Setup([](const benchmark::State&) { fine_picture(); })
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(sheet_1M_warm)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(sheet_8k_warm)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(prepare_mesh_1M)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(chart_lines_svg)->Unit(benchmark::kMillisecond)->UseRealTime();
