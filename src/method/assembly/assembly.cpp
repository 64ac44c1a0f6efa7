#include "method/assembly/assembly.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/assembly/handle_path.h"
#include "method/assembly/key_frames.h"
#include "method/assembly/path_smoothing.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"

namespace tendril::assembly {

namespace {

using routing::FreeSpace;

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

/// Connections and handle; with `more` the other places that may be gripped too.
std::vector<Grip> grips_of(const InstalledSystem& system, const Grip& handle, bool more) {
  std::vector<Grip> grips = system.connections;
  grips.push_back(handle);
  if (more)
    for (const Grip& grip : system.extra)
      if (grip.name != handle.name && grip.branch < 0) grips.push_back(grip);
  return grips;
}

/// How manipulations are made of traces, in order of promise.
struct Style {
  bool more_grips, smooth;
};
constexpr Style styles[] = {{false, true}, {false, false}, {true, false}};

void keep(Work& work, const Manipulation& forward, Played& played, const HandlePath& path) {
  Result& r = work.result;
  r.manipulation = forward;
  r.proof = played.proof;
  r.handle_path = path.points;
  r.hands = static_cast<int>(forward.grips.size());
  r.play = key_frames(work.scene, work.system, forward, played, work.options.solve);
}

/// One handle along one path: pull, trace, play each style. True: proven.
bool attempt(Work& work, const Grip& handle, const HandlePath& path, bool gravity) {
  Result& r = work.result;
  const Pulled pulled = pull(work.system, handle, path.points, gravity, work.drive, work.options.solve, work.context);
  r.steps[1].counts[0].second += 1;
  if (!pulled.ok) {
    if (r.message.empty()) r.message = "pulled by '" + handle.name + "': " + pulled.message;
    ++r.attempts;
    return false;
  }
  for (const Style& style : styles) {
    if (work.context.stop() || r.attempts >= work.options.attempts) return false;
    Manipulation forward = traces(work.system, pulled, grips_of(work.system, handle, style.more_grips)).reversed();
    if (style.smooth) forward = smoothed(work.system, forward, 0.1);
    Played played = play(work.system, forward, pulled.pulled.passed.back().equilibrium, work.options.deviation * work.system.radius, work.drive,
                         work.options.solve, work.context);
    ++r.attempts;
    if (played.proof.ok) {
      keep(work, forward, played, path);
      return true;
    }
    r.message = "installed by '" + handle.name + "': " + played.proof.message;
  }
  return false;
}

void conclude(Work& work, bool proven) {
  Result& r = work.result;
  if (const auto stopped = work.context.stop()) {
    r.status = *stopped;
    r.message = std::string(*stopped == Status::timeout ? "out of time" : "cancelled") + " after " + std::to_string(r.attempts) + " attempts";
    return;
  }
  r.ok = proven;
  r.status = proven ? Status::solved : Status::infeasible;
  if (proven) r.message = "installed by " + std::to_string(r.hands) + " grips; played forward it ends " + number_text(r.proof.deviation / units::mm) + " mm from the routed configuration";
  else r.message = "none found in " + std::to_string(r.attempts) + " attempts; the last: " + r.message;
}

}  // namespace

Result run(const Scene& scene, const Options& options, const RunContext& context) {
  Result r;
  StepClock clock(r.steps);
  Work work{scene, options, context, installed_system(scene, options.rods, 2, options.solve, context), nullptr, {}, r};
  if (!work.system.routed.ok()) {
    r.message = "the routed configuration has no equilibrium: " + work.system.routed.rods.front().message;
    r.seconds = clock.seconds();
    return r;
  }
  work.drive.radius = work.system.radius;
  work.drive.most_strain = options.max_strain;
  work.drive.min_bend_radius = options.min_bend_radius;
  work.space = free_space(scene, work.system, options, context);
  clock.end("routed_configuration", {{"rods", long(work.system.rods.size())}, {"connections", long(work.system.connections.size())}});
  r.steps.push_back({"attempts", 0, {{"pulls", 0}}});
  bool proven = false;
  for (const Grip& handle : handles_of(work.system, options)) {
    const HandlePaths paths = handle_paths(*work.space, work.system.pose(work.system.routed, handle).at,
                                           {work.system.radius, work.system.arm(handle) + 2 * work.system.radius, 0, options.exit}, context);
    if (paths.paths.empty() && r.message.empty()) r.message = "no way out for '" + handle.name + "': " + paths.why;
    for (const HandlePath& path : paths.paths)
      for (const bool gravity : {false, true}) {
        if (proven || context.stop() || r.attempts >= options.attempts) break;
        proven = attempt(work, handle, path, gravity);
      }
    if (proven || context.stop() || r.attempts >= options.attempts) break;
  }
  r.seconds = clock.seconds();
  conclude(work, proven);
  return r;
}

}  // namespace tendril::assembly
