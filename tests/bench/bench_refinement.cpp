// Local refinement: with exact gradients against a search without derivatives to the same objective value (`gradient_share`: of
// the seconds; where the search ends on a ridge, as it does with clips, of those until it gave up), and a hose in the engine bay
// of over a million triangles (assets/engine_bay.ply beside the program), trees already built.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

#include "geometry/import_mesh.h"
#include "method/route/local_refinement.h"

namespace {

using namespace tendril;
using namespace tendril::routing;

Section soft_hose() { return Section::round(0.020, 0.012, Material::from_poisson(6e6, 0.49, 1150)); }

PlacedObstacle solid(const char* name, const Solid& shape, const Vec3& at, double clearance) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = shape;
  obstacle.body.pose.at = at;
  obstacle.clearance = clearance;
  return obstacle;
}

struct Task {
  Scene scene{Vec3(0, 0, -9.81)};
  Design design;
  RefinementOptions options;
};

/// A hose that hangs in a U over a floor beside a post; length and both connections' tilts.
Task hanging() {
  Task task;
  task.scene.add(solid("floor", HalfSpace{}, Vec3::Zero(), 0.02));
  task.scene.add(solid("post", Cylinder{0.04, 0.8}, {0.15, 0.08, 0.4}, 0.02));
  task.design.rod = Rod::uniform(0.8, soft_hose(), 40);
  task.design.from = Frame::looking({0, 0, 0.4}, {0, 0, -1}, {0, 1, 0});
  task.design.to = Frame::looking({0.3, 0, 0.4}, {0, 0, 1}, {0, 1, 0});
  task.options.min_bend_radius = 0.08;
  task.options.clearance_weight = 0.3;
  task.options.adjust.from_tilt = task.options.adjust.to_tilt = true;
  return task;
}

/// A hose over two clips, whose places along it are adjusted too.
Task clipped() {
  Task task;
  task.scene.add(solid("floor", HalfSpace{}, {0, 0, 0.1}, 0.02));
  task.design.rod = Rod::uniform(1.05, soft_hose(), 50);
  task.design.from = Frame::looking({0, 0, 0.25}, {0.3, 0, 1});
  task.design.to = Frame::looking({0.8, 0.1, 0.3}, {0.3, 0.2, -1});
  task.design.clips = {Hold{0.33, Frame::looking({0.26, 0.05, 0.28}, {1, 0, 0})}, Hold{0.66, Frame::looking({0.52, 0, 0.3}, {1, 0.1, 0})}};
  task.options.min_bend_radius = 0.05;
  task.options.adjust.clips = true;
  return task;
}

/// The main study's hose, 8 mm clear of the bay but for the last 5 cm at its connections.
Task in_bay(bool tilts) {
  static const auto surface = std::make_shared<const TriangleSurface>(
      load_mesh((std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets" / "engine_bay.ply").string(), 1e-3).mesh);
  Task task;
  PlacedObstacle bay;
  bay.name = "bay";
  bay.body.shape = surface;
  task.scene.add(std::move(bay));
  task.design.rod = Rod::uniform(0.72, Section::round(0.023, 0.016, Material::from_poisson(6e6, 0.49, 2144)), 60);
  task.design.from = Frame::looking({0.326, 0.190, 0.500}, {0, 1, 0});
  task.design.to = Frame::looking({0.478, 0.814, 0.440}, {0, 1, 0});
  task.options.min_bend_radius = 0.06;
  task.options.clearance = 0.008;
  task.options.free_ends = 0.05;
  task.options.clearance_weight = 0.5;
  task.options.adjust.from_tilt = task.options.adjust.to_tilt = tilts;
  return task;
}

/// Seconds from the first design looked at, whose equilibrium both solvers share, until one that keeps everything is no worse than
/// `goal`; infinite when there is none.
double seconds_to(const RefinementResult& result, double goal) {
  for (const RefinementRecord& record : result.history)
    if (record.violation <= 5e-6 && record.objective <= goal) return record.seconds - result.history.front().seconds;
  return std::numeric_limits<double>::infinity();
}

/// Both solvers to within a ten-thousandth of the better answer.
void against_gradient_free(benchmark::State& state, const Task& task) {
  RefinementOptions without = task.options;
  without.solver = RefinementSolver::gradient_free;
  without.max_evaluations = 5000;
  double fast = std::numeric_limits<double>::infinity(), slow = fast;
  RefinementResult a = refine(task.scene, task.design, task.options), b;
  for (auto _ : state) {
    a = refine(task.scene, task.design, task.options);
    b = refine(task.scene, task.design, without);
    if (!a.ok || !b.ok) state.SkipWithError((a.ok ? b.message : a.message).c_str());
    const double goal = std::min(a.objective, b.objective) * (1 + 1e-4);
    fast = std::min(fast, seconds_to(a, goal));
    slow = std::min(slow, seconds_to(b, goal));
  }
  state.counters["gradient_ms"] = 1e3 * fast;
  state.counters["free_ms"] = 1e3 * slow;
  state.counters["gradient_objective"] = a.objective;
  state.counters["free_objective"] = b.objective;
  state.counters["gradient_equilibria"] = a.evaluations;
  state.counters["free_equilibria"] = b.evaluations;
  // Where the search without derivatives never got there, against when it gave up.
  state.counters["gradient_share"] = fast / std::min(slow, b.history.back().seconds - b.history.front().seconds);
}

void refine_hanging(benchmark::State& state) { against_gradient_free(state, hanging()); }
void refine_clipped(benchmark::State& state) { against_gradient_free(state, clipped()); }
void refine_in_bay_both(benchmark::State& state) { against_gradient_free(state, in_bay(true)); }

void refine_in_bay(benchmark::State& state) {
  const Task task = in_bay(state.range(0));
  RefinementResult result = refine(task.scene, task.design, task.options);
  for (auto _ : state) benchmark::DoNotOptimize(result = refine(task.scene, task.design, task.options));
  if (!result.ok) state.SkipWithError(result.message.c_str());
  state.counters["equilibria"] = result.evaluations;
  state.counters["length_mm"] = 1e3 * result.design.rod.length;
  state.counters["gap_mm"] = 1e3 * result.clearance.value;
  state.counters["bend_radius_mm"] = 1e3 * result.min_bend_radius;
}

}  // namespace

BENCHMARK(refine_hanging)->Unit(benchmark::kMillisecond);
BENCHMARK(refine_clipped)->Unit(benchmark::kMillisecond);
BENCHMARK(refine_in_bay_both)->Unit(benchmark::kMillisecond);
BENCHMARK(refine_in_bay)->ArgName("tilts")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
