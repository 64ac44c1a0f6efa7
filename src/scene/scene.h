// The world: gravity, obstacles, robots and rods. Nothing in it costs anything until it is used.
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
#include "scene/placed_robot.h"
#include "scene/placed_rod.h"
#include "scene/scene_equilibrium.h"
#include "statics/problem.h"

namespace tendril {

/// A mutable collection of obstacles, robots and rods. The obstacles' distance trees are built when the first rod is solved or
/// measured near them, and kept with their meshes.
class Scene {
 public:
  /// Gravity in m/s^2, world axes; zero: the term is left out. Throws UsageError unless finite.
  explicit Scene(const Vec3& gravity = Vec3::Zero());

  const Vec3& gravity() const { return gravity_; }

  /// A scene with the same gravity, obstacles and robots, whose trees and distance fields it shares.
  Scene without_rods() const;

  /// Throws UsageError for an empty name, a name that is taken, or a clearance that is negative or not finite.
  void add(PlacedObstacle obstacle);
  /// Throws UsageError for a name that is taken.
  PlacedRod& add(PlacedRod rod);
  /// Joins places of rods to a rigid branch point (see make_branch), held at `held` or free. Throws UsageError, and changes
  /// nothing, for a name that is taken and a place that belongs to another branch point.
  PlacedBranch& join(std::string name, const std::vector<BranchPlace>& places, const std::optional<Frame>& held);
  /// Throws UsageError as PlacedRobot::check() does, for names that are taken (those of its links' bodies included) and for meshes that
  /// cannot be read.
  void add(PlacedRobot robot);
  /// Moves a robot's joints, and with its links the rods' holds that are attached to them. Throws UsageError, and changes
  /// nothing, for values that do not fit the robot or are beyond its limits.
  void set_joints(std::string_view robot, const std::vector<double>& joints);
  /// Holds a rod's section by a robot's link: the hold goes with the link. Throws UsageError for unknown names and links,
  /// frames that are not finite, places outside the rod, and places that are held or joined already.
  void attach(const Attachment& attachment);
  /// Removes an obstacle, a robot, a rod or a branch point. Throws UsageError for an unknown name, with the nearest, for a
  /// rod that belongs to a branch point and for a robot that rods are attached to.
  void remove(std::string_view name);

  const std::vector<PlacedObstacle>& obstacles() const { return obstacles_; }
  const std::vector<PlacedRobot>& robots() const { return robots_; }
  /// All that is solid: the obstacles, and after them the robots' links where they are now.
  const std::vector<PlacedObstacle>& bodies() const;
  const std::vector<std::unique_ptr<PlacedRod>>& rods() const { return rods_; }
  const std::vector<std::unique_ptr<PlacedBranch>>& branches() const { return branches_; }
  /// Throws UsageError for an unknown name, with the nearest.
  PlacedBranch& branch(std::string_view name) const;
  PlacedRod& rod(std::string_view name) const;
  const PlacedObstacle& obstacle(std::string_view name) const;
  const PlacedRobot& robot(std::string_view name) const;

  /// bodies() as statics sees them; null where nothing is solid. Builds no tree: the first query near a mesh does.
  std::shared_ptr<const Surroundings> surroundings() const;

  /// Coarse fields of the distance to the obstacles, kept for the next search through the same ones. Made by the first call.
  const std::shared_ptr<FieldStore>& fields() const;

  /// The statics problem of one rod with only the terms that it needs. Obstacles have the numbers of bodies().
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
  int index_of_robot(std::string_view name) const;
  std::vector<Fastening> fastenings_of(const PlacedRod& rod) const;
  void check_removable(const PlacedRobot& robot) const;
  void forget_bodies();

  Vec3 gravity_;
  std::vector<PlacedObstacle> obstacles_;
  std::vector<PlacedRobot> robots_;
  std::vector<std::unique_ptr<PlacedRod>> rods_;
  std::vector<std::unique_ptr<PlacedBranch>> branches_;
  mutable std::optional<std::vector<PlacedObstacle>> bodies_;
  mutable std::shared_ptr<const Surroundings> surroundings_;
  mutable std::shared_ptr<FieldStore> fields_;
};

}  // namespace tendril
