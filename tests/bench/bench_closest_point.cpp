// Queries against a surface of 1 M triangles: a chain of 60 points about 20 mm above it, as a hose would ask them.
#include <benchmark/benchmark.h>

#include "bench/test_surface.h"
#include "geometry/distance_tree.h"

using namespace tendril;

namespace {

const Mesh& surface() {
  static const Mesh mesh = test_surface(1'000'000);
  return mesh;
}

const DistanceTree& tree() {
  static const DistanceTree built(surface());
  return built;
}

// Hoses of 60 points, 10 mm apart, winding over the ground 20 mm above it.
std::vector<std::vector<Vec3>> chains(int count) {
  std::vector<std::vector<Vec3>> all(count);
  for (int c = 0; c < count; ++c)
    for (int i = 0; i < 60; ++i) {
      const double x = 0.2 + 0.04 * c + 0.006 * i, y = 0.1 + 0.008 * i + 0.02 * c;
      all[c].push_back({x, y, ground_height(x, y) + 0.02});
    }
  return all;
}

// One hose is asked for again and again, as by a solver; sixteen in turn find the caches cold.
void closest_of_chain(benchmark::State& state) {
  const auto hoses = chains(static_cast<int>(state.range(0)));
  const bool hinted = state.range(1) != 0;
  tree();
  std::size_t next = 0;
  for (auto _ : state) {
    int hint = -1;
    for (const Vec3& p : hoses[next]) {
      const auto nearest = tree().closest(p, std::numeric_limits<double>::infinity(), hinted ? hint : -1);
      hint = nearest.triangle;
      benchmark::DoNotOptimize(hint);
    }
    next = (next + 1) % hoses.size();
  }
  state.counters["per_point"] = benchmark::Counter(60, benchmark::Counter::kIsIterationInvariantRate |
                                                           benchmark::Counter::kInvert);
  state.counters["triangles"] = static_cast<double>(surface().triangles.size());
}
BENCHMARK(closest_of_chain)->ArgNames({"hoses", "hinted"})->ArgsProduct({{1, 16}, {0, 1}});

void ray_along_chain(benchmark::State& state) {
  const auto hoses = chains(16);
  std::size_t next = 0;
  tree();
  for (auto _ : state) {
    const auto& hose = hoses[next];
    for (std::size_t i = 0; i + 1 < hose.size(); ++i) benchmark::DoNotOptimize(tree().ray(hose[i], hose[i + 1]));
    next = (next + 1) % hoses.size();
  }
  state.counters["per_ray"] = benchmark::Counter(59, benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}
BENCHMARK(ray_along_chain);

void build_tree(benchmark::State& state) {
  surface();
  for (auto _ : state) {
    const DistanceTree built(surface());
    state.counters["MB"] = static_cast<double>(built.bytes()) / 1e6;
  }
}
BENCHMARK(build_tree)->Unit(benchmark::kMillisecond);

}  // namespace
