#include "scene/scene_motion.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"

namespace tendril {
namespace {

/// The paths of the holds that belong to one system; `taken` notes which were found.
std::vector<HeldPath> paths_in(const Scene& scene, const Scene::System& system, const std::vector<MovingHold>& holds,
                               std::vector<char>& taken) {
  std::vector<HeldPath> paths;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    HeldPath path;
    path.at = holds[i].path;
    for (std::size_t k = 0; k < system.rods.size(); ++k) {
      const PlacedRod& rod = *scene.rods()[system.rods[k]];
      if (rod.name() != holds[i].name) continue;
      for (std::size_t h = 0; h < rod.holds().size(); ++h)
        if (std::abs(rod.holds()[h].at - holds[i].at) <= 1e-9 * rod.rod().length) {
          path.rod = static_cast<int>(k);
          path.hold = static_cast<int>(h);
        }
      if (path.hold < 0)
        throw UsageError("scene:motion: '" + holds[i].name + "' is not held at " + rod.describe(holds[i].at) + "; hold it there first");
    }
    for (std::size_t b = 0; b < system.branches.size(); ++b) {
      const PlacedBranch& branch = *scene.branches()[system.branches[b]];
      if (branch.name != holds[i].name) continue;
      if (!branch.position && !branch.orientation)
        throw UsageError("scene:motion: branch point '" + branch.name + "' is free; hold it first");
      path.branch = static_cast<int>(b);
    }
    if (path.rod < 0 && path.branch < 0) continue;
    taken[i] = 1;
    paths.push_back(std::move(path));
  }
  return paths;
}

void check_all_taken(const Scene& scene, const std::vector<MovingHold>& holds, const std::vector<char>& taken) {
  std::vector<std::string> names;
  for (const auto& rod : scene.rods()) names.push_back(rod->name());
  for (const auto& branch : scene.branches()) names.push_back(branch->name);
  for (std::size_t i = 0; i < holds.size(); ++i)
    if (!taken[i]) throw UsageError("scene:motion: unknown name " + unknown_name(holds[i].name, "rods and branch points", names));
}

/// The solutions of one system at the evenly spaced times, put into the scene's equilibria.
void take_steps(Motion& motion, const SceneEquilibrium& frame, const SolvedSystem& system, SceneMotion& out) {
  std::size_t next = 0;
  for (MotionStep& step : motion.steps) {
    if (next < out.times.size() && std::abs(step.t - out.times[next]) < 1e-9)
      out.equilibria[next++]->take(std::move(step.equilibrium), system.rods, system.branches);
  }
  out.times.resize(next);
  out.equilibria.resize(next);
  for (const SnapThrough& snap : motion.snaps) out.snaps.push_back({frame.rods[system.rods[snap.rod]].name, snap});
}

}  // namespace

SceneMotion move_holds(const Scene& scene, const std::vector<MovingHold>& holds, const MotionOptions& motion,
                       const SolveOptions& options, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  if (holds.empty()) throw UsageError("scene:motion: nothing moves; name a hold and its path");
  std::vector<char> taken(holds.size(), 0);
  std::vector<std::vector<HeldPath>> paths;
  for (const Scene::System& system : scene.systems()) paths.push_back(paths_in(scene, system, holds, taken));
  check_all_taken(scene, holds, taken);
  const SceneEquilibrium first = scene.solve(options, context);
  SceneMotion out;
  out.status = first.status();
  out.message = first.message();
  if (!first.ok()) return out;
  for (int i = 0; i <= motion.steps; ++i) {
    out.times.push_back(double(i) / motion.steps);
    out.equilibria.push_back(std::make_shared<SceneEquilibrium>(first));
  }
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k].empty()) continue;
    const SolvedSystem& system = first.systems[k];
    const std::optional<SystemEquilibrium> here = first.part(first, system.rods, system.branches);
    Motion moved = tendril::move_holds(system.problem, paths[k], motion, options, context, here ? &*here : nullptr);
    out.solves += moved.solves;
    if (!moved.ok()) {
      out.status = moved.status;
      out.message = first.rods[system.rods.front()].name + ": " + moved.message;
    }
    take_steps(moved, first, system, out);
  }
  std::sort(out.snaps.begin(), out.snaps.end(), [](const SceneSnap& a, const SceneSnap& b) { return a.snap.t < b.snap.t; });
  if (out.ok() && !out.snaps.empty())
    out.message = "solved, with " + std::to_string(out.snaps.size()) + " snap-through" + (out.snaps.size() > 1 ? "s" : "");
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace tendril
