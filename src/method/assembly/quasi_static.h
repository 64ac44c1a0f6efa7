// A system driven from equilibrium to equilibrium in small steps, with what happens on the way: jumps, contact, limits.
//
// A step's size adapts to Newton's passes and to how far vertices move. A step is taken back and halved where a vertex moves much
// farther than what drives it, where the straight between a point's old and new place crosses a surface, or where there is no
// equilibrium. Where even the least step jumps or fails, the rods run down their energy under springs that draw every vertex to
// where it is (proximal flow), so that traces stay continuous through a snap-through.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "statics/motion.h"

namespace tendril::assembly {

struct DriveOptions {
  double radius = 0;              ///< m, of the thickest rod
  double first_step = 1, most_step = 4, least_step = 0.05;  ///< of what drives, in radii
  bool flow = true;               ///< through snap-throughs; false: they end the drive
  bool stays = false;             ///< what drives goes no way (springs fade, gravity comes): only radii tell what jumps
  double most_strain = 0;         ///< 0: any
  double min_bend_radius = 0;     ///< m; 0: any
  int most_steps = 5000;
  long most_iterations = 20'000;  ///< Newton's, of all steps: what needs more is jammed
  /// What speaks against going from one state to the next, in words; empty: nothing. Null: nobody is asked.
  std::function<std::string(const SystemEquilibrium& from, const SystemEquilibrium& to)> judge;
  /// Why no step, however small, leads on from a state, in words; empty: it may. It ends the drive there. Null: nobody is asked.
  std::function<std::string(const SystemEquilibrium& state)> jam;
};

/// One equilibrium on the way.
struct Passed {
  double t = 0;
  SystemEquilibrium equilibrium;
  bool flowed = false;            ///< on the way down after a snap-through: not in equilibrium with what drives alone
};

struct Drive {
  enum class End { arrived, no_equilibrium, snap, crossing, collision, jammed, strain, bend_radius, stopped };
  End end = End::no_equilibrium;
  std::string message;            ///< where along what, and why; empty: arrived
  std::vector<Passed> passed;     ///< the first is where it began
  int snaps = 0, solves = 0;
  long iterations = 0;
  double worst_strain = 0, least_bend_radius = 0;  ///< over all that passed; m
  bool ok() const { return end == End::arrived; }
};

/// m: the farthest that any vertex is from itself in another state on the same mesh.
double farthest_move(const SystemEquilibrium& a, const SystemEquilibrium& b);

/// `from`: in equilibrium with `path` at t = 0. `moved`: m, how far what drives goes between two times. All problems of the path
/// have the same rods, holds and springs but for poses, stiffnesses, gravity.
Drive drive(const SystemProblem& problem, const ProblemPath& path, const std::function<double(double from, double to)>& moved,
            const SystemEquilibrium& from, const DriveOptions& options, const SolveOptions& solve, const RunContext& context = {});

}  // namespace tendril::assembly
