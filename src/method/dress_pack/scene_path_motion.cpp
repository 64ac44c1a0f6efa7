#include "method/dress_pack/scene_path_motion.h"

#include <algorithm>

#include "base/error.h"
#include "method/dress_pack/pack_scene.h"

namespace tendril::dress_pack {
namespace {

void check_all_attached(const Scene& scene, const ScenePack& pack, const std::string& robot) {
  std::string others;
  for (int k = 0; k < static_cast<int>(scene.rods().size()); ++k)
    if (std::find(pack.rods.begin(), pack.rods.end(), k) == pack.rods.end())
      others += (others.empty() ? "'" : ", '") + scene.rods()[k]->name() + "'";
  if (!others.empty())
    throw UsageError("scene:motion: " + others + " not attached to robot '" + robot + "'; remove it, or attach it with scene:attach");
}

/// Where a rod moved farthest between the kept equilibria around a snap-through.
double farthest_move_at(const SceneMotion& motion, double t, int rod) {
  const auto after = std::upper_bound(motion.times.begin(), motion.times.end(), t);
  if (after == motion.times.begin() || after == motion.times.end()) return 0;
  const std::size_t k = after - motion.times.begin();
  const Equilibrium &a = motion.equilibria[k - 1]->rods[rod].equilibrium, &b = motion.equilibria[k]->rods[rod].equilibrium;
  double most = 0, at = 0;
  for (std::size_t i = 0; i < std::min(a.points.size(), b.points.size()); ++i) {
    const double move = (b.points[i] - a.points[i]).norm();
    if (move <= most) continue;
    most = move;
    at = b.s[i];
  }
  return at;
}

}  // namespace

SceneMotion move_robot(const Scene& scene, std::string_view robot, const JointPath& path, const SimulationOptions& options,
                       const RunContext& context) {
  const ScenePack pack = pack_of(scene, robot);
  check_all_attached(scene, pack, std::string(robot));
  for (const JointVector& q : path.via()) pack.problem.robot->check({q.data(), static_cast<std::size_t>(q.size())}, "scene:motion");
  PackMotion moved = simulate(pack.problem, path, options, context);
  SceneMotion out;
  out.status = moved.status;
  out.message = moved.message;
  out.solves = moved.contact_solutions;
  for (const PackStep& step : moved.steps) out.times.push_back(step.t);
  out.equilibria = scene_states(scene, pack, moved.steps);
  for (const PackSnap& snap : moved.snaps)
    out.snaps.push_back({pack.problem.names[snap.rod], {snap.t, snap.rod, farthest_move_at(out, snap.t, snap.rod), snap.move, snap.energy_drop}});
  out.seconds = moved.seconds;
  return out;
}

}  // namespace tendril::dress_pack
