// Sections that belong to a branch point: their unknowns are expressed by those of the branch point's node.
//
// A section whose frame seen from the branch point (r, R) is (g, Q) moves with it: dr_s = dr - R [g] theta,
// theta_s = Q^T theta, or delta_s = T delta. Gradient and second derivative follow by T; the second derivative has one more
// term in (theta, theta), from the force on the section at its lever g.
#pragma once

#include <vector>

#include "statics/rod_system.h"

namespace tendril {

class Joints {
 public:
  /// Components `part` of node `section` (the rest stays free) follow node `branch`.
  struct Joint {
    int section;
    HeldMask part;
    int branch;
    Frame relative;
    Vec3 predicted_force = Vec3::Zero();  ///< on the section by its rod, N: what the last step's linearisation leads to
    Vec3 geometric_force = Vec3::Zero();  ///< that of the last second derivative
  };

  /// Puts the joints into a pattern: adds the edges that they make.
  Joints(std::vector<Joint> joints, BlockPattern& pattern);

  bool empty() const { return joints_.empty(); }
  const std::vector<Joint>& all() const { return joints_; }

  /// Moves what the sections' rows hold to the branch points. The sections' joined unknowns become dummies.
  void join(StateView state, Stress stress, BlockSystem& system);
  void join_gradient(StateView state, std::vector<Vec6>& gradient) const;

  /// Fills the joined unknowns of a step from those of the branch points.
  void complete(StateView state, std::vector<Vec6>& step) const;

  /// After join() and complete(): the forces that the step leads to.
  void predict(const std::vector<Vec6>& step);

  /// Puts the joined sections exactly where the branch points are.
  void put_in_place(RodState& state) const;

 private:
  /// One block that has to be moved when a joint is worked off.
  struct Move {
    int from;             ///< edge between the section and another node
    int other;            ///< that node
    bool section_is_row;  ///< of the block of `from`
    int to;               ///< edge between that other node and the branch point; -1: the branch point itself
    bool branch_is_row;   ///< of the block of `to`
  };
  struct Plan {
    std::vector<Move> moves;
    int own = -1;                  ///< edge between section and branch point, for what is free at the section
    bool own_branch_is_row = false;
  };
  /// Linear change of the force on a section: one block and the node that it multiplies.
  struct ForceRate {
    Eigen::Matrix<double, 3, 6> block;
    int node;
  };

  Mat6 transform(const Joint& joint, StateView state) const;
  void add_lever(Joint& joint, StateView state, Stress stress, const Vec3& force, BlockSystem& system);

  std::vector<Joint> joints_;
  std::vector<Plan> plans_;
  std::vector<std::vector<ForceRate>> force_rates_;  ///< by joint; empty where there is no lever
  std::vector<Vec3> forces_;                         ///< by joint, at the last join()
};

}  // namespace tendril
