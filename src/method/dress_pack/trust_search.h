// Minimises a reduced problem's objective by the trust-region method, within linear limits.
#pragma once

#include <functional>

#include "method/dress_pack/reduced.h"

namespace tendril::dress_pack {

struct TrustOptions {
  double tolerance = 1e-7;            ///< of the objective, relative: what another step would gain
  int most_iterations = 100;
  double first_radius = 0.5;          ///< rad
  std::function<bool()> enough = {};  ///< asked after each step that was accepted; true ends the search
};

/// Adds to the result's iterations and history, and sets its status and message. The problem stands at the best path.
void trust_search(ReducedProblem& problem, const LinearLimits& limits, const TrustOptions& options, const RunContext& context,
                  ReducedResult& out);

/// Cancelled or out of time: says so in the result.
bool stopped(const RunContext& context, ReducedResult& out);

}  // namespace tendril::dress_pack
