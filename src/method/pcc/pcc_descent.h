// The local optimum of a curve of straights and arcs: shortest (or cheapest) among those that keep what is demanded.
//
// Unknowns are the two end distances, the inner vertices, and the directions of ends that may turn within a cone
// (pcc_unknowns.h). Penalties with exact gradients (pcc_terms.h) and BFGS come first, then an augmented Lagrangian, so that the
// demands hold to rounding and the length is that of the constrained optimum.
#pragma once

#include "base/run_context.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::routing {

struct DescentOptions {
  double sample = 8e-3;     ///< m, between the places where the gap is asked for
  double margin = 0.4e-3;   ///< m, kept on top of what is demanded, for what lies between the samples
  bool polish = false;      ///< augmented Lagrangian after the penalties
  int iterations = 400;     ///< at most, of each phase
};

struct DescentResult {
  PccPoints curve;
  double length = 0;       ///< m
  double objective = 0;    ///< m, cost_integral(): by exact distances, while the descent follows FreeSpace::cost_interpolated
  int iterations = 0, queries = 0;
};

/// Starts from the vertices and radii of `seed`; its ends are those of `ends`, and its first and last vertices are projected onto
/// their directions. Vertices at which nothing is left to turn are left out of the result. Deterministic. Stops early, with the
/// best so far, when `context` says so. Throws UsageError for numbers that make no sense.
DescentResult descend(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& seed,
                      const DescentOptions& options = {}, const RunContext& context = {});

}  // namespace tendril::routing
