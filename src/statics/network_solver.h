// From a problem to an equilibrium: first guess or warm start, Newton and its fallbacks, then what the answer says.
#pragma once

#include <memory>
#include <string>

#include "base/run_context.h"
#include "statics/contact_solver.h"
#include "statics/newton.h"

namespace tendril {

/// Solves one system of rods again and again without new set-up. The problem was checked by the caller.
class NetworkSolver {
 public:
  /// As many segments as the rods ask for; `refinement`: every segment is cut into that many equal ones.
  NetworkSolver(const SystemProblem& problem, const SolveOptions& options, int refinement = 1);

  SystemEquilibrium solve(const RunContext& context, const SystemEquilibrium* from = nullptr);

  /// See ContactSolver.
  void fit_contact_to_forces() {
    if (contact_) contact_->fit_to_forces();
  }

  /// Newton alone, from a state to a state: the inner loop of everything that solves often.
  NewtonOutcome iterate(RodState& state, bool warm, const RunContext& context);

  /// The state that solve() starts from.
  RodState starting_state(const SystemEquilibrium* from) const;

  /// The whole way, fallbacks included, from a state.
  SystemEquilibrium solve_from(RodState state, bool warm, const RunContext& context);

  /// The exact second derivative at a state, contact included, held unknowns taken out; not yet factorised.
  void assemble_exact(const RodState& state, StepSystem& linear);

  /// Fills everything but status, message and counts.
  void describe(const RodState& state, SystemEquilibrium& out);

  const RodNetwork& network() const { return *network_; }
  RodNetwork& network() { return *network_; }

 private:
  bool on_same_mesh(const SystemEquilibrium& from) const;
  NewtonOutcome with_fallbacks(RodState& state, bool warm, const RunContext& context, int& fallbacks);
  /// The staggered element copes with segments too long for the tension in them. Its solution starts this element, or
  /// stands in for it (substitute_) where the segments are too long indeed.
  NewtonOutcome by_staggered(RodState& state, int most, const RunContext& context);
  SystemEquilibrium solve_in_contact(const RunContext& context, const SystemEquilibrium* from);
  NewtonOutcome load_in_steps(RodState& state, const RunContext& context);
  void describe_joints(const RodState& state, const std::vector<Vec6>& gradient, SystemEquilibrium& out) const;

  SolveOptions options_;
  int refinement_;
  std::unique_ptr<RodNetwork> network_;
  Newton newton_;
  std::unique_ptr<ContactSolver> contact_;  ///< null without surroundings in reach
  std::unique_ptr<SystemEquilibrium> substitute_;
  std::vector<Vec6> gradient_;
};

}  // namespace tendril
