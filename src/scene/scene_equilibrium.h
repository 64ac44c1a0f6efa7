// The answer of a scene's solve: one equilibrium a rod, and what is measured on them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/clearance.h"
#include "scene/placed_obstacle.h"
#include "statics/equilibrium.h"
#include "statics/problem.h"

namespace tendril {

/// One rod of a scene as it was solved. `problem.surroundings` belongs to the scene's equilibrium.
struct SolvedRod {
  std::string name;
  RodProblem problem;
  SolveOptions options;
  Equilibrium equilibrium;
};

/// One branch point of a scene as it was solved.
struct SolvedBranch {
  std::string name;
  Frame frame;
  Reaction support;  ///< what holds it: N and N m in world axes, about its place; zero but for rounding where it is free
};

/// Rods that were solved together, and the branch points between them, by their numbers in the scene's equilibrium.
struct SolvedSystem {
  SystemProblem problem;
  std::vector<int> rods, branches;
};

struct SceneEquilibrium;

/// What a search for modes found; see scene_modes.h.
struct SceneModes {
  std::vector<double> eigenvalues;                          ///< softest first
  std::map<std::string, std::vector<Vec3>> softest;         ///< by rod: moves of its vertices, m, along the softest mode
  std::vector<std::shared_ptr<SceneEquilibrium>> others;    ///< other stable equilibria, by growing energy
};

/// A scene (or rather a picture taken of it when it was solved: later changes of the scene do not show here) in static
/// equilibrium. Immutable once made.
struct SceneEquilibrium {
  std::vector<SolvedRod> rods;
  std::vector<SolvedBranch> branches;
  std::vector<SolvedSystem> systems;
  std::vector<PlacedObstacle> obstacles;  ///< numbered as in `surroundings`: the obstacles, then the robots' links
  std::shared_ptr<const Surroundings> surroundings;  ///< null without obstacles
  double seconds = 0;            ///< all rods, without building the obstacles' trees
  double seconds_for_trees = 0;
  std::optional<SceneModes> modes;  ///< where they were asked for

  bool ok() const { return status() == Status::solved; }
  Status status() const;          ///< the worst of the rods': cancelled, timeout, infeasible, stalled, solved
  std::string message() const;    ///< "solved", or each rod that is not, by name, and why
  int iterations() const;         ///< sum over the systems
  std::vector<double> steps() const;  ///< of Newton's method, as in Equilibrium, in the system that took the most of them
  double residual() const;        ///< N, the largest of the rods'
  bool stable() const;            ///< every rod is stable
  Energy energy() const;          ///< J, summed over the rods
  /// Discretisation error of the centre lines, m: the rods' largest; invalid as soon as one is. Nothing unless asked for.
  std::optional<ErrorEstimate> error() const;
  double deepest_penetration() const;  ///< m

  /// Throws UsageError with the nearest name.
  const SolvedRod& rod(std::string_view name) const;
  const SolvedBranch& branch(std::string_view name) const;

  /// The rods and branch points of these numbers in `like`, found here by name, to start from; nothing when one is missing.
  std::optional<SystemEquilibrium> part(const SceneEquilibrium& like, const std::vector<int>& rods,
                                        const std::vector<int>& branches) const;
  /// Takes over what was solved together.
  void take(SystemEquilibrium solved, const std::vector<int>& rods, const std::vector<int>& branches);

  /// Index of an obstacle by name. Throws UsageError with the nearest name.
  int obstacle(std::string_view name) const;

  /// The closest surface point of the obstacle `to` (-1: of any) to `p`; infinitely far, with obstacle -1, without one.
  ClosestPoint closest(const Vec3& p, int to = -1) const;
  /// The same for a place of a rod at arc length `s` (m): what the rod is fastened to near there (RodProblem::fastenings) does not
  /// count.
  ClosestPoint closest(const SolvedRod& rod, double s, const Vec3& p, int to = -1) const;

  /// The smallest gap between rod `from` and the obstacle `to` (empty: any), in arc lengths `begin` ... `end` (m;
  /// negative `end`: the rod's length). Infinite, with obstacle -1, when there is none. What the rod is fastened to does not count
  /// near where it is.
  Clearance clearance(const SolvedRod& from, int to = -1, double begin = 0, double end = -1) const {
    return clearance(from.problem, from.equilibrium, to, begin, end);
  }
  /// The same for another state of a rod, or another rod, in these surroundings.
  Clearance clearance(const RodProblem& problem, const Equilibrium& state, int to = -1, double begin = 0, double end = -1) const;

  /// What an engineer looks at on one rod: the smallest gap of all, then that to every other obstacle which requires
  /// some clearance. Empty without obstacles.
  struct JudgedGap {
    Clearance gap;
    double required = 0;     ///< m
    bool too_close = false;  ///< see too_close()
  };
  std::vector<JudgedGap> judged_gaps(const SolvedRod& rod) const;

  /// What the support, or the branch point, does to the rod at a hold or joined place: force in N and moment in N m in world
  /// axes. Throws UsageError where the rod is neither held nor joined.
  Reaction reaction(const SolvedRod& rod, double at) const;
};

}  // namespace tendril
