// How near the best hose of method.preform is to the best ever found: for random pairs of places in the engine bay its shortest
// hose against the shortest of thousands of random restarts of the same descent. Prints a table.
//   preform_restarts [restarts a pair, 4000] [pairs, 10] [seed, 1]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "base/parallel.h"
#include "bench/bay_routes.h"
#include "method/preform/preform.h"

namespace {

using namespace tendril;
using namespace tendril::routing;

constexpr double infinity = std::numeric_limits<double>::infinity();

double seconds_since(RunContext::Clock::time_point began) {
  return std::chrono::duration<double>(RunContext::Clock::now() - began).count();
}

struct Found {
  double length = infinity;
  int feasible = 0;
};

/// Each restart has a stream of its own, so that any number of threads finds the same.
Found best_of_restarts(const FreeSpace& space, const Ends& ends, int restarts, std::uint64_t seed) {
  const PccDemands demands = bench::bay_curve();
  std::vector<DescentResult> results(restarts);
  std::vector<char> feasible(restarts, 0);
  const int workers = thread_count(0);
  run_workers(workers, [&](int worker) {
    for (int k = worker; k < restarts; k += workers) {
      std::seed_seq sequence{seed, static_cast<std::uint64_t>(k)};
      std::mt19937_64 random(sequence);
      results[k] = descend(space, demands, ends, bench::random_seed(ends, demands.radii.front(), random));
      feasible[k] = violations(space, demands, ends, results[k].curve).empty();
    }
  });
  Found found;
  for (int k = 0; k < restarts; ++k)
    if (feasible[k]) ++found.feasible, found.length = std::min(found.length, results[k].length);
  // To the last digit, as the hoses that it is compared with.
  DescentOptions polish;
  polish.polish = true;
  const double worth = 1.01 * found.length;
  for (int k = 0; k < restarts; ++k) {
    if (!feasible[k] || results[k].length > worth) continue;
    const PccPoints curve = fitted(descend(space, demands, ends, results[k].curve, polish).curve);
    if (violations(space, demands, ends, curve).empty()) found.length = std::min(found.length, curve.length());
  }
  return found;
}

preform::Options options_for(const Ends& ends) {
  preform::Options options;
  options.ends = ends;
  options.space = bench::bay_space();
  options.curve = bench::bay_curve();
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const int restarts = argc > 1 ? std::atoi(argv[1]) : 4000, pairs = argc > 2 ? std::atoi(argv[2]) : 10;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  if (restarts < 1 || pairs < 1) {
    std::fprintf(stderr, "preform_restarts: restarts and pairs are numbers above 0\n");
    return 1;
  }
  const Scene& bay = bench::engine_bay();
  const FreeSpace space(bay, bench::bay_space(), {}, 0.25);
  std::mt19937_64 random(seed);
  std::printf("seed %llu, %d random restarts a pair\n", static_cast<unsigned long long>(seed), restarts);
  std::printf("%4s %9s | %10s %7s %9s %7s | %10s %9s %7s | %9s\n", "pair", "apart mm", "preform mm", "hoses", "passages", "s",
              "restart mm", "feasible", "s", "longer by");
  int within = 0, done = 0, unreachable = 0;
  while (done < pairs && unreachable < 20 * pairs) {
    const Ends ends = bench::random_ends(space, random);
    const preform::Result result = preform::run(bay, options_for(ends));
    if (result.hoses.empty()) {  // mostly places within closed parts
      ++unreachable;
      continue;
    }
    const auto began = RunContext::Clock::now();
    const Found found = best_of_restarts(space, ends, restarts, seed + done);
    const double took = seconds_since(began), best = result.hoses.front().length;
    const double ever = std::min(best, found.length);
    within += best <= 1.01 * ever;
    std::printf("%4d %9.1f | %10.2f %7zu %9d %7.2f | ", ++done, 1e3 * (ends.finish - ends.start).norm(), 1e3 * best,
                result.hoses.size(), result.passages, result.seconds);
    if (found.feasible > 0)
      std::printf("%10.2f %9d %7.1f | %8.2f%%\n", 1e3 * found.length, found.feasible, took, 100 * (best / found.length - 1));
    else
      std::printf("%10s %9d %7.1f |\n", "none", 0, took);
    std::fflush(stdout);
  }
  std::printf("within 1 %% of the best ever found: %d of %d; %d pairs without a hose left out\n", within, done, unreachable);
  return 0;
}
