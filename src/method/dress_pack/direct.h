// Optimises a robot's path for its dress pack by the direct formulation of thesis 3.5: the rods' states at all time steps are variables
// beside the via points, and equilibrium is an equation (direct_problem.h). Mixed form: the wrenches in the segments are variables too,
// so that the rods' stiffness against stretch does not matter. Ipopt, started from the simulated initial path.
//
// Solved in rounds, each within a reach of the via points and from equilibria that are followed there: from a distance the program's steps
// turn the rods by more than a linear model bears, and its equations hold for unstable equilibria too.
//
// The objective is that of reduced.h, and on the cases of tests/bench/bench_pack_formulations.cpp both find the same minimum to nine digits;
// this one takes hundreds of times as long and is there to compare with.
// Not done: contact and clearance.
#pragma once

#include "method/dress_pack/reduced.h"

namespace tendril::dress_pack {

struct DirectResult : ReducedResult {
  double violation = 0;          ///< largest, of all equations and limits, in the last round: forces over the scale of their demand, m, rad
  int variables = 0, equations = 0;
};

/// As optimise(). `most_iterations` are rounds of up to 20 of Ipopt's iterations each; `first_radius` is how far a joint of a via point may
/// go in the first one, and `history` has one entry a round. `iterations` are Ipopt's. Throws UsageError for demands of clearance, and
/// where Ipopt's module cannot be loaded.
DirectResult optimise_direct(const PackProblem& pack, const JointPath& path, const ReducedOptions& options = {}, const RunContext& context = {});

}  // namespace tendril::dress_pack
