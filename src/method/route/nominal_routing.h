// Step 1 of routing a flexible object (thesis 3.1): a collision-free reference configuration that keeps the manufacturing
// constraints, from the state lattice R^3 x S^2, then smoothed to straights and arcs of locally least cost.
#pragma once

#include <string>
#include <vector>

#include "method/pcc/pcc_check.h"
#include "method/route/lattice_search.h"

namespace tendril::routing {

struct NominalOptions {
  Ends ends;
  PccDemands curve;
  int max_bends = 10;
  LatticeSearchOptions search;   ///< its end_straight and free_ends are those of `curve`
};

struct NominalRoute {
  enum class Status { found, infeasible, stopped };
  Status status = Status::infeasible;
  PccPoints points;
  double length = 0, objective = 0;   ///< m; the objective is cost_integral()
  double lattice_length = 0;          ///< m, of the chain before smoothing; 0 where the lattice had none
  std::string obstruction;            ///< where nothing was found: why
  long states = 0;
  int candidates = 0;                 ///< curves that were smoothed
};

/// The chain of the lattice and the cheapest paths of the grid of places start the smoothing, more of those where nothing
/// feasible comes of them; the cheapest curve that keeps everything, certified, is the route. A chain that keeps it stands where
/// smoothing finds none.
NominalRoute nominal_routing(const FreeSpace& space, const Roadmap& roadmap, const StateLattice& lattice,
                             const NominalOptions& options, const RunContext& context = {});

}  // namespace tendril::routing
