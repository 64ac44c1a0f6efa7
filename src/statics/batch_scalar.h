// The scalar solver as batches use it: for the nominal equilibrium, and for outcomes that the lanes could not solve.
#pragma once

#include <string>
#include <vector>

#include "statics/batch.h"

namespace tendril {

struct ScalarAnswer {
  Status status = Status::stalled;
  int iterations = 0;
  double last_step = 0;
  std::string message;  ///< why it is not solved
  Batch::Start at;      ///< empty for a problem that makes no sense
  std::vector<std::vector<BatchResults::Support>> holds;  ///< by rod and hold
  std::vector<BatchResults::Support> branches;
};

/// Never throws: a problem that makes no sense has stalled, and the message says why. `from`: null, or an equilibrium to
/// start from. `shares`: null, or the arc lengths over the length of the vertices asked for, by rod: an outcome's own mesh
/// may differ from the nominal one where holds have moved along the rod.
ScalarAnswer solve_scalar(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                          const SystemEquilibrium* from = nullptr,
                          const std::vector<std::vector<double>>* shares = nullptr);

}  // namespace tendril
