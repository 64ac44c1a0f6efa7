// Sensitivities of rods that were solved together, clips that slide and contact included.
//
// Where clips slide, their arc lengths a follow the parameters so that the energy Pi(a, p) of the equilibria stays
// stationary:   da/dp = - Pi_aa^-1 Pi_ap,   dm/dp = m_p + m_a da/dp.
// m_p, m_a and Pi_p are exact derivatives at given arc lengths; Pi_aa and Pi_ap are differences, of fourth order, of the
// exact Pi_a and Pi_p at equilibria with a clip shifted by a ten-thousandth of its way: right to about seven digits.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene_equilibrium.h"
#include "statics/contact_solver.h"
#include "statics/sensitivity.h"

namespace tendril {

class SystemSensitivity {
 public:
  /// Settles system `k` of the equilibrium to rounding and factorises its matrix there. Throws UsageError for rods of
  /// staggered elements and for a rod that was solved on another mesh than it asks for.
  SystemSensitivity(const SceneEquilibrium& equilibrium, int k, const RunContext& context);

  /// Empty, or why there are no derivatives.
  const std::string& why_not() const { return why_not_; }

  struct Answer {
    double value = 0;
    std::vector<double> derivatives;  ///< in the order of the parameters
  };
  Answer gradient(const Measure& measure, const std::vector<Parameter>& parameters) const;

  const RodNetwork& network() const { return middle_->network; }
  /// dq/dp at given arc lengths of sliding clips: see Sensitivity::motion.
  std::vector<Vec6> motion(const Parameter& parameter) const { return middle_->sensitivity->motion(parameter); }

 private:
  /// An equilibrium at given places of all clips.
  struct Settled {
    RodNetwork network;
    std::unique_ptr<ContactSolver> contact;
    RodState state;
    Status status = Status::solved;
    std::unique_ptr<Sensitivity> sensitivity;  ///< null: not solved
    Settled(const SystemProblem& problem, const SolveOptions& options, const std::vector<int>& segments)
        : network(problem, options, segments) {}
  };
  struct Clip {
    Parameter place;
    double step;                                        ///< m, of the differences
    std::vector<std::unique_ptr<Settled>> shifted;      ///< by -2, -1, 1, 2 steps
  };
  void read(const SceneEquilibrium& equilibrium, int k);
  std::unique_ptr<Settled> settle(const SystemProblem& problem, const RunContext& context) const;
  void shift_clips(const RunContext& context);
  std::vector<double> stationary_change(const Clip& clip, std::span<const Parameter> parameters) const;

  SystemProblem problem_;                   ///< clips that slide stand where they settled
  SolveOptions options_;
  SystemEquilibrium from_;
  std::vector<int> segments_;
  std::vector<std::vector<Frame>> frames_;
  std::vector<Frame> branches_;
  bool touches_ = false;
  std::vector<Clip> clips_;
  std::unique_ptr<Settled> middle_;
  std::string why_not_;
};

}  // namespace tendril
