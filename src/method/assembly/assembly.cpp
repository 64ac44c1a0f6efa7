#include "method/assembly/assembly.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "method/assembly/handle_path.h"
#include "method/assembly/key_frames.h"
#include "method/assembly/optimisation.h"
#include "method/assembly/path_smoothing.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"
#include "method/assembly/supplementation.h"

namespace tendril::assembly {

namespace {

using routing::FreeSpace;

enum { routed_configuration, constraint_relaxation, handle_path_planning, path_smoothing, grip_point_supplementation, optimisation };
constexpr const char* step_names[] = {"routed_configuration", "constraint_relaxation",       "handle_path_planning",
                                      "path_smoothing",       "grip_point_supplementation", "optimisation"};
constexpr int most_supplementary = 4;      // grips, one after the other, before other traces are tried
constexpr int optimisation_plays = 30;
constexpr double smoothing_window = 0.1;   // of the common time

/// Everything that the attempts share.
struct Work {
  const Scene& scene;
  const Options& options;
  const RunContext& context;
  InstalledSystem system;
  std::shared_ptr<const FreeSpace> space;
  DriveOptions drive;
  Result& result;
};

std::shared_ptr<const FreeSpace> free_space(const Scene& scene, const InstalledSystem& system, const Options& options, const RunContext& context) {
  routing::SpaceDemands demands;
  demands.radius = system.radius;
  std::vector<Vec3> ends;
  double arm = 0;
  for (const Grip& grip : system.extra) {
    arm = std::max(arm, system.arm(grip));
    ends.push_back(system.pose(system.routed, grip).at);
  }
  if (options.exit) ends.push_back(*options.exit);
  return std::make_shared<const FreeSpace>(scene.without_rods(), demands, ends, 1.2 * arm + 4 * system.radius, context);
}

/// Handles by how short their longest arm is.
std::vector<Grip> handles_of(const InstalledSystem& system, const Options& options) {
  std::vector<Grip> handles;
  for (const Grip& grip : system.extra)
    if (options.grip.empty() || grip.name == options.grip || (grip.rod >= 0 && system.rods[grip.rod] == options.grip)) handles.push_back(grip);
  if (handles.empty()) throw UsageError("assembly: 'grip' names neither a rod nor a free branch point: '" + options.grip + "'");
  std::stable_sort(handles.begin(), handles.end(), [&](const Grip& a, const Grip& b) { return system.arm(a) < system.arm(b); });
  return handles;
}

/// Everything that was traced: connections, the handle first among the others.
std::vector<Grip> grips_of(const InstalledSystem& system, const Grip& handle) {
  std::vector<Grip> grips = system.connections;
  grips.push_back(handle);
  for (const Grip& grip : system.extra)
    if (grip.name != handle.name && grip.branch < 0) grips.push_back(grip);
  return grips;
}

/// Connections alone, and with the handle.
std::vector<std::string> names_of(const InstalledSystem& system, const Grip& handle) {
  std::vector<std::string> names;
  for (const Grip& grip : system.connections) names.push_back(grip.name);
  names.push_back(handle.name);
  return names;
}

/// One step of the thesis: its time and what it counts, over all attempts.
class Stage {
 public:
  Stage(MethodStep& step, const char* what) : step_(step) {
    if (step_.counts.empty()) step_.counts.push_back({what, 0});
    ++step_.counts.front().second;
  }
  ~Stage() { step_.seconds += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  MethodStep& step_;
  const Clock::time_point start_ = Clock::now();
};

void keep(Work& work, const Manipulation& forward, Played& played, const HandlePath& path) {
  Result& r = work.result;
  r.manipulation = forward;
  r.proof = played.proof;
  r.handle_path = path.points;
  r.hands = static_cast<int>(forward.grips.size());
  r.play = key_frames(work.scene, work.system, forward, played, work.options.solve);
}

bool may_go_on(const Work& work) { return !work.context.stop() && static_cast<int>(work.result.attempts.size()) < work.options.attempts; }

Played played_forward(Work& work, const Manipulation& forward, const SystemEquilibrium& start, const RunContext& context) {
  return play(work.system, forward, start, work.options.deviation * work.system.radius, work.drive, work.options.solve, context);
}

/// The proven manipulation made better, as far as asked for.
void keep_best(Work& work, const Manipulation& forward, Played played, const SystemEquilibrium& start, const HandlePath& path) {
  if (!work.options.optimise) return keep(work, forward, played, path);
  MethodStep& step = work.result.steps[optimisation];
  const Prove prove = [&](const Manipulation& manipulation, const RunContext& context) { return played_forward(work, manipulation, start, context); };
  const Stage stage(step, "runs");
  Optimised best = optimised(work.system, forward, std::move(played), prove, optimisation_plays, work.options.optimise_seconds, work.context);
  step.counts = {{"tried", best.tried}, {"accepted", best.accepted}};
  keep(work, best.manipulation, best.played, path);
}

double since(RunContext::Clock::time_point start) { return std::chrono::duration<double>(RunContext::Clock::now() - start).count(); }

/// Played with ever more grips until it arrives. True: proven.
bool supplemented(Work& work, const Manipulation& all, Attempt attempt, const SystemEquilibrium& start, const HandlePath& path,
                  std::vector<std::string> names) {
  Result& r = work.result;
  for (int more = 0; more <= most_supplementary && may_go_on(work); ++more) {
    const Manipulation forward = with_grips(all, names);
    Played played;
    std::string next;
    {
      const Stage stage(r.steps[grip_point_supplementation], "plays");
      const auto begin = RunContext::Clock::now();
      played = played_forward(work, forward, start, work.context);
      attempt.grips = static_cast<int>(forward.grips.size());
      attempt.outcome = played.proof.ok ? "proven" : played.proof.message;
      attempt.seconds += since(begin);
      r.attempts.push_back(std::exchange(attempt, {attempt.handle, attempt.gravity, attempt.smoothed, 0, {}, 0}));
      if (!played.proof.ok) next = supplementary_grip(work.system, all, forward, played);
    }
    if (played.proof.ok) {
      keep_best(work, forward, std::move(played), start, path);
      return true;
    }
    r.message = "installed by " + std::to_string(forward.grips.size()) + " grips: " + played.proof.message;
    if (next.empty()) return false;
    names.push_back(next);
  }
  return false;
}

/// One handle along one path: pulled, traced, smoothed, played. True: proven.
bool tried(Work& work, const Grip& handle, const HandlePath& path, bool gravity) {
  Result& r = work.result;
  const auto begin = RunContext::Clock::now();
  Attempt attempt{handle.name, gravity, true, 0, {}, 0};
  Pulled pulled;
  {
    const Stage stage(r.steps[constraint_relaxation], "pulls");
    pulled = pull(work.system, handle, path.points, gravity, work.drive, work.options.solve, work.context);
  }
  attempt.seconds = since(begin);
  if (!pulled.ok) {
    if (r.message.empty()) r.message = "pulled by '" + handle.name + "': " + pulled.message;
    attempt.outcome = pulled.message;
    r.attempts.push_back(attempt);
    return false;
  }
  const Manipulation raw = kept_clear(work.system, traces(work.system, pulled, grips_of(work.system, handle)).reversed());
  Manipulation smooth;
  {
    const Stage stage(r.steps[path_smoothing], "manipulations");
    smooth = smoothed(work.system, raw, smoothing_window);
  }
  const SystemEquilibrium& start = pulled.pulled.passed.back().equilibrium;
  if (supplemented(work, smooth, attempt, start, path, names_of(work.system, handle))) return true;
  attempt.smoothed = false;
  attempt.seconds = 0;
  return supplemented(work, raw, attempt, start, path, names_of(work.system, handle));
}

/// Handles, paths and gravity in order of promise until one is proven.
bool searched(Work& work) {
  const InstalledSystem& system = work.system;
  work.drive.radius = system.radius;
  work.drive.most_strain = work.options.max_strain;
  work.drive.min_bend_radius = work.options.min_bend_radius;
  if (!system.connectors.empty())
    work.drive.judge = [&system](const SystemEquilibrium& from, const SystemEquilibrium& to) {
      return connector_hit(system.connectors, system.surroundings.get(), from, to);
    };
  Result& r = work.result;
  for (const Grip& handle : handles_of(system, work.options)) {
    std::optional<HandlePaths> paths;
    const auto next = [&]() -> std::optional<HandlePath> {
      const Stage stage(r.steps[handle_path_planning], "searches");
      if (!paths) paths.emplace(*work.space, system.pose(system.routed, handle).at,
                                HandlePathOptions{system.radius, system.arm(handle) + 2 * system.radius, 0, work.options.exit}, work.context);
      return paths->next();
    };
    std::optional<HandlePath> path = next();
    if (!path && r.message.empty()) r.message = "no way out for '" + handle.name + "': " + paths->why();
    for (; path; path = next())
      for (const bool gravity : {false, true}) {
        if (!may_go_on(work)) return false;
        if (tried(work, handle, *path, gravity)) return true;
      }
    if (!may_go_on(work)) return false;
  }
  return false;
}

void conclude(Work& work, bool proven) {
  Result& r = work.result;
  if (!work.system.routed.ok() && !work.context.stop()) {
    r.message = "the routed configuration has no equilibrium: " + work.system.routed.rods.front().message;
    return;
  }
  if (const auto stopped = work.context.stop()) {
    r.status = *stopped;
    r.message = std::string(*stopped == Status::timeout ? "out of time" : "cancelled") + " after " + std::to_string(r.attempts.size()) + " attempts";
    return;
  }
  r.ok = proven;
  r.status = proven ? Status::solved : Status::infeasible;
  if (proven)
    r.message = "installed by " + std::to_string(r.hands) + " grips; played forward it ends " + number_text(r.proof.deviation / units::mm) + " mm from the routed configuration";
  else
    r.message = "none found in " + std::to_string(r.attempts.size()) + " attempts; the last: " + r.message;
}

}  // namespace

Result run(const Scene& scene, const Options& options, const RunContext& context) {
  const auto start = RunContext::Clock::now();
  Result r;
  for (const char* name : step_names) r.steps.push_back({name, 0, {}});
  Work work{scene, options, context, {}, nullptr, {}, r};
  {
    const Stage stage(r.steps[routed_configuration], "solves");
    work.system = installed_system(scene, options, 2, context);
    r.steps[routed_configuration].counts = {{"rods", long(work.system.rods.size())}, {"connections", long(work.system.connections.size())}};
    if (work.system.routed.ok()) work.space = free_space(scene, work.system, options, context);
  }
  bool proven = false;
  if (work.system.routed.ok()) proven = searched(work);
  r.seconds = since(start);
  conclude(work, proven);
  return r;
}

}  // namespace tendril::assembly
