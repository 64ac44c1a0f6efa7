// A dress pack from one configuration of the robot to another while its rods touch bodies: the ordinary solver, contact included,
// in steps so short that no body passes through a rod.
//
// Each step starts from the last solution carried along: vertices between two holds move with both, in the proportion of the arc
// lengths; and, straight on, from what the solver changed of the shape that was carried in the step before. Where they are near a
// body they may thereby move by half a radius relative to it; from there on the solver's own guards hold. A step that the solver does
// not make, or that takes a rod far from where it was carried, is made in two halves; the smallest that does is a snap-through.
#pragma once

#include <optional>
#include <string>

#include "method/dress_pack/pack_follower.h"
#include "method/dress_pack/pack_gaps.h"

namespace tendril::dress_pack {

struct ContactLimits {
  double largest_turn = 0.25;   ///< rad or m, of a joint in one step
  double smallest_turn = 1e-4;  ///< rad or m
  double tolerance = 1e-9;      ///< see SolveOptions
  int most_solutions = 5000;    ///< in all
};

class ContactFollower {
 public:
  /// The bodies must outlive this, and are moved by it.
  ContactFollower(PackBodies& bodies, const ContactLimits& limits);

  struct Outcome {
    Status status = Status::stalled;
    std::string message;                       ///< empty when solved
    double reached = 0;                        ///< share of the way
    std::vector<PackFollower::Snap> snaps;
    bool free = false;                         ///< the way ended because no rod is near a body any more
    bool ok() const { return status == Status::solved; }
  };

  /// The equilibrium at `q`. `from`: one of the pack that touches nothing, or null: from a first guess.
  Outcome start(const JointVector& q, const SystemEquilibrium* from, const RunContext& context);

  /// `leave`: end the way where no rod touches, or is nearer than 0.3 radii to, a body.
  Outcome advance(const JointVector& from, const JointVector& to, bool leave, const RunContext& context);

  const SystemEquilibrium& here() const { return here_; }
  /// Another equilibrium at the same configuration.
  void set_here(SystemEquilibrium equilibrium);

  int solutions() const { return solutions_; }
  long iterations() const { return iterations_; }  ///< factorisations

 private:
  SystemEquilibrium carried(const std::vector<Frame>& before, const std::vector<Frame>& after) const;
  SystemEquilibrium solve_at(const JointVector& q, const SystemEquilibrium* from, int most_iterations, const RunContext& context);
  void learn(const JointVector& way, const SystemEquilibrium& carried, const SystemEquilibrium& found);
  /// A carried shape with the last step's correction in proportion; nothing where the joints do not move straight on.
  std::optional<SystemEquilibrium> corrected(const JointVector& way, const SystemEquilibrium& carried) const;
  double haste(const SystemEquilibrium& moved, const JointVector& from, const JointVector& to);
  bool clear(const JointVector& q);
  void take(SystemEquilibrium found);
  const PackGaps& gaps();

  PackBodies& bodies_;
  const PackProblem& pack_;
  ContactLimits limits_;
  SystemProblem system_;
  SystemEquilibrium here_;
  std::unique_ptr<PackGaps> gaps_;
  PackGaps::Memory memory_;
  PackPlaces before_, after_;
  JointVector last_way_;            ///< of the joints in the last smooth step
  std::vector<Frame> correction_;   ///< what it changed of the carried shape, by node; empty: not known
  int solutions_ = 0;
  long iterations_ = 0;
};

}  // namespace tendril::dress_pack
