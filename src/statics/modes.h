// How stiffly an equilibrium resists being disturbed, and which other equilibria the same holds allow.
#pragma once

#include "statics/network_solver.h"

namespace tendril {

/// A way in which the rods can be disturbed, with the energy it costs. `eigenvalue`: of K v = lambda M v, where M gives a
/// turn of a section (rad) the weight EI/L^2 times its share of the length and a move (m) a hundredth of that over L^2, EI
/// and L of the rod in question; so lambda is a pure number, about 10 to 100 for the first bending mode of a clamped rod.
struct Eigenmode {
  double eigenvalue = 0;
  std::vector<Vec6> shape;  ///< a step of all nodes, the largest of size 1 (rad, or the rod's length)
};

/// The `count` softest modes at a state, softest first, by subspace iteration; unstable ones have negative eigenvalues.
std::vector<Eigenmode> softest_modes(NetworkSolver& solver, const RodState& state, int count);

struct ModeSearch {
  int modes = 3;          ///< along so many of the softest modes, both ways
  double push = 0.6;      ///< size of those disturbances: rad, or share of the length
  int most_starts = 40;
};

/// Other stable equilibria for the same holds: started from first guesses that bulge to other sides or are twisted by
/// further full turns, rod by rod, and from `found` disturbed along its softest modes. By growing energy, `found` not among
/// them; states that differ by less than 1e-4 of the length count as one. Completeness is not promised.
std::vector<SystemEquilibrium> other_equilibria(const SystemProblem& problem, const SolveOptions& options,
                                                const RunContext& context, const SystemEquilibrium& found,
                                                const ModeSearch& search = {});

}  // namespace tendril
