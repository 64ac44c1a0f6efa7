// Batches of outcomes on one core: three coolant hoses that meet in a rigid T, and one hose between two clamps, by
// instruction set. `us_per_outcome` in us; `error_mm` is the largest distance of the outcomes' vertices from solutions with
// eight times the segments; `against_scalar` is the scalar solver's time for an outcome, warm from the nominal equilibrium
// and without setting it up, over the batch's, both in this run.
#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/units.h"
#include "bench/tee_problem.h"
#include "statics/batch.h"
#include "statics/network_solver.h"
#include "statics/solve.h"

namespace {

using namespace tendril;
using bench::tee;
using bench::tee_outcomes;

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

RunContext threads(int count) {
  RunContext context;
  context.threads = count;
  return context;
}

SystemProblem hose(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), segments);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return {{problem}, {}};
}

/// The end clamp within 1 mm, as after a warm step.
Batch::Fill hose_outcomes(const SystemProblem& nominal) {
  return [&nominal](int outcome, SystemProblem& problem) {
    std::minstd_rand random(outcome + 1);
    random.discard(8);
    auto within = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    problem.rods[0].holds[1].frame.at =
        nominal.rods[0].holds[1].frame.at + Vec3(within(1e-3), within(1e-3), within(1e-3));
  };
}

double error_mm(const SystemProblem& nominal, const Batch::Fill& fill, const BatchResults& results) {
  constexpr int samples = 40, finer = 8;
  SolveOptions tight;
  tight.tolerance = 1e-11;
  NetworkSolver nominal_fine(nominal, tight, finer);
  const SystemEquilibrium start = nominal_fine.solve({});
  SystemProblem problem = nominal;
  double largest = 0;
  for (int k = 0; k < samples; ++k) {
    const int outcome = k * results.size() / samples;
    fill(outcome, problem);
    const SystemEquilibrium exact = NetworkSolver(problem, tight, finer).solve({}, &start);
    for (int r = 0; r < results.rods(); ++r)
      for (int v = 0; v < results.vertices(r); ++v)
        largest = std::max(largest, (results.frame(outcome, r, v).at - exact.rods[r].points[finer * v]).norm());
  }
  return 1e3 * largest;
}

/// Seconds of the scalar solver's inner loop for one outcome.
double scalar_seconds(const SystemProblem& nominal, const Batch::Fill& fill) {
  constexpr int samples = 60;
  const SystemEquilibrium start = solve(nominal);
  SystemProblem problem = nominal;
  double seconds = 0;
  for (int k = 0; k < samples; ++k) {
    fill(k, problem);
    NetworkSolver solver(problem, {});
    double best = INFINITY;
    for (int round = 0; round < 3; ++round) {
      RodState state = solver.starting_state(&start);
      const double before = thread_seconds();
      benchmark::DoNotOptimize(solver.iterate(state, true, {}));
      best = std::min(best, thread_seconds() - before);
    }
    seconds += best;
  }
  return seconds / samples;
}

void run(benchmark::State& state, const SystemProblem& nominal, const Batch::Fill& fill, InstructionSet set, int workers) {
  const BatchKernel* kernel = batch_kernel(set);
  if (!kernel) {
    state.SkipWithError("this processor does not have it");
    return;
  }
  constexpr int outcomes = 1000;
  Batch batch(nominal);
  batch.use(*kernel);
  BatchResults results;
  double fastest = INFINITY;
  for (auto _ : state) {
    const double before = thread_seconds();
    batch.solve(outcomes, fill, results, threads(workers));
    fastest = std::min(fastest, thread_seconds() - before);
  }
  double iterations = 0, scalar = 0;
  for (int k = 0; k < outcomes; ++k) {
    if (!results[k].ok()) state.SkipWithError("an outcome is not solved");
    iterations += results[k].iterations;
    scalar += results[k].scalar;
  }
  state.counters["iterations"] = iterations / outcomes;
  state.counters["scalar"] = scalar;
  if (workers > 1) return;
  state.counters["fastest_ms"] = 1e3 * fastest;
  state.counters["us_per_outcome"] = 1e6 * fastest / outcomes;
  state.counters["error_mm"] = error_mm(nominal, fill, results);
  state.counters["against_scalar"] = scalar_seconds(nominal, fill) * outcomes / fastest;
}

const int registered = [] {
  struct Set {
    const char* name;
    InstructionSet set;
  };
  for (const Set& set : {Set{"avx2", InstructionSet::avx2}, Set{"avx512", InstructionSet::avx512}}) {
    for (const int segments : {8, 10})
      benchmark::RegisterBenchmark(("batch_tee/" + std::to_string(segments) + "/" + set.name).c_str(), [=](benchmark::State& state) {
        const SystemProblem nominal = tee(segments);
        run(state, nominal, tee_outcomes(nominal), set.set, 1);
      })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark((std::string("batch_hose/18/") + set.name).c_str(), [=](benchmark::State& state) {
      const SystemProblem nominal = hose(18);
      run(state, nominal, hose_outcomes(nominal), set.set, 1);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark((std::string("batch_tee_two_threads/8/") + set.name).c_str(), [=](benchmark::State& state) {
      const SystemProblem nominal = tee(8);
      run(state, nominal, tee_outcomes(nominal), set.set, 2);
    })->Unit(benchmark::kMillisecond)->UseRealTime();
  }
  return 0;
}();

}  // namespace
