// From a problem to an equilibrium: first guess or warm start, Newton and its fallbacks, then what the answer says.
#pragma once

#include <memory>
#include <string>

#include "base/run_context.h"
#include "statics/contact_solver.h"
#include "statics/newton.h"

namespace tendril {

/// Solves one rod again and again without new set-up. The problem was checked by the caller.
class RodSolver {
 public:
  /// `refinement`: every segment is cut into that many equal ones.
  RodSolver(const RodProblem& problem, const SolveOptions& options, int segments, int refinement = 1);

  Equilibrium solve(const RunContext& context, const Equilibrium* from = nullptr);

  /// Newton alone, from a state to a state: the inner loop of everything that solves often.
  NewtonOutcome iterate(RodState& state, bool warm, const RunContext& context);

  /// The state that solve() starts from.
  RodState starting_state(const Equilibrium* from) const;

  const RodSystem& system() const { return *system_; }

 private:
  NewtonOutcome with_fallbacks(RodState& state, bool warm, const RunContext& context, int& fallbacks);
  /// The staggered element copes with segments too long for the tension in them. Its solution starts this element, or
  /// stands in for it (substitute_) where the segments are too long indeed.
  NewtonOutcome by_staggered(RodState& state, int most, const RunContext& context);
  Equilibrium solve_in_contact(const RunContext& context, const Equilibrium* from);
  NewtonOutcome load_in_steps(RodState& state, const RunContext& context);
  void describe(const RodState& state, Equilibrium& out);

  SolveOptions options_;
  int segments_, refinement_;
  std::unique_ptr<RodSystem> system_;
  Newton newton_;
  std::unique_ptr<ContactSolver> contact_;  ///< null without surroundings
  std::unique_ptr<Equilibrium> substitute_;
  std::vector<Vec6> gradient_;
};

}  // namespace tendril
