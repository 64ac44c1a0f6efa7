// Nominal routing's search (thesis 3.1): the cheapest chain of primitives of the state lattice between two places and directions.
//
// A* with the greatest of: what the grid of places says (a backward search around the obstacles), and what the turn towards that
// way costs: an arc of radius R through the angle gamma is longer than its chord by about R (gamma - sin gamma). Both are weighted
// for speed, so that the chain is not quite the cheapest; the optimiser that follows does not mind.
#pragma once

#include "method/free_space/roadmap.h"
#include "method/pcc/pcc_curve.h"
#include "method/route/state_lattice.h"

namespace tendril::routing {

struct LatticeSearchOptions {
  double end_straight = 0;   ///< m, straight at both ends before the lattice is joined
  double free_ends = 0;      ///< m, arc length at both ends where nothing is kept clear of
  double eagerness = 1.2;    ///< factor of the grid's costs in the estimate; at most 0.886 the chain is the cheapest one
  bool turning = true;       ///< whether the estimate sees the turn
  long most_states = 4'000'000;
};

struct LatticePath {
  enum class Outcome { found, no_way, exhausted, capped, stopped };
  Outcome outcome = Outcome::no_way;  ///< no_way: not even for places; exhausted: not with the bend radius; capped: too many states
  PccPoints chain;         ///< start to finish, an arc or two a primitive
  double cost = 0;         ///< m
  long states = 0, queries = 0;
};

/// `roadmap` and `lattice` have one step. Deterministic.
LatticePath lattice_search(const FreeSpace& space, const Roadmap& roadmap, const StateLattice& lattice, const Ends& ends,
                           const LatticeSearchOptions& options = {}, const RunContext& context = {});

}  // namespace tendril::routing
