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
  std::vector<BatchResults::Support> reactions;  ///< by rod and hold
};

/// Never throws: a problem that makes no sense has stalled, and the message says why.
ScalarAnswer solve_scalar(const SystemProblem& problem, const SolveOptions& options, const RunContext& context);

}  // namespace tendril
