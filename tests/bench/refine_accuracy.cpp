// Error against run time of local refinement, for straight hoses with clips routed through the engine bay: how far the best design
// so far is above the best of all, with gradients and without; and how far the optimum of so many segments is from that of very
// many. Medians over the hoses. Prints two tables.
#include <cmath>
#include <cstdio>

#include "bench/routed_hoses.h"

namespace {

using namespace tendril;
using namespace tendril::bench;
using namespace tendril::routing;

/// What the best design that keeps everything costs after so many seconds; infinite where there is none yet.
double best_after(const RefinementResult& result, double seconds) {
  double best = infinity;
  for (const RefinementRecord& record : result.history)
    if (record.violation <= 5e-6 && seconds_of(record, result) <= seconds) best = std::min(best, record.objective);
  return best;
}

void print_share(double share) {
  if (std::isfinite(share)) std::printf(" %.1e |", std::max(share, 0.0));
  else std::printf(" none yet |");
}

void by_time(const std::vector<Task>& all) {
  std::vector<RefinementResult> with, without;
  std::vector<double> best;
  for (const Task& task : all) {
    RefinementOptions free = task.demands;
    free.solver = RefinementSolver::gradient_free;
    free.max_evaluations = 5000;
    with.push_back(refine(bay(), task.design, task.demands));
    without.push_back(refine(bay(), task.design, free));
    best.push_back(std::min(best_after(with.back(), infinity), best_after(without.back(), infinity)));
  }
  std::printf("| ms since the first equilibrium | with gradients | without |\n|---|---|---|\n");
  for (const double ms : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
    std::vector<double> shares[2];
    for (std::size_t k = 0; k < all.size(); ++k) {
      shares[0].push_back(best_after(with[k], 1e-3 * ms) / best[k] - 1);
      shares[1].push_back(best_after(without[k], 1e-3 * ms) / best[k] - 1);
    }
    std::printf("| %g |", ms);
    for (const std::vector<double>& share : shares) print_share(median(share));
    std::printf("\n");
  }
}

void by_segments(const std::vector<Task>& all) {
  const int numbers[] = {20, 40, 80, 160, 320};
  std::vector<double> exact;
  const auto refined = [](Task task, int segments) {
    task.design.rod.segments = segments;
    return refine(bay(), task.design, task.demands);
  };
  for (const Task& task : all) exact.push_back(refined(task, 1280).objective);
  std::printf("\n| segments | from the objective of 1280 | ms | keep all |\n|---|---|---|---|\n");
  for (const int segments : numbers) {
    std::vector<double> off, ms;
    int kept = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const RefinementResult result = refined(all[k], segments);
      off.push_back(std::abs(result.objective / exact[k] - 1));
      ms.push_back(1e3 * result.seconds);
      kept += result.ok;
    }
    std::printf("| %d | %.1e | %.0f | %d of %zu |\n", segments, median(off), median(ms), kept, all.size());
  }
}

}  // namespace

int main() {
  const std::vector<Task> all = tasks(false);
  by_time(all);
  by_segments(all);
}
