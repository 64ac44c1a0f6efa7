// Attempts at an installation in order of promise: pulled out, traced, smoothed, played forward, with ever more grips (thesis 3.4).
#pragma once

#include "method/assembly/handle_path.h"
#include "method/assembly/installed_system.h"
#include "method/assembly/options.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"

namespace tendril::assembly {

/// The steps of the thesis as they are timed, in this order in Result::steps.
enum StepNumber { routed_configuration, constraint_relaxation, handle_path_planning, path_smoothing, grip_point_supplementation, optimisation };

class ManipulationSearch {
 public:
  /// `result` takes the attempts, their times and, in the end, the proven manipulation or how far the best attempt came.
  ManipulationSearch(const Scene& scene, const InstalledSystem& system, const Options& options, const RunContext& context, Result& result);

  /// True: proven. Throws UsageError for a handle that does not exist.
  bool run();

 private:
  /// A connector that got stuck: where, and where the handle was to go.
  struct Wedged {
    Vec3 at, out;
  };

  bool may_go_on() const;
  bool wedges(const HandlePath& path) const;
  std::vector<int> handles() const;
  bool by_handle(const Grip& handle, double arm);
  bool along(const Grip& handle, const HandlePath& path, bool gravity);
  bool supplemented(const Manipulation& all, const Attempt& kind, const Pulled& pulled, const HandlePath& path);
  Played played(const Manipulation& forward, const SystemEquilibrium& start, const RunContext& context) const;
  void keep(const Manipulation& forward, const Played& played, const HandlePath& path);
  void keep_best(const Manipulation& forward, Played played, const SystemEquilibrium& start, const HandlePath& path);
  void note(const Attempt& attempt, const Grip& handle, const Pulled& pulled, const HandlePath& path);
  void note(const Attempt& attempt, const Manipulation& forward, const Played& played, const HandlePath& path);
  bool is_furthest(double progress, const Drive& stopped);

  const Scene& scene_;
  const InstalledSystem& system_;
  const Options& options_;
  const RunContext& context_;
  Result& result_;
  std::vector<double> arms_;  // m, of the system's extra grips
  std::shared_ptr<const routing::FreeSpace> space_;
  DriveOptions drive_;
  std::vector<Wedged> wedged_;
  bool jammed_ = false;  // the last pull
  std::size_t by_earlier_handles_ = 0;  // attempts
  double furthest_ = -1;  // of all attempts: the part that failed, and how far in
};

}  // namespace tendril::assembly
