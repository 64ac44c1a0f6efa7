// Mixed-stress Newton with a shift, and energy descent as its fallback.
//
// Plain Newton on the energy stalls on the stretch stiffness of slender rods: a bent segment looks stretched until all of
// it has moved. Mixed-stress Newton takes residual and material stiffness from the true strains, but the wrench in the
// geometric terms from the linearised strains of the step before, which never saw that false stretch.
#pragma once

#include <optional>
#include <vector>

#include "base/run_context.h"
#include "statics/rod_network.h"
#include "statics/step_system.h"

namespace tendril {

/// Energy terms beside the rod's own: contact. Null in a scene without obstacles.
class FurtherTerms {
 public:
  virtual ~FurtherTerms() = default;

  /// Adds gradient and second derivative at a state; `actual`: exact curvature, else the mixed-stress one. Returns the energy.
  virtual double assemble(const RodState& state, Stress stress, BlockSystem& system) = 0;

  /// Energy alone, for descent.
  virtual double energy(const RodState& state) = 0;

  /// How much (0 ... 1) of `share` of a step may be made without crossing a surface.
  virtual double allowed(const RodState& state, const std::vector<Vec6>& step, double share) = 0;

  /// A blocked step may be tried again after the terms have stiffened: true when the system must be assembled anew.
  virtual bool stiffen(const RodState& state, const std::vector<Vec6>& step, double share) = 0;

  /// The step was made: keep the linearised forces for the next mixed-stress iteration.
  virtual void stepped(const RodState& before, const std::vector<Vec6>& step, double share) = 0;
};

struct NewtonOptions {
  double tolerance = 1e-9;
  int max_iterations = 40;
  bool stable_only = true;
  bool warm = false;       ///< start from the actual wrenches, not from none
  bool continued = false;  ///< start from the wrenches that the run before ended with
  /// A matrix that the predicted wrench makes indefinite is replaced by the one without any, which is positive, before a
  /// shift is tried. Steps that guards cut short leave wrenches that balance nothing.
  bool convex = false;
  bool descend = false;    ///< energy descent (Armijo) instead of mixed stress
};

struct NewtonOutcome {
  Status status = Status::stalled;
  int iterations = 0;       ///< factorisations
  double last_step = 0;
  int negative_pivots = 0;  ///< of the last unshifted matrix
};

class Newton {
 public:
  Newton(RodNetwork& network, FurtherTerms* further) : network_(network), further_(further), linear_(network) {}

  const StepSystem& linear() const { return linear_; }

  /// Moves `state` to an equilibrium, or as far as it gets.
  NewtonOutcome run(RodState& state, const NewtonOptions& options, const RunContext& context);

  /// Sizes of the steps that the method asked for in all runs since the record was begun: how the computation converged.
  const std::vector<double>& record() const { return record_; }
  void begin_record() { record_.clear(); }
  void add_to_record(const std::vector<double>& sizes) { record_.insert(record_.end(), sizes.begin(), sizes.end()); }

 private:
  void assemble(const RodState& state);
  std::optional<double> guarded_share(const RodState& state, double share);
  double descending_share(const RodState& state, double share);
  double armijo_share(const RodState& state, double share);
  double energy_at(const RodState& state);
  bool settled(double size, const NewtonOptions& options);
  void leave_saddle(RodState& state);
  double damped(double size);
  void factor(const RodState& state, const NewtonOptions& options, NewtonOutcome& out);

  RodNetwork& network_;
  FurtherTerms* further_;
  StepSystem linear_;
  std::vector<Vec6> step_, scratch_;
  std::vector<double> record_;
  double energy_ = 0;

  // How the computation stands.
  Stress stress_ = Stress::zero;  ///< of the last assembly
  double previous_size_ = 0;      ///< of the step before
  double smallest_size_ = 0;
  int blocked_ = 0;               ///< rounds in which the guards cut the step short
  bool lingering_ = false;        ///< close to the solution, and steps hardly shrink
  int not_shrinking_ = 0;         ///< rounds at the level of rounding
  int mode_moves_ = 0;
  double smallest_of_cycle_ = 0;
  int since_smallest_ = 0;        ///< rounds since a step was clearly smaller than all before
  int left_out_ = 0;              ///< times that the wrench was left out of an indefinite matrix
};

}  // namespace tendril
