// One rod on one core: error reached, iterations and time. `newton` is the iteration from the first guess on, `solve` the
// whole call from problem to described equilibrium. Errors are the largest over vertices, relative to the length, against
// the same rod on a much finer mesh.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "statics/solve.h"
#include "statics/solver.h"

namespace {

using namespace tendril;

constexpr int reference_segments = 640;

/// Solid hose of 1.2 m between two level clamps 0.8 m apart under gravity.
RodProblem hose(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), segments);
  problem.gravity = {0, 0, -9.81};
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0, 0})}, {1.2, Frame::looking({0.8, 0, 0}, {1, 0, 0})}};
  return problem;
}

/// Weightless cantilever of 1 m under a dead tip force of 3 EI/L^2.
RodProblem cantilever(int segments) {
  RodProblem problem;
  const Section section = Section::round(0.01, 0, Material::from_poisson(5e6, 0.5, 0));
  problem.rod = Rod::uniform(1, section, segments);
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0, 0})}};
  problem.loads = {{1, {0, 0, -3 * section.EI1}, Vec3::Zero()}};
  return problem;
}

double relative_error(const RodProblem& problem, const SolveOptions& options) {
  RodProblem fine = problem;
  fine.rod.segments = reference_segments / problem.rod.segments * problem.rod.segments;
  const Equilibrium coarse = solve(problem, options), exact = solve(fine);
  const std::size_t ratio = (exact.s.size() - 1) / (coarse.s.size() - 1);
  double largest = 0;
  for (std::size_t i = 0; i < coarse.s.size(); ++i)
    largest = std::max(largest, (coarse.points[i] - exact.points[i * ratio]).norm());
  return largest / problem.rod.length;
}

void newton(benchmark::State& state, const RodProblem& problem, const SolveOptions& options = {}) {
  RodSolver solver(problem, options, problem.rod.segments);
  NewtonOutcome outcome;
  for (auto _ : state) {
    RodState shape = solver.starting_state(nullptr);
    outcome = solver.iterate(shape, false, {});
    benchmark::DoNotOptimize(shape);
  }
  if (outcome.status != Status::solved) state.SkipWithError("not solved");
  state.counters["iterations"] = outcome.iterations;
  if (problem.rod.segments <= reference_segments / 2) state.counters["error"] = relative_error(problem, options);
}

void hose_newton(benchmark::State& state) { newton(state, hose(static_cast<int>(state.range(0)))); }
void cantilever_newton(benchmark::State& state) { newton(state, cantilever(static_cast<int>(state.range(0)))); }

void hose_staggered_newton(benchmark::State& state) {
  SolveOptions options;
  options.element = Element::staggered;
  newton(state, hose(static_cast<int>(state.range(0))), options);
}

void hose_solve(benchmark::State& state) {
  const RodProblem problem = hose(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(solve(problem));
}

/// The far clamp has moved by 1 mm since the last solution.
void hose_warm(benchmark::State& state) {
  RodProblem problem = hose(static_cast<int>(state.range(0)));
  const Equilibrium before = solve(problem);
  problem.holds[1].frame.at += Vec3(0.8e-3, 0.4e-3, 0.4e-3);
  RodSolver solver(problem, {}, problem.rod.segments);
  NewtonOutcome outcome;
  for (auto _ : state) {
    RodState shape = solver.starting_state(&before);
    outcome = solver.iterate(shape, true, {});
    benchmark::DoNotOptimize(shape);
  }
  if (outcome.status != Status::solved) state.SkipWithError("not solved");
  state.counters["iterations"] = outcome.iterations;
  state.counters["error"] = relative_error(problem, {});
}

BENCHMARK(hose_newton)->Arg(17)->Arg(40)->Unit(benchmark::kMicrosecond);
BENCHMARK(hose_solve)->Arg(17)->Unit(benchmark::kMicrosecond);
BENCHMARK(hose_staggered_newton)->Arg(40)->Arg(160)->Unit(benchmark::kMicrosecond);
BENCHMARK(hose_warm)->Arg(17)->Unit(benchmark::kMicrosecond);
BENCHMARK(cantilever_newton)->Arg(12)->Arg(14)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(hose_newton)->Name("hose_segments")->RangeMultiplier(10)->Range(10, 10000)->Unit(benchmark::kMicrosecond);

}  // namespace
