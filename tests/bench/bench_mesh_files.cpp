// Reading and preparing a mesh of 1 M triangles: files, welding, topology.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "bench/test_surface.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_export.h"
#include "geometry/mesh_topology.h"

using namespace tendril;

namespace {

const Mesh& surface() {
  static const Mesh mesh = test_surface(1'000'000);
  return mesh;
}

void load(benchmark::State& state, const char* suffix) {
  const std::string path = (std::filesystem::temp_directory_path() / "tendril-bench").string() + suffix;
  save_mesh(path, surface());
  for (auto _ : state) benchmark::DoNotOptimize(load_mesh(path, 1).mesh.triangles.size());
  std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(load, stl, ".stl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, ply, ".ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, obj, ".obj")->Unit(benchmark::kMillisecond);

void topology(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(topology_of(surface(), weld_tolerance(surface())).boundary_edges);
}
BENCHMARK(topology)->Unit(benchmark::kMillisecond);

}  // namespace
