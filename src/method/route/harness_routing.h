// Routing of a branched harness between several connections: topology, junctions, branches, and how it settles under gravity.
//
//   tree         the best one on a grid of free places (harness_tree.h)
//   smoothing    each branch as straights and arcs. At a junction the two branches that continue each other best share a tangent
//                line (the trunk), the others leave under angles of their own
//   improvement  all branches, junction places and directions together, at the least cost that keeps what is demanded
//   certificate  bend radius and clearance along the true curves
//   equilibrium  rods joined at rigid junctions, held at the connections, under gravity and in contact, begun from the route
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "method/free_space/free_space.h"
#include "method/pcc/pcc_check.h"
#include "method/step.h"
#include "rod/section.h"
#include "scene/scene.h"

namespace tendril::routing {

struct HarnessOptions {
  /// 2 to 9. d3: the direction in which the branch leaves. The section is held in place and direction; about that direction it is
  /// turned so that the harness as it is routed has no twist.
  std::vector<Frame> connections;
  std::vector<std::string> names;          ///< of the connections, in messages and of rods; empty: "1", "2" ...
  std::vector<std::array<int, 2>> wires;   ///< pairs of connections, from 0; empty: each one with the first
  double bundling = 0.5;                   ///< 0: shortest wires ... 1: shortest harness; see harness_tree.h
  /// m: junctions nearer to each other than this along the tree become one. 0: twice end_straight, and min_bend_radius.
  double min_branch = 0;

  Section section;                         ///< of every branch; space.radius follows from it
  SpaceDemands space;
  double min_bend_radius = 0;              ///< m, of the centre line; above the section's radius
  double min_straight = 0;                 ///< m, between two bends
  double end_straight = 0;                 ///< m, at both ends of every branch
  double free_ends = 0;                    ///< m, from the connections, within which no clearance is kept; see PccDemands
  int max_bends = 6;                       ///< of one branch, 2 ... 30
  double grid = 20e-3;                     ///< m
  bool improve = true;                     ///< junctions move; else they stay on the grid

  bool equilibrium = true;                 ///< settle it
  double segment = 15e-3;                  ///< m, about the length of the rods' segments
  SolveOptions solve;
};

/// Where a branch ends.
struct HarnessEnd {
  bool junction = false;
  int number = 0;                          ///< of connections or junctions, from 0
};

struct HarnessBranch {
  std::string name;                        ///< of its rod
  HarnessEnd from, to;
  std::vector<int> wires;                  ///< numbers of the wires in it, rising
  PccPoints points;                        ///< the route
  double length = 0;                       ///< m
  CurveGap clearance;                      ///< of the route: m, between the surfaces, outside the free ends
  std::string clearance_to;                ///< the obstacle's name; empty: nothing within reach
  double min_bend_radius = 0;              ///< m, of the route; infinite: straight
  std::vector<Violation> violations;       ///< of the route, worst first

  /// In equilibrium, where there is one.
  double settled_length = 0, settled_bend_radius = 0;  ///< m
  Clearance settled_clearance;             ///< outside the free ends, measured as `clearance` is
};

struct HarnessJunction {
  Frame frame;                             ///< place; d3 along the trunk
  std::vector<int> branches;               ///< the two of the trunk first
  Frame settled;                           ///< in equilibrium
};

struct HarnessResult {
  bool ok = false;
  /// solved: the route keeps everything and, where asked for, came to rest. infeasible: no tree, or a branch that cannot keep
  /// what is demanded (`misses`). stalled: no equilibrium. cancelled, timeout.
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  std::vector<MethodStep> steps;
  std::vector<HarnessBranch> branches;
  std::vector<HarnessJunction> junctions;
  std::vector<std::string> misses;         ///< "branch 2 (1 to junction 1): 3.1 mm too near to 'engine' at 0.2 m", worst of each branch

  double harness_length = 0;               ///< m, of all branches
  double cable_length = 0;                 ///< m, over all wires
  double cost = 0;                         ///< m, as harness_tree.h weighs, of the route
  double preference = 0;                   ///< m: integral of FreeSpace::cost - 1 along the route
  int clips = 0;
  double length_in_collision = 0;          ///< m of the settled harness (else of the route) where it penetrates an obstacle

  HarnessOptions options;
  std::shared_ptr<const FreeSpace> space;
  std::shared_ptr<const SceneEquilibrium> equilibrium;  ///< rods named as the branches; null: none
};

/// Throws UsageError for options that make no sense.
HarnessResult route_harness(const Scene& scene, const HarnessOptions& options, const RunContext& context = {});

/// The scene's obstacles with the harness as rods, straight without load, joined at "junction 1" ..., held at the connections.
Scene scene_of(const Scene& scene, const HarnessResult& harness);

}  // namespace tendril::routing
