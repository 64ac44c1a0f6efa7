// A branched harness of six connections in the engine bay of over a million triangles (assets/engine_bay.ply beside the
// program), tree and field made before: the whole way from connections to equilibrium; and its tree alone by the number of
// connections.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "geometry/import_mesh.h"
#include "method/route/harness_routing.h"
#include "method/route/harness_tree.h"

namespace {

using namespace tendril;
using namespace tendril::routing;

std::string bay_file() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets" / "engine_bay.ply").string();
}

const Scene& bay() {
  static const Scene scene = [] {
    Scene scene(Vec3(0, 0, -9.81));
    PlacedObstacle obstacle;
    obstacle.name = "bay";
    obstacle.body.shape = std::make_shared<const TriangleSurface>(load_mesh(bay_file(), 1e-3).mesh);
    scene.add(std::move(obstacle));
    return scene;
  }();
  return scene;
}

SpaceDemands demands() {
  SpaceDemands demands;
  demands.radius = 0.008;
  demands.clearance = 0.012;
  return demands;
}

/// Free places near parts, far from each other, that look away from the part; found by a walk over the roadmap's nodes.
std::vector<Frame> places_near_parts(int count) {
  const FreeSpace space(bay(), demands(), {}, 0.0);
  const Roadmap roadmap(space, 20e-3);
  const std::vector<float> reached = [&] {
    int start = static_cast<int>(roadmap.nodes() / 2);
    while (!roadmap.is_free(start)) ++start;
    return roadmap.costs_to({{start, 0}});
  }();
  std::vector<Frame> found;
  for (long i = 1; static_cast<int>(found.size()) < count && i < 1000000; ++i) {
    const int node = static_cast<int>(i * 7919 % roadmap.nodes());
    if (!(reached[node] < Roadmap::unreachable)) continue;
    const Vec3 at = roadmap.place(node);
    const Gap gap = space.gap(at, 0.1);
    if (gap.obstacle < 0 || gap.value < 0.02 || gap.value > 0.05) continue;
    if (!space.is_free(at, Vec3(at + 0.15 * gap.gradient), 0.02)) continue;
    bool apart = true;
    for (const Frame& other : found) apart = apart && (other.at - at).norm() > 0.35;
    if (apart) found.push_back(Frame::looking(at, gap.gradient));
  }
  return found;
}

HarnessOptions options(int connections) {
  HarnessOptions options;
  options.connections = places_near_parts(connections);
  options.section = Section::round(0.016, 0, Material::from_poisson(3e7, 0.4, 1500));
  options.space = demands();
  options.min_bend_radius = 0.05;
  options.end_straight = 0.02;
  return options;
}

void report(benchmark::State& state, const HarnessResult& r) {
  if (!r.ok) state.SkipWithError(r.message.c_str());
  for (const MethodStep& step : r.steps) state.counters[step.name + "_ms"] = 1e3 * step.seconds;
  state.counters["harness_mm"] = 1e3 * r.harness_length;
  state.counters["cable_mm"] = 1e3 * r.cable_length;
  state.counters["junctions"] = static_cast<double>(r.junctions.size());
  state.counters["clips"] = static_cast<double>(r.design.clips.size());
  state.counters["restarts"] = r.restarts;
  state.counters["missed_at_rest"] = r.missed_share;
}

/// Whether refined, and with how many clips at most.
void harness_in_bay(benchmark::State& state) {
  HarnessOptions six = options(6);
  six.refine = state.range(1) > 0;
  six.max_clips = static_cast<int>(state.range(2));
  RunContext context;
  context.threads = static_cast<int>(state.range(0));
  HarnessResult r = route_harness(bay(), six, context);
  double fastest = 1e9;
  for (auto _ : state) {
    r = route_harness(bay(), six, context);
    fastest = std::min(fastest, r.seconds);
  }
  state.counters["fastest_ms"] = 1e3 * fastest;
  report(state, r);
}

void tree_in_bay(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const HarnessOptions all = options(count);
  std::vector<Vec3> ends;
  for (const Frame& frame : all.connections) ends.push_back(frame.at);
  const FreeSpace space(bay(), demands(), ends, 0.2);
  const Roadmap roadmap(space, 20e-3);
  std::vector<std::vector<Roadmap::Goal>> goals;
  for (const Vec3& at : ends) {
    goals.emplace_back();
    const auto middle = roadmap.nearest(at);
    for (const auto& n : Roadmap::neighbours()) {
      const std::array<int, 3> cell{middle[0] + n.offset[0], middle[1] + n.offset[1], middle[2] + n.offset[2]};
      if (roadmap.holds(cell)) goals.back().push_back({roadmap.node(cell), (roadmap.place(roadmap.node(cell)) - at).norm()});
    }
  }
  RunContext context;
  context.threads = 2;
  HarnessTree tree;
  for (auto _ : state) tree = best_tree(roadmap, goals, {}, context);
  if (tree.status != Status::solved) state.SkipWithError("no tree");
  state.counters["free_nodes"] = static_cast<double>(roadmap.free_nodes());
  state.counters["labels"] = static_cast<double>(tree.labels);
  state.counters["length_mm"] = 1e3 * tree.length;
}

}  // namespace

BENCHMARK(harness_in_bay)
    ->ArgNames({"threads", "refine", "clips"})
    ->Args({1, 0, 0})
    ->Args({2, 0, 0})
    ->Args({2, 1, 0})
    ->Args({2, 1, 40})
    ->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(tree_in_bay)->ArgName("connections")->Arg(3)->Arg(6)->Arg(9)->Unit(benchmark::kMillisecond)->UseRealTime();
