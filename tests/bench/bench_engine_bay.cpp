// The main study's hose in the engine bay of over a million triangles (assets/engine_bay.ply beside the program): its
// equilibrium with the tree already built, cold and after a small change of a hold, and the reading of the file.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "geometry/import_mesh.h"
#include "scene/scene.h"

namespace {

using namespace tendril;

std::string bay_file() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets" / "engine_bay.ply").string();
}

Mesh read_bay() { return load_mesh(bay_file(), 1e-3).mesh; }

const std::shared_ptr<const TriangleSurface>& bay() {
  static const auto surface = std::make_shared<const TriangleSurface>(read_bay());
  return surface;
}

Scene hose_in_bay(const Vec3& shift, int segments) {
  Scene scene(Vec3(0, 0, -9.81));
  PlacedObstacle obstacle;
  obstacle.name = "bay";
  obstacle.body.shape = bay();
  scene.add(std::move(obstacle));
  const Section section = Section::round(0.023, 0.016, Material::from_poisson(6e6, 0.49, 2144));
  scene.add(PlacedRod("hose", Rod::uniform(0.72, section, segments), Frame::looking({0.326, 0.190, 0.500}, {0, 1, 0}),
                      Frame::looking(Vec3(0.478, 0.814, 0.440) + shift, {0, 1, 0})));
  return scene;
}

void report(benchmark::State& state, const SceneEquilibrium& eq) {
  if (!eq.ok()) state.SkipWithError(eq.message().c_str());
  state.counters["passes"] = eq.iterations();
  state.counters["penetration_um"] = 1e6 * eq.deepest_penetration();
}

void hose_in_bay_cold(benchmark::State& state) {
  const Scene scene = hose_in_bay(Vec3::Zero(), static_cast<int>(state.range(0)));
  SceneEquilibrium eq = scene.solve();
  for (auto _ : state) benchmark::DoNotOptimize(eq = scene.solve());
  report(state, eq);
}

void hose_in_bay_warm(benchmark::State& state) {
  const SceneEquilibrium before = hose_in_bay(Vec3::Zero(), 60).solve();
  const Scene scene = hose_in_bay({0.001, 0.001, 0}, 60);
  SceneEquilibrium eq = scene.solve({}, {}, &before);
  for (auto _ : state) benchmark::DoNotOptimize(eq = scene.solve({}, {}, &before));
  report(state, eq);
}

void read_engine_bay(benchmark::State& state) {
  for (auto _ : state) {
    const Mesh mesh = read_bay();
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  }
}

}  // namespace

BENCHMARK(hose_in_bay_cold)->Arg(60)->Unit(benchmark::kMillisecond);
BENCHMARK(hose_in_bay_warm)->Unit(benchmark::kMillisecond);
BENCHMARK(read_engine_bay)->Unit(benchmark::kMillisecond)->UseRealTime();
