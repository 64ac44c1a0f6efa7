// Harnesses: a trunk with two side arms at every branch point, all arms and both ends of the trunk clamped, under gravity.
// `slack`, per mille: how much longer the rods are than the way between their ends. Without slack every rod sags a little;
// with it nearly every one of them is a buckled strut, and which way each gives is for the solver to find.
#include <benchmark/benchmark.h>

#include "base/units.h"
#include "statics/network_solver.h"
#include "statics/solve.h"

namespace {

using namespace tendril;

RodProblem hose(double length, int segments) {
  RodProblem problem;
  const Section section = Section::round(0.012, 0, Material::from_poisson(5e6, 0.45, 1100));
  problem.rod = Rod::uniform(length, section, segments);
  problem.gravity = {0, 0, -9.81};
  return problem;
}

/// `rods` (3 n + 1) rods, 0.2 m long each, with n branch points.
SystemProblem harness(int rods, int segments, int slack) {
  const int n = (rods - 1) / 3;
  const double length = 0.2, apart = length / (1 + 1e-3 * slack);
  SystemProblem problem;
  const auto along_x = [](double x) { return Frame::looking({x, 0, 0}, Vec3::UnitX(), Vec3::UnitZ()); };
  for (int i = 0; i <= n; ++i) problem.rods.push_back(hose(length, segments));
  problem.rods.front().holds = {{0, along_x(0)}};
  problem.rods[n].holds = {{length, along_x(apart * (n + 1))}};
  for (int i = 0; i < n; ++i) {
    BranchPoint branch;
    branch.frame = along_x(apart * (i + 1));
    branch.sections = {{i, length, {}}, {i + 1, 0, {}}};
    for (const double side : {1.0, -1.0}) {
      RodProblem arm = hose(length, segments);
      arm.holds = {{length, Frame::looking({apart * (i + 1), side * apart, 0}, {0, side, 0}, Vec3::UnitZ())}};
      branch.sections.push_back({static_cast<int>(problem.rods.size()), 0,
                                 {Vec3::Zero(), Quat(Eigen::AngleAxisd(side * 0.5 * units::pi, Vec3::UnitX()))}});
      problem.rods.push_back(std::move(arm));
    }
    problem.branches.push_back(std::move(branch));
  }
  return problem;
}

void harness_cold(benchmark::State& state) {
  const SystemProblem problem = harness(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  SystemEquilibrium last;
  for (auto _ : state) {
    last = solve(problem);
    benchmark::DoNotOptimize(last.rods.data());
  }
  if (!last.ok()) state.SkipWithError("not solved");
  state.counters["iterations"] = last.rods.front().iterations;
  state.counters["rods"] = static_cast<double>(problem.rods.size());
  state.counters["fallbacks"] = last.rods.front().fallbacks;
}
BENCHMARK(harness_cold)
    ->ArgNames({"rods", "segments", "slack"})
    ->Args({31, 40, 0})
    ->Args({124, 40, 0})
    ->Args({502, 40, 0})
    ->Args({31, 40, 50})
    ->Args({502, 40, 50})
    ->Unit(benchmark::kMillisecond);

void harness_newton(benchmark::State& state) {
  const SystemProblem problem = harness(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  NetworkSolver solver(problem, {});
  const RodState start = solver.starting_state(nullptr);
  RodState there;
  NewtonOutcome outcome;
  for (auto _ : state) {
    there = start;
    outcome = solver.iterate(there, false, {});
    benchmark::DoNotOptimize(there.r.data());
  }
  if (outcome.status != Status::solved) state.SkipWithError("not solved");
  state.counters["iterations"] = outcome.iterations;
}
BENCHMARK(harness_newton)->ArgNames({"rods", "segments", "slack"})->Args({502, 40, 0})->Unit(benchmark::kMillisecond);

}  // namespace
