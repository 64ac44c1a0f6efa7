// The reduced search from several starts: the path that was given, and others that stray from it. Paths for dress packs have many local
// optima; most of them are near the best one.
#pragma once

#include "method/dress_pack/reduced.h"

namespace tendril::dress_pack {

struct MultiStartOptions {
  ReducedOptions search = {};
  int starts = 8;        ///< the given path is the first
  double spread = 0.4;   ///< rad or m: how far the other starts' joints stray, at most
};

/// What became of one start.
struct StartReport {
  Status status = Status::stalled;
  std::string message;
  double objective_before = 0, objective = 0;  ///< infinite where the rods cannot follow the start
  int iterations = 0;
  JointPath start;
};

/// The result of the best start; `before` and `objective_before` are those of the given path.
struct MultiStartResult : ReducedResult {
  std::vector<StartReport> starts;
  int best = 0;          ///< of them
};

/// Starts depend on the seed of the context and their number alone: the same bits for any number of threads. Solved when the best start
/// is; infeasible, with the reason of the given path, when no start can be followed. Interrupted, the best of all starts so far. Throws
/// UsageError as optimise() does.
MultiStartResult optimise_from_starts(const PackProblem& pack, const JointPath& path, const MultiStartOptions& options = {},
                                      const RunContext& context = {});

/// The given path through as many via points, each moved by up to `spread`: by a common amount that grows from the ends to the middle, and
/// by half as much of its own. Within the limits of the robot, and of its speeds where `seconds` > 0.
JointPath strayed(const JointPath& path, const Robot& robot, double spread, double seconds, std::uint64_t seed, int number);

}  // namespace tendril::dress_pack
