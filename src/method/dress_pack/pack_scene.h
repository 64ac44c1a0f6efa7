// From a scene to the dress pack of one of its robots, and from a state of the pack back to what pictures and reports are made of.
#pragma once

#include <string_view>

#include "method/dress_pack/pack_simulation.h"
#include "scene/scene.h"

namespace tendril::dress_pack {

struct ScenePack {
  PackProblem problem;    ///< its bodies are numbered as Scene::bodies() has them
  std::vector<int> rods;  ///< the pack's rods by their numbers in the scene
  int robot = 0;          ///< in the scene
};

/// All rods that are attached to the robot. Obstacles, and the links of other robots where they stand now, are fixed bodies. Throws
/// UsageError, by name, for a robot that carries no rod, rods with branch points or dead moments, and as PackProblem::check() does.
ScenePack pack_of(const Scene& scene, std::string_view robot);

/// The pack's rods as they were solved with the robot at q, among the bodies as they then stand; the scene's other rods are left out.
/// `scene` must be the one that the pack was made of, unchanged. Throws UsageError where `solved` has another number of rods.
std::shared_ptr<SceneEquilibrium> scene_state(const Scene& scene, const ScenePack& pack, const JointVector& q, SystemEquilibrium solved);

/// The same from a step of a simulation, which is an equilibrium. `statics` must be of this pack.
std::shared_ptr<SceneEquilibrium> scene_state(const Scene& scene, const ScenePack& pack, const PackStep& step, PackStatics& statics);
/// ... and from all of them; packs with rods that slide, too.
std::vector<std::shared_ptr<SceneEquilibrium>> scene_states(const Scene& scene, const ScenePack& pack, const std::vector<PackStep>& steps);

}  // namespace tendril::dress_pack
