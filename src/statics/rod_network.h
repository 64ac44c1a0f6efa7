// Several rods that hang together at branch points, as Newton's method sees them: one list of nodes, the rods' in their
// order and then one for each branch point, and one sparse system. A single rod is a network without branch points.
#pragma once

#include <memory>
#include <vector>

#include "statics/joints.h"
#include "statics/rod_system.h"

namespace tendril {

class RodNetwork {
 public:
  /// `segments`: how many to aim at, by rod; `refinement`: every segment is cut into that many equal ones.
  RodNetwork(const SystemProblem& problem, const SolveOptions& options, const std::vector<int>& segments, int refinement = 1);

  int rods() const { return static_cast<int>(rods_.size()); }
  RodSystem& rod(int k) { return *rods_[k].system; }
  const RodSystem& rod(int k) const { return *rods_[k].system; }
  int first_node(int k) const { return rods_[k].first_node; }
  const SystemProblem& problem() const { return problem_; }

  int nodes() const { return pattern_.nodes; }
  int branch_node(int branch) const { return pattern_.nodes - static_cast<int>(problem_.branches.size()) + branch; }
  const BlockPattern& pattern() const { return pattern_; }
  const std::vector<HeldMask>& held() const { return held_; }
  const std::vector<RodSystem::Target>& targets() const { return targets_; }
  const std::vector<int>& edges_at(int target) const { return target_edges_[target]; }
  /// Nodes with unknowns that mean nothing (no target, no coupling), to be held.
  const std::vector<int>& dummies() const { return dummies_; }
  double size() const { return size_; }  ///< m, the longest rod

  /// What one unit of Newton's shift adds to a node's diagonal: rotation N m, position N/m.
  struct ShiftWeight {
    double position, rotation;
  };
  const std::vector<ShiftWeight>& shift_weights() const { return shift_weights_; }
  /// Shift that lifts a neutral direction above rounding: 1e-3, more for a very stiff stretch.
  double neutral_shift() const;

  /// Nodes from the rods' vertex frames and the branch points' frames; and back.
  RodState state_from(const std::vector<std::vector<Frame>>& vertices, const std::vector<Frame>& branches) const;
  StateView of_rod(int k, const RodState& state) const { return {state, rods_[k].first_node}; }
  Frame branch_frame(int branch, const RodState& state) const;

  /// Overwrites the system: every rod's own, sections at branch points not yet joined. Returns the energy.
  double assemble(const RodState& state, Stress stress, BlockSystem& system);
  /// After all terms are in: moves what belongs to the branch points there.
  void join(const RodState& state, Stress stress, BlockSystem& system) { joints_.join(state, stress, system); }
  /// Energy and gradient alone, not joined; and joined.
  double gradient(const RodState& state, std::vector<Vec6>& gradient);
  void join_gradient(const RodState& state, std::vector<Vec6>& gradient) const { joints_.join_gradient(state, gradient); }

  const std::vector<Joints::Joint>& joints() const { return joints_.all(); }

  /// Fills a step's joined unknowns from the branch points'.
  void complete(const RodState& state, std::vector<Vec6>& step) const { joints_.complete(state, step); }
  void apply(RodState& state, const std::vector<Vec6>& step, double share) const;
  /// After assemble(): see RodSystem::predict().
  void predict(const std::vector<Vec6>& step, double share);

  /// max(rotation in rad, move over the rod's length); infinite when something is not a number.
  double size_of(const std::vector<Vec6>& step) const;

  bool has_moments() const;
  void scale_moments(double share);
  std::vector<RodSystem::MomentTerm> moment_terms(const RodState& state) const;

  double false_stress() const;
  double stretch_stiffness() const;
  void cap_stretch_stiffness(double limit);

 private:
  struct Part {
    std::unique_ptr<RodSystem> system;
    int first_node;
  };
  std::vector<Joints::Joint> place_joints();
  void collect_holds();
  void collect_shift_weights();

  SystemProblem problem_;
  std::vector<Part> rods_;
  BlockPattern pattern_;
  Joints joints_;
  std::vector<HeldMask> held_;
  std::vector<RodSystem::Target> targets_;
  std::vector<std::vector<int>> target_edges_;
  std::vector<int> dummies_;
  double size_ = 0;
  std::vector<ShiftWeight> shift_weights_;
};

}  // namespace tendril
