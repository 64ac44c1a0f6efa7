// The world: gravity, obstacles and rods. Nothing in it costs anything until it is used.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/run_context.h"
#include "geometry/field_store.h"
#include "scene/placed_obstacle.h"
#include "scene/placed_branch.h"
#include "scene/placed_rod.h"
#include "scene/scene_equilibrium.h"
#include "statics/problem.h"

namespace tendril {

/// A mutable collection of obstacles and rods. The obstacles' distance trees are built when the first rod is solved or
/// measured near them, and kept with their meshes.
class Scene {
 public:
  /// Gravity in m/s^2, world axes; zero: the term is left out. Throws UsageError unless finite.
  explicit Scene(const Vec3& gravity = Vec3::Zero());

  const Vec3& gravity() const { return gravity_; }

  /// A scene with the same gravity and obstacles, whose trees and distance fields it shares.
  Scene without_rods() const;

  /// Throws UsageError for an empty name, a name that is taken, or a clearance that is negative or not finite.
  void add(PlacedObstacle obstacle);
  /// Throws UsageError for a name that is taken.
  PlacedRod& add(PlacedRod rod);
  /// Joins places of rods to a rigid branch point (see make_branch), held at `held` or free. Throws UsageError, and changes
  /// nothing, for a name that is taken and a place that belongs to another branch point.
  PlacedBranch& join(std::string name, const std::vector<BranchPlace>& places, const std::optional<Frame>& held);
  /// Removes an obstacle, a rod or a branch point. Throws UsageError for an unknown name, with the nearest, and for a rod
  /// that belongs to a branch point.
  void remove(std::string_view name);

  const std::vector<PlacedObstacle>& obstacles() const { return obstacles_; }
  const std::vector<std::unique_ptr<PlacedRod>>& rods() const { return rods_; }
  const std::vector<std::unique_ptr<PlacedBranch>>& branches() const { return branches_; }
  /// Throws UsageError for an unknown name, with the nearest.
  PlacedBranch& branch(std::string_view name) const;
  PlacedRod& rod(std::string_view name) const;
  const PlacedObstacle& obstacle(std::string_view name) const;

  /// The obstacles as statics sees them; null without obstacles. Builds no tree: the first query near a mesh does.
  std::shared_ptr<const Surroundings> surroundings() const;

  /// Coarse fields of the distance to the obstacles, kept for the next search through the same ones. Made by the first call.
  const std::shared_ptr<FieldStore>& fields() const;

  /// The statics problem of one rod with only the terms that it needs.
  RodProblem problem_of(const PlacedRod& rod) const;

  /// Rods that hang together, with the branch points between them; every rod is in one of them. Numbers are those of
  /// rods() and branches(). The problems have no surroundings. Throws UsageError, by name, for rods that nothing holds.
  struct System {
    SystemProblem problem;
    std::vector<int> rods, branches;
  };
  std::vector<System> systems() const;

  /// Static equilibrium of every rod. `from`: start from the rods of the same name in an earlier equilibrium.
  /// Throws UsageError for a scene without rods and for problems that make no sense (see RodProblem::check); a
  /// computation that does not converge, is cancelled or runs out of time is a result with that status.
  SceneEquilibrium solve(const SolveOptions& options = {}, const RunContext& context = {},
                         const SceneEquilibrium* from = nullptr) const;

 private:
  void check_free(std::string_view name, const char* who) const;
  void check_held(const System& system) const;
  int index_of_rod(std::string_view name) const;

  Vec3 gravity_;
  std::vector<PlacedObstacle> obstacles_;
  std::vector<std::unique_ptr<PlacedRod>> rods_;
  std::vector<std::unique_ptr<PlacedBranch>> branches_;
  mutable std::shared_ptr<const Surroundings> surroundings_;
  mutable std::shared_ptr<FieldStore> fields_;
};

}  // namespace tendril
