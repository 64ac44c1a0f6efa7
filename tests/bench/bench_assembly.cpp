// Assembly verification: a hose over more than a million triangles, the ignition harness in the engine bay, and combs of ever more
// rods over a floor, each found and proven by its forward play, not optimised. Counters: attempts, steps played, ms per rod.
#include <benchmark/benchmark.h>

#include "bench/bay_harness.h"
#include "unit/method/assembly_scenes.h"

namespace {

using namespace tendril;

void installed(benchmark::State& state, const Scene& scene, assembly::Options options, int attempts) {
  options.optimise = false;
  options.attempts = attempts;
  assembly::Result result = assembly::run(scene, options);  // trees are built
  double seconds = 0;
  for (auto _ : state) {
    result = assembly::run(scene, options);
    seconds += result.seconds;
  }
  if (!result.ok) state.SkipWithError(result.message.c_str());
  state.counters["attempts"] = static_cast<double>(result.attempts.size());
  state.counters["steps"] = result.proof.steps;
  state.counters["ms_per_rod"] = 1e3 * seconds / static_cast<double>(state.iterations()) / static_cast<double>(scene.rods().size());
}

void hose_over_terrain(benchmark::State& state) {
  static const auto ground = std::make_shared<const TriangleSurface>(assembly_scenes::hills(1'160'000));
  const assembly_scenes::Case c = assembly_scenes::terrain(1, ground);
  installed(state, c.scene, c.options, 1);
}

void harness_in_bay(benchmark::State& state) {
  const BayHarness h = bay_harness();
  installed(state, h.scene, h.options, 12);
}

/// A spine along x with teeth along y, held at both ends and at all tips: 2 teeth + 1 rods.
Scene comb(int teeth) {
  constexpr double step = 0.1, height = 0.05, length = 0.15;
  const Section cable = Section::round(0.012, 0, Material::from_poisson(3e7, 0.4, 1500));
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(assembly_scenes::obstacle("floor", HalfSpace{}));
  const auto along_x = [&](int k) { return Frame::looking({k * step, 0, height}, Vec3::UnitX()); };
  std::vector<PlacedRod*> spine;
  for (int k = 0; k <= teeth; ++k)
    spine.push_back(&scene.add(PlacedRod("spine " + std::to_string(k + 1), Rod::uniform(step, cable, 8), along_x(k), along_x(k + 1))));
  for (int k = 1; k <= teeth; ++k) {
    const Frame root = Frame::looking({k * step, 0, height}, Vec3::UnitY()), tip = Frame::looking({k * step, length, height}, Vec3::UnitY());
    PlacedRod& tooth = scene.add(PlacedRod("tooth " + std::to_string(k), Rod::uniform(1.01 * length, cable, 10), root, tip));
    const Frame relative{Vec3::Zero(), along_x(k).rotation.conjugate() * root.rotation};
    scene.join("junction " + std::to_string(k), {{spine[k - 1], step, {}}, {spine[k], 0, {}}, {&tooth, 0, relative}}, std::nullopt);
  }
  return scene;
}

void comb_over_floor(benchmark::State& state) { installed(state, comb((static_cast<int>(state.range(0)) - 1) / 2), {}, 12); }

}  // namespace

BENCHMARK(hose_over_terrain)->Unit(benchmark::kMillisecond);
BENCHMARK(harness_in_bay)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(comb_over_floor)->Arg(5)->Arg(11)->Arg(21)->Arg(51)->Arg(101)->Unit(benchmark::kMillisecond)->Iterations(1);
