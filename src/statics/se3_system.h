// One rod of fourth-order SE(3) elements: nodes are the vertices, four segments are worked on at once.
#pragma once

#include "rod/se3_element.h"
#include "statics/rod_system.h"

namespace tendril {

class Se3System final : public RodSystem {
 public:
  /// `fourth_order` false: the second-order element with constant strain, which stays convex under high tension.
  Se3System(const RodProblem& problem, RodMesh mesh, bool fourth_order = true);

  RodState state_from(const std::vector<Frame>& vertices) const override;
  std::vector<Frame> frames_of(StateView state) const override;
  SectionNodes section_at(int vertex) const override { return {vertex, vertex}; }
  void predict(const Vec6* step, double share) override;
  double false_stress() const override;
  void expect(StateView state, const std::vector<Vec3>& forces, const std::vector<Vec3>& moments) override;
  void cap_stretch_stiffness(double limit) override;
  void describe(StateView state, Equilibrium& out) override;
  void add_reaction(int hold, StateView state, const Vec6* gradient, Reaction& out) const override;

 protected:
  double assemble_elements(StateView state, Stress stress, BlockView system) override;
  double element_gradient(StateView state, Vec6* gradient) override;

 private:
  int packs() const { return static_cast<int>(segments_.size()); }
  int lanes_in(int pack) const { return std::min(4, mesh_.vertices() - 1 - 4 * pack); }
  Se3Ends<Pack> ends(StateView state, int pack) const;

  std::vector<Se3Segment<Pack>> segments_;
  std::vector<Wrench<Pack>> actual_, predicted_, geometric_;  ///< geometric: that of the last second derivative
  std::vector<WrenchRate<Pack>> rates_;
  bool fourth_order_;
};

}  // namespace tendril
