// Exact first-order sensitivities of an equilibrium: how the rods move, and how what is measured on them changes, when a
// parameter changes.
//
// With the equilibrium g(q, p) = 0, its matrix K = dg/dq factorised once, and held unknowns that follow the holds:
//     forward:  K dq/dp = -g_p,        dm/dp = m_p + m_q . dq/dp;
//     adjoint:  K^T lambda = m_q,      dm/dp = m_p - lambda . g_p,
// so a parameter costs one solution forward, a measure one solution backward, whatever the number of the others. lambda . g_p
// for everything a rod is made of takes one pass over its segments (rod_slopes.h). A reaction is weight . g at held
// unknowns: it enters as a lambda that is not zero there. Dead moments make K unsymmetric in 3x3 blocks.
//
// K is that of the actual wrenches and the exact curvature of contact, whose law keeps its stiffness and its shifts.
// Not done: staggered elements. Clips that slide are taken at the places where they stand; see scene_gradient.h for more.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "statics/block_ldlt.h"
#include "statics/contact_network.h"
#include "statics/measure.h"
#include "statics/parameter.h"

namespace tendril {

class Sensitivity {
 public:
  /// Assembles and factorises at an equilibrium. `contacts`: null without surroundings. Both must outlive this. Throws
  /// UsageError for rods of staggered elements.
  Sensitivity(RodNetwork& network, const RodState& state, ContactNetwork* contacts = nullptr);
  Sensitivity(const Sensitivity&) = delete;  // its rods look at its state
  Sensitivity& operator=(const Sensitivity&) = delete;

  /// The same at another equilibrium of the network; without new set-up.
  void stand_at(const RodState& state);

  /// False at a singular matrix, where the equilibrium does not depend smoothly on its parameters; all results are then NaN.
  bool ok() const { return ok_; }

  /// Value and partial derivatives of a measure.
  MeasureSlopes measure(const Measure& measure) const;

  /// dq/dp: increments of the network's nodes (world translation, rotation in own axes) per unit of the parameter.
  std::vector<Vec6> motion(const Parameter& parameter) const;

  /// dm/dp by way of the motion, one measure after the other.
  std::vector<double> forward(std::span<const Measure> measures, const Parameter& parameter) const;

  /// dm/dp for all parameters by one adjoint solution.
  std::vector<double> gradient(const Measure& measure, std::span<const Parameter> parameters) const;

 private:
  struct Adjoint;
  struct MomentBlock {
    int node;
    Mat3 block;
  };
  void keep_held_rows();
  void take_out_held();
  void prepare_moments();
  void solve(std::vector<Vec6>& x, bool transposed) const;
  std::vector<Vec6> rows_times(const std::vector<Vec6>& x) const;
  Vec6 section_row_times(int node, const std::vector<Vec6>& x) const;
  void add_change(const ParameterEffect& effect, std::vector<Vec6>& gradient) const;
  std::vector<Vec6> motion_of(const ParameterEffect& effect, std::vector<Vec6>& change) const;
  Adjoint adjoint_of(MeasureSlopes slopes) const;
  void sum_up(Adjoint& adjoint) const;
  double along(const Adjoint& adjoint, const ParameterEffect& effect) const;
  double along_joint(const Adjoint& adjoint, const ParameterEffect::AtJoint& joint) const;
  bool in_same_rod(int a, int b) const;
  Vec3 moment_on(int section) const;
  void clear_held(std::vector<Vec6>& x) const;
  VertexShape shape_of(int rod) const;

  RodNetwork& network_;
  RodState state_;
  ContactNetwork* contacts_;
  std::vector<RodDerivatives> rods_;
  std::vector<std::vector<int>> breaks_, parts_;  ///< by rod
  BlockLdlt ldlt_;
  BlockSystem block_;
  bool ok_ = true;
  std::vector<Vec6> gradient_;          ///< of all terms, not joined
  std::vector<Vec6> joined_gradient_;
  BlockSystem unjoined_;                ///< empty without branch points
  struct HeldRow {
    int node, other;
    Mat6 block;                         ///< row: node, column: other
  };
  std::vector<HeldRow> held_rows_;      ///< joined matrix, rows of nodes with held unknowns
  std::vector<MomentBlock> moments_;
  std::vector<std::vector<Vec6>> moment_columns_;
  Eigen::MatrixXd moment_forward_, moment_backward_;
};

}  // namespace tendril
