// What a scene does not use must cost nothing: the same hose without and with gravity, an obstacle out of reach, and one
// that it rests on. `trees_ms` is the time for distance trees: 0 where none is built.
#include <benchmark/benchmark.h>

#include "scene/scene.h"

namespace {

using namespace tendril;

enum Content { bare = 0, weight = 1, far_mesh = 2, floor_mesh = 4 };

// A square sheet of 2 n^2 triangles, 2 m wide, at height z.
std::shared_ptr<const TriangleSurface> sheet(int n, double z) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.emplace_back(2.0 * i / n - 0.5, 2.0 * j / n - 1, z);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return std::make_shared<const TriangleSurface>(std::move(mesh));
}

Scene scene_with(int content) {
  Scene scene(content & weight ? Vec3(0, 0, -9.81) : Vec3::Zero());
  const Section section = Section::round(0.02, 0.012, Material::from_poisson(6e6, 0.49, 1150));
  const Frame from = Frame::looking({0, 0, 0}, {1, 0, 0.3}), to = Frame::looking({0.8, 0.1, 0}, {1, 0, -0.3});
  scene.add(PlacedRod("hose", Rod::uniform(1, section, 60), from, to));
  const auto add = [&](const char* name, double z) {
    PlacedObstacle obstacle;
    obstacle.name = name;
    obstacle.body.shape = sheet(400, z);
    scene.add(std::move(obstacle));
  };
  if (content & far_mesh) add("far", -20);
  if (content & floor_mesh) add("floor", -0.05);
  return scene;
}

void solve_scene(benchmark::State& state) {
  const Scene scene = scene_with(static_cast<int>(state.range(0)));
  const SceneEquilibrium first = scene.solve();
  if (!first.ok()) {
    state.SkipWithError(first.message().c_str());
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(scene.solve().seconds);
  state.counters["iterations"] = first.iterations();
  state.counters["trees_ms"] = 1e3 * first.seconds_for_trees;
  state.SetLabel(state.range(0) == bare                       ? "neither gravity nor obstacles"
                 : state.range(0) == weight                   ? "gravity"
                 : state.range(0) == (weight | far_mesh)      ? "gravity, 320,000 triangles out of reach"
                                                              : "gravity, resting on 320,000 triangles");
}

}  // namespace

BENCHMARK(solve_scene)->Arg(bare)->Arg(weight)->Arg(weight | far_mesh)->Arg(weight | floor_mesh)->Unit(benchmark::kMicrosecond);
