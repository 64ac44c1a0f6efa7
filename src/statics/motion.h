// Quasi-static motion: holds follow prescribed paths, the rods go from equilibrium to equilibrium.
#pragma once

#include <functional>

#include "base/run_context.h"
#include "statics/equilibrium.h"

namespace tendril {

/// A hold, or a held branch point, that moves; t runs from 0 to 1.
struct HeldPath {
  int rod = -1, hold = -1;  ///< of the problem; or
  int branch = -1;          ///< a branch point
  std::function<Frame(double t)> at;
};

struct MotionOptions {
  int steps = 20;               ///< solutions that are kept, evenly spaced in t
  double largest_move = 0.02;   ///< of the length: a vertex that moves farther in one step makes the step smaller
  double smallest_step = 1e-4;  ///< of t; a larger move over this is a snap-through
  int most_solves = 1'000'000;  ///< then it has stalled
};

/// The rods left their equilibrium and came to rest in another one.
struct SnapThrough {
  double t = 0;            ///< between this and t plus the smallest step
  int rod = 0;             ///< that moved farthest,
  double s = 0;            ///< at this arc length, m,
  double move = 0;         ///< by so much, m
  double energy_drop = 0;  ///< J
};

struct MotionStep {
  double t = 0;
  SystemEquilibrium equilibrium;
};

struct Motion {
  Status status = Status::stalled;
  std::string message;
  std::vector<MotionStep> steps;  ///< the asked-for ones, those just before and after a snap-through, and the last that was solved
  std::vector<SnapThrough> snaps;
  int solves = 0;
  bool ok() const { return status == Status::solved; }
};

/// Makes the problem at t = 0 ... 1 of one that it made before, or of the given one.
using ProblemPath = std::function<void(double t, SystemProblem& problem)>;

/// Each equilibrium starts from the one before; where that leads nowhere, the rods run down their energy from there. Steps
/// adapt to how far the rods move. `from`: an equilibrium at t = 0, else one is found.
Motion follow(const SystemProblem& problem, const ProblemPath& path, const MotionOptions& motion, const SolveOptions& options,
              const RunContext& context, const SystemEquilibrium* from = nullptr);

/// The same for holds that move.
Motion move_holds(const SystemProblem& problem, const std::vector<HeldPath>& paths, const MotionOptions& motion,
                  const SolveOptions& options, const RunContext& context, const SystemEquilibrium* from = nullptr);

}  // namespace tendril
