// Contact: 500 random rods a family, as a table; then a hose at rest on a large terrain.
//
//   bench_contact                                the benchmarks
//   bench_contact table [cases [seed [family]]]  the table, in Markdown: solved, passes, microseconds, overlap, rods that
//                                                passed through a surface
//   bench_contact crossings [cases [seed]]       starts that cross a sheet: freed, reported
//
// Times of the table leave out the making of the obstacle and its tree.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "property/contact_surroundings.h"
#include "statics/solve.h"

using namespace tendril;
using namespace tendril::test;

namespace {

double microseconds_since(std::chrono::steady_clock::time_point start) {
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class T>
double at_share(std::vector<T> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return double(values[std::min(values.size() - 1, static_cast<std::size_t>(share * values.size()))]);
}

struct Row {
  int solved = 0, passed_through = 0;
  std::vector<int> passes, warm_passes;
  std::vector<double> cold, warm;
  double overlap = 0;  // radii, the largest
};

Row run_family(const ContactFamily& family, int cases, std::uint64_t seed) {
  Row row;
  for (int k = 0; k < cases; ++k) {
    std::mt19937_64 random(seed + k);
    const ContactCase one = family.make(random, as_surroundings());
    one.field->closest(one.problem.holds[0].frame.at, 10);  // builds the tree
    std::vector<DistanceTerm> terms;
    one.field->terms(one.problem.holds[0].frame.at, 10, terms);  // and the topology
    auto start = std::chrono::steady_clock::now();
    const Equilibrium eq = solve(one.problem);
    row.cold.push_back(microseconds_since(start));
    if (!eq.ok()) {
      std::printf("  %s, seed %llu: %s\n", family.name.c_str(), static_cast<unsigned long long>(seed + k), eq.message.c_str());
      continue;
    }
    ++row.solved;
    row.passes.push_back(eq.iterations);
    row.overlap = std::max(row.overlap, eq.deepest_penetration / one.problem.rod.largest_radius());
    row.passed_through += one.tunnelled(eq);
    RodProblem moved = one.problem;
    moved.holds.back().frame.at += Vec3(0.002, 0.001, -0.001);
    start = std::chrono::steady_clock::now();
    const Equilibrium again = solve(moved, {}, {}, &eq);
    row.warm.push_back(microseconds_since(start));
    if (!again.ok()) {
      std::printf("  %s, seed %llu, warm: %s\n", family.name.c_str(), static_cast<unsigned long long>(seed + k), again.message.c_str());
      continue;
    }
    row.warm_passes.push_back(again.iterations);
    row.overlap = std::max(row.overlap, again.deepest_penetration / one.problem.rod.largest_radius());
    row.passed_through += one.tunnelled(again);
  }
  return row;
}

void print_table(int cases, std::uint64_t seed, const std::string& only) {
  std::printf("| family | solved | passes 50 / 90 %% | us | warm solved | warm passes 50 / 90 %% | us | deepest overlap / r | passed through |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  for (const ContactFamily& family : contact_families(330)) {
    if (!only.empty() && family.name.find(only) == std::string::npos) continue;
    const Row row = run_family(family, cases, seed);
    std::printf("| %s | %d of %d | %.0f / %.0f | %.0f | %d of %d | %.0f / %.0f | %.0f | %.1e | %d |\n", family.name.c_str(), row.solved,
                cases, at_share(row.passes, 0.5), at_share(row.passes, 0.9), at_share(row.cold, 0.5),
                static_cast<int>(row.warm_passes.size()), row.solved, at_share(row.warm_passes, 0.5),
                at_share(row.warm_passes, 0.9), at_share(row.warm, 0.5), row.overlap, row.passed_through);
    std::fflush(stdout);
  }
}

/// Starts across a sheet: how many end free, cold and when the sheet appears across an equilibrium; the others are reported.
void print_crossings(int cases, std::uint64_t seed) {
  std::printf("| start | cold: free | reported | silent | passes 50 / 90 %% | us | from an equilibrium: free | reported | silent | passes 50 / 90 %% |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const ContactFamily& family : crossing_families()) {
    int free[2] = {0, 0}, silent[2] = {0, 0};
    std::vector<int> passes[2];
    std::vector<double> times;
    for (int k = 0; k < cases; ++k) {
      std::mt19937_64 random(seed + k);
      const ContactCase one = family.make(random, as_surroundings());
      RodProblem without = one.problem;
      without.surroundings = nullptr;
      const Equilibrium bare = solve(without);
      for (const bool warm : {false, true}) {
        const auto start = std::chrono::steady_clock::now();
        const Equilibrium eq = solve(one.problem, {}, {}, warm ? &bare : nullptr);
        if (!warm) times.push_back(microseconds_since(start));
        passes[warm].push_back(eq.iterations);
        const bool crosses = one.tunnelled(eq);
        free[warm] += eq.ok() && !crosses;
        silent[warm] += eq.ok() && crosses;
      }
    }
    std::printf("| %s |", family.name.c_str());
    for (const int warm : {0, 1}) {
      std::printf(" %d of %d | %d | %d | %.0f / %.0f |", free[warm], cases, cases - free[warm] - silent[warm], silent[warm],
                  at_share(passes[warm], 0.5), at_share(passes[warm], 0.9));
      if (!warm) std::printf(" %.0f |", at_share(times, 0.5));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

/// A hose of 60 segments on hills of a million triangles; the tree is built before the clock starts.
struct HoseOnHills {
  std::shared_ptr<ContactField> field;
  RodProblem problem;

  HoseOnHills() {
    const SheetMesh hills = SheetMesh::grid(708, 708, [](double u, double v) {
      const double x = 2 * u - 1, y = 2 * v - 1;
      return Vec3(x, y, 0.03 * std::sin(9 * x) * std::cos(7 * y) + 0.01 * std::sin(23 * x + 17 * y));
    });
    field = as_surroundings()(hills);
    problem.rod = Rod::uniform(1.2, Section::round(0.018, 0.01, Material::from_poisson(6e6, 0.49, 1150)), 60);
    problem.gravity = {0, 0, -9.81};
    Hold from, to;
    from.frame = Frame::looking({-0.45, 0, 0.15}, Vec3::UnitX());
    to.at = 1.2;
    to.frame = Frame::looking({0.45, 0.1, 0.12}, Vec3(1, 0.2, 0));
    problem.holds = {from, to};
    problem.surroundings = field.get();
    std::vector<DistanceTerm> terms;
    field->terms(Vec3::Zero(), 1, terms);
  }
};

const HoseOnHills& hills() {
  static const HoseOnHills one;
  return one;
}

void hose_on_a_million_triangles_cold(benchmark::State& state) {
  const HoseOnHills& hose = hills();
  Equilibrium eq;
  for (auto _ : state) benchmark::DoNotOptimize(eq = solve(hose.problem));
  state.SetLabel(std::string(name_of(eq.status)) + ", " + std::to_string(eq.iterations) + " passes, " +
                 std::to_string(eq.contacts.size()) + " contact points");
}
BENCHMARK(hose_on_a_million_triangles_cold)->Unit(benchmark::kMillisecond);

void hose_on_a_million_triangles_warm(benchmark::State& state) {
  const HoseOnHills& hose = hills();
  const Equilibrium before = solve(hose.problem);
  RodProblem moved = hose.problem;
  moved.holds[1].frame.at += Vec3(0.001, 0.001, 0);
  Equilibrium eq;
  for (auto _ : state) benchmark::DoNotOptimize(eq = solve(moved, {}, {}, &before));
  state.SetLabel(std::string(name_of(eq.status)) + ", " + std::to_string(eq.iterations) + " passes");
}
BENCHMARK(hose_on_a_million_triangles_warm)->Unit(benchmark::kMillisecond);

/// The same hose hung high above the hills: what being among obstacles costs without touching them.
void hose_above_a_million_triangles(benchmark::State& state) {
  RodProblem problem = hills().problem;
  for (Hold& hold : problem.holds) hold.frame.at.z() += 0.6;
  Equilibrium eq;
  for (auto _ : state) benchmark::DoNotOptimize(eq = solve(problem));
  state.SetLabel(std::string(name_of(eq.status)) + ", " + std::to_string(eq.iterations) + " passes");
}
BENCHMARK(hose_above_a_million_triangles)->Unit(benchmark::kMicrosecond);

void same_hose_without_obstacles(benchmark::State& state) {
  RodProblem problem = hills().problem;
  problem.surroundings = nullptr;
  Equilibrium eq;
  for (auto _ : state) benchmark::DoNotOptimize(eq = solve(problem));
  state.SetLabel(std::string(name_of(eq.status)) + ", " + std::to_string(eq.iterations) + " passes");
}
BENCHMARK(same_hose_without_obstacles)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "table") == 0) {
    print_table(argc > 2 ? std::atoi(argv[2]) : 500, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1, argc > 4 ? argv[4] : "");
    return 0;
  }
  if (argc > 1 && std::strcmp(argv[1], "crossings") == 0) {
    print_crossings(argc > 2 ? std::atoi(argv[2]) : 300, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
