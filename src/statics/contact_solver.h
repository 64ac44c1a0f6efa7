// From a first guess among obstacles to an equilibrium that neither penetrates nor has passed through anything.
//
// Two stages of the contact law, soft then hard, each solved by Newton's method under the step guards; then the augmented
// Lagrangian takes the remaining overlap away: shift_i <- max(0, shift_i + radius - distance), solved again, until the
// deepest overlap is small. Where an edge or a bump pokes between two contact points a sliding point follows it.
// Not done: friction, self-contact, supports that stand inside an obstacle.
#pragma once

#include <optional>
#include <string>

#include "statics/contact_network.h"
#include "statics/contact_start.h"

namespace tendril {

struct ContactOptions {
  double overlap = 8e-4;      ///< deepest overlap that is aimed at, in radii, also between contact points
  int most_updates = 20;      ///< of the augmented Lagrangian
};

/// An overlap beyond this, in radii, is never reported as solved.
inline constexpr double largest_solved_overlap = 1e-3;

struct ContactOutcome {
  NewtonOutcome newton;       ///< of the last run; iterations over all
  int fallbacks = 0;
  int updates = 0;
  double deepest = 0;         ///< m, looked at more finely than the contact points lie
  std::string message;        ///< empty, or what the user should know
};

class ContactSolver {
 public:
  /// At least one rod of `network` must have surroundings.
  ContactSolver(RodNetwork& network, const SolveOptions& options, const ContactOptions& contact = {});

  /// For motions in small steps, whose forces are known nearly: the law of a warm start gives way by some hundredths of a radius
  /// under them. Under one far too hard for them contact opens as soon as a start is a thousandth of a radius off, and Newton's
  /// method flies from one side of the surface to the other.
  void fit_to_forces() { fitted_ = true; }

  /// Where a cold start begins: the first guess, changed where it would cross the surroundings (contact_start.h).
  RodState clear_start() { return tendril::clear_start(*network_, terms_).state; }

  /// A given shape, led around what it crosses; nothing when it is free of crossings.
  std::optional<RodState> led_around(const RodState& state);

  /// Moves `state` to an equilibrium. `from`: a solution whose contact forces to start from; null: a cold start.
  ContactOutcome run(RodState& state, const SystemEquilibrium* from, const RunContext& context);

  /// One Newton run on a given penalty law, without updates: for comparison with penalty models.
  ContactOutcome run_penalty(RodState& state, double stiffness, const RunContext& context);

  /// Adds gradient and exact second derivative of contact at a state to a system.
  void add_exact(const RodState& state, BlockSystem& system);

  /// Adds the contact forces' part of the gradient to that of the rod.
  void add_gradient(const RodState& state, std::vector<Vec6>& gradient);

  /// Fills contacts, deepest_penetration and energy.contact of one rod.
  void describe(const RodState& state, int rod, Equilibrium& out);

  /// Of a rod that has surroundings.
  ContactTerms& terms(int rod = 0) { return *terms_.of_rod(rod); }
  ContactNetwork& contacts() { return terms_; }
  Newton& newton() { return newton_; }

 private:
  ContactOutcome attempt(RodState& state, const SystemEquilibrium* from, double hardness, const RunContext& context);
  ContactOutcome run_soft(RodState& state, const SystemEquilibrium* from, const RunContext& context);
  enum class Start { cold, warm };
  NewtonOutcome stage(RodState& state, Start start, double tolerance, int most_iterations, bool descend,
                      const RunContext& context);
  NewtonOutcome settle(RodState& state, const RodState& start, ContactOutcome& out, const RunContext& context);
  void remove_overlap(RodState& state, ContactOutcome& out, const RunContext& context);
  void judge(const RodState& state, ContactOutcome& out);
  double loose(double step) const;
  bool over(const ContactOutcome& out) const;
  std::string place_of(const ContactNetwork::Rod& rod, double s, const Vec3& at) const;
  std::string crossing_at(const ContactNetwork::Crossing& crossing) const;
  std::string overlap_at(const ContactNetwork::Deepest& deepest, const RodState& state) const;

  RodNetwork* network_;
  SolveOptions options_;
  ContactOptions contact_;
  ContactNetwork terms_;
  Newton newton_;
  int used_ = 0;       ///< factorisations so far
  bool fitted_ = false;
  bool another_try_ = false;  ///< then warm runs meet an indefinite matrix by a shift, not by leaving out the wrench
  BlockSystem scratch_;
};

}  // namespace tendril
