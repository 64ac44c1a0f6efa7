// Routing of a branched harness between several connections: topology, junctions, branches, and how it settles under gravity.
//
//   tree         the best one on a grid of free places (harness_tree.h)
//   smoothing    each branch as straights and arcs. At a junction the two branches that continue each other best share a tangent
//                line (the trunk), the others leave under angles of their own
//   improvement  all branches, junction places and directions together, at the least cost that keeps what is demanded
//   certificate  bend radius and clearance along the true curves
//   equilibrium  rods joined at rigid junctions, held at the connections, under gravity and in contact, begun from the route
//   refinement   unstressed lengths, directions at junctions and clips, so that what the route keeps is kept at rest as well
//                (harness_refinement.h)
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

  /// Where the harness at rest misses something: adjust it. Settled harnesses only.
  bool refine = true;
  double max_stretch = 2e-3;               ///< of a refined branch's centre line at rest: a harness is laid, not strung
  int max_clips = 0;                       ///< on obstacles that take clips (PlacedObstacle::clip), over the whole harness
  double clip_reach = 0.05;                ///< m, from the harness's surface to what it is clipped to
  int restarts = 2;                        ///< with bend radius and clearance in reserve, where that is not enough
};

/// Where a branch ends.
struct HarnessEnd {
  bool junction = false;
  int number = 0;                          ///< of connections or junctions, from 0
};

/// Holds the section of a branch in the frame that it has on the route.
struct HarnessClip {
  int branch = 0;
  double route_at = 0, at = 0;             ///< m, along the route and along the unstressed rod
  Frame frame;
  std::string obstacle;                    ///< to which it is fastened
  double force = 0;                        ///< N, that it bears at rest
};

/// What the harness is built to.
struct HarnessDesign {
  std::vector<double> lengths;             ///< m, by branch, of the unstressed rods
  std::vector<std::vector<Frame>> sections;///< by junction, in the order of its branches: their ends seen from the junction
  std::vector<HarnessClip> clips;          ///< by branch, then rising
};

struct HarnessBranch {
  std::string name;                        ///< of its rod
  HarnessEnd from, to;
  std::vector<int> wires;                  ///< numbers of the wires in it, rising
  double factor = 1;                       ///< what a metre of it costs; see harness_tree.h
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
  std::vector<double> wire_lengths;        ///< m, from connection to connection
  double length_in_collision = 0;          ///< m of the settled harness (else of the route) where it penetrates an obstacle

  /// Without refinement the route's lengths and directions, and no clips.
  HarnessDesign design;
  std::vector<std::string> settled_misses; ///< "branch 2: gap 3.1 mm, 5 mm demanded": at rest, though the route keeps it
  double missed_share = 0;                 ///< sum over these, as shares of what is demanded
  int equilibria = 0;                      ///< that refinement looked at
  int restarts = 0;                        ///< that it took
  std::string refinement;                  ///< what there is to say about it

  HarnessOptions options;
  std::shared_ptr<const FreeSpace> space;
  std::shared_ptr<const SceneEquilibrium> equilibrium;  ///< rods named as the branches; null: none
};

/// Throws UsageError for options that make no sense.
HarnessResult route_harness(const Scene& scene, const HarnessOptions& options, const RunContext& context = {});

/// The scene's obstacles with the harness as rods, straight without load, joined at "junction 1" ..., held at the connections.
Scene scene_of(const Scene& scene, const HarnessResult& harness);

}  // namespace tendril::routing
