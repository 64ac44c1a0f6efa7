// The local optimum of a curve of straights and arcs: shortest (or cheapest) among those that keep what is demanded.
//
// Unknowns are the two end distances, the inner vertices, and the directions of ends that may turn within a cone. Penalties
// with exact gradients and L-BFGS come first, then an augmented Lagrangian, so that the demands hold to rounding and the
// length is that of the constrained optimum.
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
  double objective = 0;    ///< m: the integral of FreeSpace::cost; the length where nothing is preferred
  int iterations = 0, queries = 0;
};

/// Starts from the vertices of `seed`, whose ends are those of `ends` (its first and last edges need not be along the ends'
/// directions: they are projected). Deterministic. Stops early, with the best so far, when `context` says so.
DescentResult descend(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& seed,
                      const DescentOptions& options = {}, const RunContext& context = {});

}  // namespace tendril::routing
