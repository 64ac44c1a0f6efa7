// One rod on one core: hose and cantilever at a stated error, warm solves, and the time over the number of segments. The
// counters give the estimated or known error relative to the length, and the iterations (factorisations) of a solve.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "statics/solve.h"
#include "statics/network_solver.h"

namespace {

using namespace tendril;

Element element_of(const benchmark::State& state) { return state.range(1) == 0 ? Element::se3 : Element::staggered; }

SolveOptions options_of(const benchmark::State& state) {
  SolveOptions options;
  options.element = element_of(state);
  return options;
}

/// Solid hose of 1.2 m, 16 mm, 5 MPa, between two clamps 0.8 m apart, under gravity.
RodProblem hose(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), segments);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

/// Slender cantilever of 1 m with a force of 3 EI/L^2 across its free end.
RodProblem cantilever(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.01, 0, Material::from_poisson(5e6, 0.5, 0)), segments);
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1})}};
  problem.loads = {{1, {0, 0, -3 * problem.rod.parts[0].section.EI1}, Vec3::Zero()}};
  return problem;
}

/// Largest distance of the vertices from a solution with 16 times the segments, relative to the length.
double error_of(const RodProblem& problem, SolveOptions options) {
  options.tolerance = 1e-12;
  const Equilibrium coarse = solve(problem, options);
  NetworkSolver fine({{problem}, {}}, options, 16);
  const Equilibrium exact = fine.solve({}).rods.front();
  double largest = 0;
  for (std::size_t i = 0; i < coarse.points.size(); ++i)
    largest = std::max(largest, (coarse.points[i] - exact.points[16 * i]).norm());
  return largest / problem.rod.length;
}

void inner(benchmark::State& state, const RodProblem& problem) {
  NetworkSolver solver({{problem}, {}}, options_of(state));
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
  state.counters["error"] = error_of(problem, options_of(state));
}

void whole(benchmark::State& state, const RodProblem& problem) {
  const SolveOptions options = options_of(state);
  Equilibrium last;
  for (auto _ : state) {
    last = solve(problem, options);
    benchmark::DoNotOptimize(last.points.data());
  }
  if (!last.ok()) state.SkipWithError("not solved");
  state.counters["iterations"] = last.iterations;
  state.counters["error"] = error_of(problem, options);
}

void hose_newton(benchmark::State& state) { inner(state, hose(static_cast<int>(state.range(0)))); }
void hose_solve(benchmark::State& state) { whole(state, hose(static_cast<int>(state.range(0)))); }
void cantilever_newton(benchmark::State& state) { inner(state, cantilever(static_cast<int>(state.range(0)))); }
void cantilever_solve(benchmark::State& state) { whole(state, cantilever(static_cast<int>(state.range(0)))); }

/// The end hold has moved by 1 mm since the state was solved.
void hose_warm(benchmark::State& state) {
  RodProblem problem = hose(static_cast<int>(state.range(0)));
  NetworkSolver solver({{problem}, {}}, options_of(state));
  RodState start = solver.starting_state(nullptr);
  solver.iterate(start, false, {});
  problem.holds[1].frame.at.x() += 1e-3;
  NetworkSolver moved({{problem}, {}}, options_of(state));
  RodState there;
  NewtonOutcome outcome;
  for (auto _ : state) {
    there = start;
    outcome = moved.iterate(there, true, {});
    benchmark::DoNotOptimize(there.r.data());
  }
  if (outcome.status != Status::solved) state.SkipWithError("not solved");
  state.counters["iterations"] = outcome.iterations;
}

void with_names(benchmark::internal::Benchmark* run, std::initializer_list<std::pair<int, Element>> meshes) {
  run->ArgNames({"segments", "staggered"});
  for (const auto& [segments, element] : meshes) run->Args({segments, element == Element::staggered});
}

// The hose's error is at most 1e-4 L and the cantilever's 1e-6 L from the second mesh of each list on.
const int registered = [] {
  constexpr auto se3 = Element::se3, staggered = Element::staggered;
  auto add = [](const char* name, void (*run)(benchmark::State&)) { return benchmark::RegisterBenchmark(name, run); };
  with_names(add("hose_newton", hose_newton), {{16, se3}, {18, se3}, {40, se3}, {40, staggered}, {120, staggered}});
  with_names(add("hose_solve", hose_solve), {{16, se3}, {18, se3}, {40, se3}, {120, staggered}});
  with_names(add("hose_warm", hose_warm), {{16, se3}, {18, se3}, {40, se3}, {40, staggered}});
  with_names(add("cantilever_newton", cantilever_newton), {{10, se3}, {14, se3}, {40, se3}, {40, staggered}});
  with_names(add("cantilever_solve", cantilever_solve), {{10, se3}, {14, se3}, {40, se3}, {40, staggered}});
  with_names(add("hose_over_segments", hose_newton), {{10, se3}, {100, se3}, {1000, se3}, {10000, se3}, {1000, staggered}});
  return 0;
}();

}  // namespace
