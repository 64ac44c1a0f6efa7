// The gradient of one measure in ten parameters, against one iteration of Newton's method in the same run. Counters, all
// in microseconds and the fastest of the run: `iteration`, `gradient` (from the factorised matrix that stands), `anew`
// (assembled and factorised again before), and their ratios to the iteration.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "statics/network_solver.h"
#include "statics/sensitivity.h"

namespace {

using namespace tendril;
using Kind = Parameter::Kind;

SystemProblem hose(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), segments);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return {{problem}, {}};
}

std::vector<Parameter> ten_parameters() {
  return {{Kind::length}, {Kind::EI}, {Kind::EA}, {Kind::GJ}, {Kind::mass}, {Kind::gravity, 0, 0, 0, 2},
          {Kind::hold_position, 0, 1, 0, 0}, {Kind::hold_position, 0, 1, 0, 2}, {Kind::hold_orientation, 0, 1, 0, 1},
          {Kind::outer, 0, 0, 0, 0, 0}};
}

template <class F>
double microseconds(F work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

void gradient(benchmark::State& run, Measure::What what) {
  NetworkSolver solver(hose(static_cast<int>(run.range(0))), {});
  const RodState start = solver.starting_state(nullptr);
  RodState state = start;
  if (solver.iterate(state, false, {}).status != Status::solved) run.SkipWithError("not solved");
  const std::vector<Parameter> parameters = ten_parameters();
  Measure measure;
  measure.what = what;
  measure.at = 0.6;
  Sensitivity sensitivity(solver.network(), state);
  double iteration = 1e9, standing = 1e9, anew = 1e9;
  for (auto _ : run) {
    RodState there = start;
    int iterations = 1;
    iteration = std::min(iteration, microseconds([&] { iterations = solver.iterate(there, false, {}).iterations; }) / iterations);
    standing = std::min(standing, microseconds([&] { benchmark::DoNotOptimize(sensitivity.gradient(measure, parameters).data()); }));
    anew = std::min(anew, microseconds([&] {
                      sensitivity.stand_at(state);
                      benchmark::DoNotOptimize(sensitivity.gradient(measure, parameters).data());
                    }));
  }
  run.counters["iteration"] = iteration;
  run.counters["gradient"] = standing;
  run.counters["anew"] = anew;
  run.counters["ratio"] = standing / iteration;
  run.counters["ratio_anew"] = anew / iteration;
}

void gradient_of_position(benchmark::State& run) { gradient(run, Measure::What::position); }
void gradient_of_bend_radius(benchmark::State& run) { gradient(run, Measure::What::min_bend_radius); }
void gradient_of_reaction(benchmark::State& run) { gradient(run, Measure::What::reaction_force); }
void gradient_of_energy(benchmark::State& run) { gradient(run, Measure::What::energy); }

BENCHMARK(gradient_of_position)->Arg(18)->Arg(40)->Arg(160);
BENCHMARK(gradient_of_bend_radius)->Arg(18)->Arg(40)->Arg(160);
BENCHMARK(gradient_of_reaction)->Arg(40);
BENCHMARK(gradient_of_energy)->Arg(40);

}  // namespace
