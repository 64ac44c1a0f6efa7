// What a rod in contact asks of its surroundings, over the surface of 1 M triangles: closest points and contact terms
// of 60 points that touch it.
#include <benchmark/benchmark.h>

#include "bench/test_surface.h"
#include "geometry/surroundings.h"

using namespace tendril;

namespace {

constexpr double radius = 0.01;

const Surroundings& surroundings() {
  static const Surroundings built = [] {
    Surroundings field;
    field.add({std::make_shared<const TriangleSurface>(test_surface(1'000'000)), {}, 0});
    return field;
  }();
  return built;
}

// Points 0.2 mm deep in contact for a rod of 10 mm radius.
std::vector<Vec3> resting() {
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.2 + 0.006 * i, y = 0.1 + 0.008 * i;
    Vec3 p(x, y, ground_height(x, y) + 2 * radius);
    for (int k = 0; k < 50; ++k) p.z() -= surroundings().closest(p, 1).distance - 0.98 * radius;
    points.push_back(p);
  }
  return points;
}

void closest(benchmark::State& state) {
  const auto points = resting();
  for (auto _ : state)
    for (const Vec3& p : points) benchmark::DoNotOptimize(surroundings().closest(p, 0.1).distance);
  state.counters["per_point"] = benchmark::Counter(60, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(closest);

void terms(benchmark::State& state) {
  const auto points = resting();
  std::vector<DistanceTerm> out;
  surroundings().terms(points[0], radius, out);
  double count = 0;
  for (auto _ : state) {
    count = 0;
    for (const Vec3& p : points) {
      out.clear();
      surroundings().terms(p, radius, out);
      count += static_cast<double>(out.size()) / 60;
    }
  }
  state.counters["terms_a_point"] = count;
  state.counters["per_point"] = benchmark::Counter(60, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(terms);

}  // namespace
