// Holds of a scene that follow prescribed paths, quasi-statically.
#pragma once

#include <functional>

#include "scene/scene.h"
#include "statics/motion.h"

namespace tendril {

/// A hold of a rod, or a held branch point, and where it is at t = 0 ... 1.
struct MovingHold {
  std::string name;    ///< of the rod or branch point
  double at = 0;       ///< arc length of the hold, m; of no meaning for a branch point
  std::function<Frame(double t)> path;
};

struct SceneSnap {
  std::string rod;
  SnapThrough snap;
};

struct SceneMotion {
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  int solves = 0;
  std::vector<double> times;                                    ///< evenly spaced, as far as it went
  std::vector<std::shared_ptr<SceneEquilibrium>> equilibria;    ///< at those times
  std::vector<SceneSnap> snaps;
  bool ok() const { return status == Status::solved; }
};

/// Throws UsageError for a name or place that is not held, and for no holds at all.
SceneMotion move_holds(const Scene& scene, const std::vector<MovingHold>& holds, const MotionOptions& motion,
                       const SolveOptions& options, const RunContext& context);

}  // namespace tendril
