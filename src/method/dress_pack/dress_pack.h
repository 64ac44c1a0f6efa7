// method.dress_pack (thesis 3.5, Paper E): a robot's path that spares the hoses and cables it carries.
//
// The given path is simulated; its via points are optimised, so that the forces of the holds, the twist and the bending stay within
// what is demanded, the path short and of uniform speed, within joint limits, speeds and clearances; the optimised path is simulated
// again, with contact and at other times than those that the search looked at. What is still not kept is said, with place and time.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "method/dress_pack/pack_simulation.h"
#include "method/dress_pack/reduced.h"
#include "method/dress_pack/unmet.h"
#include "method/step.h"

namespace tendril::dress_pack {

/// Which unknowns the search has: the via points alone, or the states and stresses of all time steps as well (the paper's own).
enum class Formulation { reduced, direct };

/// "reduced", "direct".
const char* name_of(Formulation formulation);

struct Options {
  Limits limits = {};
  int via = 0;                  ///< via points, first and last included; 0: those of the path
  double seconds = 0;           ///< that the path takes; 0: the joints' speeds have no limits
  int steps = 40;               ///< time steps of the search
  int checked_steps = 200;      ///< time steps of the simulations before and after
  PathWeights weights = {};
  Formulation formulation = Formulation::reduced;
  int starts = 1;               ///< of the search: the given path, and so many less one that stray from it at random
  bool optimise = true;         ///< false: the given path is simulated, that is all
  double tolerance = 1e-7;      ///< of the objective, relative
  int most_iterations = 100;
};

struct Result {
  bool ok = false;              ///< the path was simulated to its end and keeps all limits
  Status status = Status::stalled;
  std::string message;
  Limits limits;                ///< that were asked for
  double duration = 0;          ///< s, of the path; 0: not said
  JointPath given, path;        ///< before and after; the same where nothing was optimised
  PackMotion before, after;
  std::vector<Unmet> unmet_before, unmet;
  double objective_before = 0, objective = 0;  ///< of the last round's demands
  int iterations = 0;
  double violation = 0;         ///< of the direct formulation's equations and limits, see direct.h
  std::vector<ReducedIteration> history;
  std::vector<MethodStep> steps;
  double seconds = 0;
};

/// Throws UsageError for a pack or options that make no sense. A path that begins or ends beyond the robot's limits, or on which the
/// rods find no equilibrium at the start, is infeasible, with the reason. Cancelled or out of time, the best path so far stands.
Result run(const PackProblem& pack, const JointPath& path, const Options& options = {}, const RunContext& context = {});

/// What a search minimises for these limits. Forces, twist and bending count from a tenth before their limits. Without a limit of
/// forces their mean square counts, in units of `usual_force` (N). Each round makes what lies beyond a limit weigh four times as much.
PackDemands demands_of(const Limits& limits, double usual_force, int round);

}  // namespace tendril::dress_pack
