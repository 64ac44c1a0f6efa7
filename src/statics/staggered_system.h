// One rod on the thesis's staggered grid. Node j holds vertex j and the rotation of the segment before it, so that the
// system stays 6x6 block tridiagonal; node 0's rotation is the ghost frame at the start, and one more node at the end,
// without a position of its own, is the ghost frame there.
#pragma once

#include "rod/staggered_element.h"
#include "statics/rod_system.h"

namespace tendril {

class StaggeredSystem final : public RodSystem {
 public:
  StaggeredSystem(const RodProblem& problem, RodMesh mesh, ClampRule rule);

  RodState state_from(const std::vector<Frame>& vertices) const override;
  std::vector<Frame> frames_of(StateView state) const override;
  SectionNodes section_at(int vertex) const override;
  void predict(const Vec6* step, double share) override;
  void cap_stretch_stiffness(double limit) override;
  void describe(StateView state, Equilibrium& out) override;
  void add_reaction(int hold, StateView state, const Vec6* gradient, Reaction& out) const override;

 protected:
  double assemble_elements(StateView state, Stress stress, BlockView system) override;
  double element_gradient(StateView state, Vec6* gradient) override;

 private:
  /// A bending cell between the rotations of two neighbouring nodes, or of one node and a held frame.
  struct Cell {
    BendCell bend;
    int a, b;         ///< nodes; -1: the held frame
    Quat held;
    int hold = -1;
    Vec3 actual = Vec3::Zero(), predicted = Vec3::Zero(), geometric = Vec3::Zero();
    Mat3 rate_a = Mat3::Zero(), rate_b = Mat3::Zero();
  };
  struct Stretch {
    StretchSegment segment;
    Vec3 actual = Vec3::Zero(), predicted = Vec3::Zero(), geometric = Vec3::Zero();
    Mat3 rate_r = Mat3::Zero(), rate_theta = Mat3::Zero();
  };

  int segments() const { return static_cast<int>(stretches_.size()); }
  void place_holds();
  void place_loads();
  void make_stretches();
  void make_cells();
  Cell cell_at(int vertex) const;
  const Quat& rotation_a(const Cell& cell, StateView state) const { return cell.a < 0 ? cell.held : state.q[cell.a]; }
  const Quat& rotation_b(const Cell& cell, StateView state) const { return cell.b < 0 ? cell.held : state.q[cell.b]; }

  ClampRule rule_;
  std::vector<Stretch> stretches_;
  std::vector<Cell> cells_;
  std::vector<int> orientation_hold_;  ///< per vertex: hold of the orientation, or -1
};

}  // namespace tendril
