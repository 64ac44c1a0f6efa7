// Optimises a robot's path for its dress pack (thesis 3.5, Paper E), by the reduced formulation: only the via points are variables.
//
// Trust-region method with exact gradient and second derivative (reduced_problem.h, trust_step.h). Joint limits and speed limits hold
// at every iterate; the first and the last via point stay. A local optimum of the given path's kind is found: a rod that would have to
// snap through on the way is kept from it. What the first or the last configuration demands no via point can lower.
//
// Where clearances are demanded (PackDemands), they hold at every iterate that counts, for rods and links (clearance_search.h), and the
// path is verified by a simulation at five times the time steps.
// Not done: contact: a rod that must touch on the way cannot keep a clearance.
#pragma once

#include <string>
#include <vector>

#include "method/dress_pack/pack_simulation.h"
#include "method/dress_pack/reduced_problem.h"
#include "method/dress_pack/trust_step.h"

namespace tendril::dress_pack {

struct ReducedOptions {
  int steps = 40;              ///< time steps
  int via = 0;                 ///< via points, first and last included; 0: those of the path
  double seconds = 0;          ///< that the path takes; 0: the joints' speeds have no limits
  PackDemands demands = {};
  PathWeights weights = {};
  double tolerance = 1e-7;     ///< of the objective, relative: what another step would gain
  int most_iterations = 100;
  double first_radius = 0.5;   ///< rad, of the trust region; all variables together
};

struct ReducedIteration {
  double objective = 0, step = 0, radius = 0;
  bool accepted = false;
};

struct ReducedResult {
  Status status = Status::stalled;
  std::string message;
  JointPath path;               ///< the best that was found; within all limits
  double objective_before = 0, objective = 0;
  int iterations = 0;
  std::vector<ReducedIteration> history;
  PackMotion before, after;     ///< simulated from the start; `after` among the bodies where clearances are demanded
  /// The smallest of rods and of links that were verified, m; infinite where nothing was demanded or near.
  double clearance = std::numeric_limits<double>::infinity(), robot_clearance = std::numeric_limits<double>::infinity();
  double seconds = 0;           ///< in all; of the optimisation alone:
  double search_seconds = 0;
  double verification_seconds = 0;  ///< of the simulations that verify clearances
  bool ok() const { return status == Status::solved; }
};

/// A path that begins beyond the robot's limits, on which the rods find no equilibrium, or whose ends do not keep the clearances, is
/// refused as infeasible, with the reason; so is one for which no path with these clearances was found: where and how much is missing.
/// Cancelled or out of time, the best path so far is returned. Throws UsageError for a pack or options that make no sense.
ReducedResult optimise(const PackProblem& pack, const JointPath& path, const ReducedOptions& options = {}, const RunContext& context = {});

/// Throws UsageError for options that make no sense.
void check(const ReducedOptions& options, const Robot& robot);

/// Joint and speed limits of the free via points, one after the other; `seconds` 0: joint limits alone.
LinearLimits limits_of(const Robot& robot, const JointPath& path, double seconds);

}  // namespace tendril::dress_pack
