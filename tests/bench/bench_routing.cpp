// What routing asks of space, in the engine bay of over a million triangles (assets/engine_bay.ply beside the program): trees and
// the field of distances, once a scene; then for an object of 12 mm radius and 8 mm clearance yes-or-no distances, the roadmap and
// the paths between six random pairs of connections 0.65 to 1.3 m apart.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <limits>
#include <random>

#include "geometry/import_mesh.h"
#include "method/free_space/bottleneck.h"
#include "method/free_space/roadmap.h"
#include "method/preform/global_search.h"

namespace {

using namespace tendril;

const Mesh& bay_mesh() {
  static const Mesh mesh =
      load_mesh((std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets" / "engine_bay.ply").string(), 1e-3).mesh;
  return mesh;
}

const std::shared_ptr<const TriangleSurface>& bay() {
  static const auto surface = std::make_shared<const TriangleSurface>(bay_mesh());
  return surface;
}

Scene scene_with(std::shared_ptr<const TriangleSurface> surface) {
  Scene scene;
  PlacedObstacle obstacle;
  obstacle.name = "bay";
  obstacle.body.shape = std::move(surface);
  scene.add(std::move(obstacle));
  return scene;
}

const Scene& bay_scene() {
  static const Scene scene = scene_with(bay());
  return scene;
}

routing::SpaceDemands demands() {
  routing::SpaceDemands result;
  result.radius = 0.012;
  result.clearance = 0.008;
  return result;
}

constexpr double margin = 0.22;

const routing::FreeSpace& bay_space() {
  static const routing::FreeSpace space(bay_scene(), demands(), {}, margin);
  return space;
}

std::vector<Vec3> places(int count) {
  const Eigen::AlignedBox3d box = bay()->box();
  std::mt19937 engine(1);
  std::uniform_real_distribution<> share(0, 1);
  std::vector<Vec3> all(count);
  for (Vec3& p : all)
    for (int k = 0; k < 3; ++k) p[k] = box.min()[k] + share(engine) * box.sizes()[k];
  return all;
}

/// Within the bay, each end with 70 mm of free straight before it.
std::vector<preform::Options> pairs() {
  std::mt19937 engine(5);
  std::uniform_real_distribution<> share(0, 1);
  std::normal_distribution<> normal;
  const Eigen::AlignedBox3d box = bay()->box();
  const auto end = [&](Vec3& at, Vec3& along) {
    do {
      for (int k = 0; k < 3; ++k) at[k] = box.min()[k] + share(engine) * box.sizes()[k];
      along = Vec3(normal(engine), normal(engine), normal(engine)).normalized();
    } while (!bay_space().is_free(at, Vec3(at + 0.07 * along)));
  };
  std::vector<preform::Options> all;
  while (all.size() < 6) {
    preform::Options options;
    end(options.ends.start, options.ends.start_along);
    end(options.ends.finish, options.ends.finish_along);
    options.ends.finish_along *= -1;
    const double apart = (options.ends.finish - options.ends.start).norm();
    options.space = demands();
    options.curve.radii = {0.05};
    options.curve.min_straight = options.curve.end_straight = 0.02;
    if (apart > 0.65 && apart < 1.3) all.push_back(options);
  }
  return all;
}

/// What a scene pays once, on all cores.
void tree_and_field(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    const Scene scene = scene_with(std::make_shared<const TriangleSurface>(bay_mesh()));
    state.ResumeTiming();
    const routing::FreeSpace space(scene, demands(), {}, margin);
    benchmark::DoNotOptimize(space.bounds(Vec3::Zero()).low);
  }
  state.counters["triangles"] = static_cast<double>(bay_mesh().triangles.size());
}

Eigen::AlignedBox3d field_box() {
  Eigen::AlignedBox3d box = bay()->box();
  box.min().array() -= 0.1;
  box.max().array() += 0.1;
  return box;
}

void field(benchmark::State& state) {
  const Surroundings& surroundings = *bay_scene().surroundings();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = DistanceField(surroundings, field_box(), 1e-3 * static_cast<double>(state.range(0))).bytes();
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

/// By a hose's tube of 40,000 triangles.
void field_extended(benchmark::State& state) {
  const DistanceField known(*bay_scene().surroundings(), field_box(), 5e-3);
  Mesh tube;
  constexpr int around = 40, along = 500;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double turn = 2 * 3.141592653589793 * i / around;
      tube.vertices.push_back({1.2 * j / along + 0.1, 0.4 + 0.012 * std::cos(turn), 0.5 + 0.1 * std::sin(5.0 * j / along) + 0.012 * std::sin(turn)});
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      tube.triangles.push_back({a, b, b + around});
      tube.triangles.push_back({a, b + around, a + around});
    }
  Surroundings more = *bay_scene().surroundings();
  more.add({std::make_shared<const TriangleSurface>(std::move(tube)), {}, 0});
  for (auto _ : state) benchmark::DoNotOptimize(DistanceField(known, more).bytes());
}

const auto per_place = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;

void closest_within_20mm(benchmark::State& state) {
  const std::vector<Vec3> all = places(10000);
  bay()->tree();
  for (auto _ : state)
    for (const Vec3& p : all) benchmark::DoNotOptimize(bay()->tree().closest(p, 0.02).triangle);
  state.counters["per_place"] = benchmark::Counter(static_cast<double>(all.size()), per_place);
}

void within_20mm(benchmark::State& state) {
  const std::vector<Vec3> all = places(10000);
  bay()->tree();
  for (auto _ : state)
    for (const Vec3& p : all) benchmark::DoNotOptimize(bay()->tree().within(p, 0.02));
  state.counters["per_place"] = benchmark::Counter(static_cast<double>(all.size()), per_place);
}

/// The field first; `asked` is the share of places where the tree had to be asked.
void is_free(benchmark::State& state) {
  const std::vector<Vec3> all = places(10000);
  const routing::FreeSpace& space = bay_space();
  for (auto _ : state)
    for (const Vec3& p : all) benchmark::DoNotOptimize(space.is_free(p));
  double asked = 0;
  for (const Vec3& p : all) {
    const DistanceField::Bounds bounds = space.bounds(p);
    asked += bounds.low < 0 && bounds.high >= 0;
  }
  state.counters["asked"] = asked / static_cast<double>(all.size());
  state.counters["per_place"] = benchmark::Counter(static_cast<double>(all.size()), per_place);
}

/// Straights of 0.1 m.
void is_free_straight(benchmark::State& state) {
  const std::vector<Vec3> all = places(2000);
  for (auto _ : state)
    for (std::size_t i = 0; i < all.size(); ++i)
      benchmark::DoNotOptimize(bay_space().is_free(all[i], Vec3(all[i] + 0.1 * Vec3::Unit(i % 3))));
  state.counters["per_place"] = benchmark::Counter(static_cast<double>(all.size()), per_place);
}

void roadmap(benchmark::State& state) {
  const routing::FreeSpace& space = bay_space();
  long nodes = 0, free = 0;
  for (auto _ : state) {
    const routing::Roadmap roadmap(space, 1e-3 * static_cast<double>(state.range(0)));
    nodes = roadmap.nodes();
    free = roadmap.free_nodes();
  }
  state.counters["nodes"] = static_cast<double>(nodes);
  state.counters["free"] = static_cast<double>(free);
}

/// One of the six pairs after the other; a pair's mean.
void paths(benchmark::State& state) {
  const std::vector<preform::Options> all = pairs();
  double count = 0, longest = 0;
  for (auto _ : state) {
    count = 0;
    for (preform::Options options : all) {
      options.grid = 1e-3 * static_cast<double>(state.range(0));
      const auto began = RunContext::Clock::now();
      count += static_cast<double>(preform::global_search(bay_space(), options).paths.size());
      longest = std::max(longest, std::chrono::duration<double>(RunContext::Clock::now() - began).count());
    }
  }
  state.counters["paths_a_pair"] = count / static_cast<double>(all.size());
  state.counters["worst_ms"] = 1e3 * longest;
  state.counters["per_pair"] = benchmark::Counter(static_cast<double>(all.size()), per_place);
}

/// What it takes to say what an object that is too thick lacks.
void bottleneck(benchmark::State& state) {
  const std::vector<preform::Options> all = pairs();
  routing::SpaceDemands thick = demands();
  thick.clearance = 0.09;
  const routing::FreeSpace space(bay_scene(), thick, {}, margin);
  double lets_through = 0;
  for (auto _ : state)
    lets_through = routing::bottleneck_between(space, all[0].ends.start, all[0].ends.finish, 0.02).lets_through;
  state.counters["lets_through_mm"] = 1e3 * lets_through;
}

}  // namespace

BENCHMARK(tree_and_field)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2);
BENCHMARK(field)->Arg(5)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(field_extended)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(closest_within_20mm);
BENCHMARK(within_20mm);
BENCHMARK(is_free);
BENCHMARK(is_free_straight);
BENCHMARK(roadmap)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(paths)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bottleneck)->Unit(benchmark::kMillisecond)->UseRealTime();
