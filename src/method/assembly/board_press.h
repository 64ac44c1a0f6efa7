// A system of rods relaxed to its own shape and pressed onto a plane, by springs alone.
//
// Springs that draw a section to a place pull in all directions. Here each vertex is drawn to where it is in the plane, and across
// it to where the force that the plane must exert is right (multipliers): repeated, the springs do nothing within the plane, and the
// vertices lie in it exactly.
#pragma once

#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/assembly/board_graph.h"

namespace tendril::assembly {

/// Makes every vertex of the state a vertex of the problem's rods, so that all states are on one mesh.
void keep_vertices(SystemProblem& free, const SystemEquilibrium& state);

struct Relaxed {
  bool ok = false;
  std::string message;
  SystemEquilibrium state;  ///< its best-fit plane is z = 0
  int solves = 0;
};

/// Its own shape: what held it lets go. The board's axes follow from the shape alone (and from the sections' axes, where it leaves
/// them open), so that they move with the scene.
Relaxed relaxed_on_board(const SystemProblem& free, const SystemEquilibrium& routed, const RunContext& context);

/// Draws one place of a rod to a place on the board.
struct Peg {
  int rod = 0;
  double at = 0;  ///< arc length, m
  Vec3 to = Vec3::Zero();
};

/// One for each node of the layout.
std::vector<Peg> pegs_of(const SystemProblem& free, const BoardGraph& graph, const std::vector<Vec3>& layout);

struct Pressed {
  bool ok = false;
  std::string message;
  SystemEquilibrium state;
  double off = 0;  ///< m, of the vertex that is farthest from the plane
  int solves = 0;
};

Pressed pressed_flat(const SystemProblem& free, const SystemEquilibrium& relaxed, const std::vector<Peg>& pegs, const RunContext& context);

/// The same state elsewhere: places, orientations, forces in world axes.
void move_rigidly(SystemEquilibrium& state, const Frame& motion);

}  // namespace tendril::assembly
