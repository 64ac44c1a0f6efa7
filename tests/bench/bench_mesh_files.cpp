// Reading and preparing a mesh of 1 M triangles: files, welding, topology.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>

#include "bench/test_surface.h"
#include "base/write_file.h"
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

/// The surface as VRML97, with as many digits as exporters write.
std::string wrl_of(const Mesh& mesh) {
  std::string text = "#VRML V2.0 utf8\nGroup { children [ Transform { rotation 1 0 0 1.5707963 children [\n"
                     "Shape { geometry IndexedFaceSet { coord Coordinate { point [\n";
  char line[100];
  for (const Vec3& v : mesh.vertices)
    text.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, "%.6f %.6f %.6f,\n", v.x(), v.y(), v.z())));
  text += "] }\ncoordIndex [\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, "%d, %d, %d, -1,\n", a, b, c)));
  return text + "] } } ] } ] }\n";
}

void load_wrl(benchmark::State& state) {
  const std::string path = (std::filesystem::temp_directory_path() / "tendril-bench.wrl").string();
  write_file(path, wrl_of(surface()));
  for (auto _ : state) benchmark::DoNotOptimize(load_mesh(path, 1).mesh.triangles.size());
  std::filesystem::remove(path);
}
BENCHMARK(load_wrl)->Unit(benchmark::kMillisecond);

void topology(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(topology_of(surface(), weld_tolerance(surface())).boundary_edges);
}
BENCHMARK(topology)->Unit(benchmark::kMillisecond);

}  // namespace
