// Step 3 (thesis 3.2): every candidate to its local optimum, in parallel. The same bits for any number of threads.
#pragma once

#include <vector>

#include "method/pcc/pcc_descent.h"
#include "method/preform/pcc_sampling.h"

namespace tendril::preform {

struct Optimized {
  PccPoints points;
  double length = 0, objective = 0;
  int path = 0;
  std::vector<routing::Violation> violations;  ///< empty: feasible, certified
};
/// In the order of the candidates. Where a candidate misses what is demanded it is tried again with closer samples and a larger
/// margin.
std::vector<Optimized> pcc_optimization(const FreeSpace& space, const Options& options, const std::vector<Candidate>& candidates,
                                        const RunContext& context = {});

/// The winners to the constrained optimum, without bends below 15 degrees that Options::fewer_bends of the objective can replace,
/// with tools of other radii where they make it better, and certified again. Only optima are compared with each other: what a
/// descent ends above its optimum is not little beside those shares.
void polish(const FreeSpace& space, const Options& options, std::vector<Optimized>& curves, const RunContext& context = {});

}  // namespace tendril::preform
