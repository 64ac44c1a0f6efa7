#include "method/assembly/key_frames.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

/// All but the state itself.
SceneEquilibrium frame_of(const Scene& scene, const InstalledSystem& system, const SolveOptions& solve) {
  SceneEquilibrium frame;
  for (std::size_t k = 0; k < system.rods.size(); ++k) frame.rods.push_back({system.rods[k], system.free.rods[k], solve, {}});
  for (const std::string& name : system.branches) frame.branches.push_back({name, {}, {}});
  frame.obstacles = scene.bodies();
  frame.surroundings = system.surroundings;
  return frame;
}

KeyFrame key_frame(const SceneEquilibrium& frame, double t, const SystemProblem& held, const SystemEquilibrium& state) {
  SceneEquilibrium equilibrium = frame;
  std::vector<int> rods, branches;
  for (std::size_t k = 0; k < held.rods.size(); ++k) {
    equilibrium.rods[k].problem = held.rods[k];
    rods.push_back(static_cast<int>(k));
  }
  for (std::size_t b = 0; b < held.branches.size(); ++b) branches.push_back(static_cast<int>(b));
  equilibrium.take(state, rods, branches);
  equilibrium.systems.push_back({held, rods, branches});
  return {t, std::make_shared<const SceneEquilibrium>(std::move(equilibrium))};
}

}  // namespace

std::vector<KeyFrame> key_frames(const Scene& scene, const InstalledSystem& system, const std::vector<Grip>& grips, const std::vector<Passed>& passed,
                                 const Vec3& gravity, const SolveOptions& solve, int most) {
  std::vector<KeyFrame> frames;
  if (passed.empty()) return frames;
  const SceneEquilibrium frame = frame_of(scene, system, solve);
  SystemProblem held = held_by(system.free, grips, std::vector<Frame>(grips.size()));
  set_gravity(held, gravity);
  const std::size_t last = passed.size() - 1, kept = std::min<std::size_t>(last, std::max(1, most - 1));
  for (std::size_t i = 0; i <= kept; ++i) {
    const Passed& state = passed[kept == 0 ? 0 : i * last / kept];
    if (state.flowed) continue;
    std::vector<Frame> poses;
    for (const Grip& grip : grips) poses.push_back(system.pose(state.equilibrium, grip));
    place(held, grips, poses);
    frames.push_back(key_frame(frame, state.t, held, state.equilibrium));
  }
  return frames;
}

}  // namespace tendril::assembly
