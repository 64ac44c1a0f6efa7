// Thesis 3.5's non-linear program: the path's free via points, and at every time step the rods' nodes, wrenches and the forces that
// the attachments exert on them are variables; equilibrium and where the robot holds the rods are equations.
//
//     least      f = sum over steps of share cost(forces, nodes) + weight effort(via points), as in reduced_problem.h
//     subject to dP/dnodes = forces at the attachments, 0 elsewhere;   dP/dwrenches = 0   (direct_rods.h)
//                poses of attached nodes = those of the links at the path's joint values
//                joint values within their limits; joint speeds too where the path has a duration.
//
// Rotations are vectors from those of the initial path's equilibria. First and second derivatives are exact but for one difference: the
// equations' second derivative along the multipliers is that of P's second derivative.
#pragma once

#include <vector>

#include "method/dress_pack/direct_rods.h"
#include "method/dress_pack/ipopt_program.h"
#include "method/dress_pack/reduced_problem.h"

namespace tendril::dress_pack {

class DirectProblem final : public NonlinearProgram {
 public:
  /// `start`: of the same pack, after its start(). `seconds`: that the path takes; 0: no limits of speed. All must outlive this.
  DirectProblem(const PackProblem& pack, const ReducedProblem& start, int steps, const PackDemands& demands, const PathWeights& weights,
                double seconds);

  bool value(In x, double& f) override;
  bool slope(In x, Out f_x) override;
  bool constraints(In x, Out c) override;
  bool jacobian(In x, Out entries) override;
  bool hessian(In x, double factor, In multipliers, Out entries) override;

 private:
  struct Step {
    double t, share;
    RodState reference;
    int column, row;  ///< of its first variable and equation
  };
  /// One free via point of a step, with its weight.
  struct Via {
    int point;
    double weight;
  };
  int free_points() const { return path_.points() - 2; }
  int joints() const { return path_.size(); }
  std::vector<Via> via_at(double t) const;

  void number_variables();
  void place_steps(const ReducedProblem& start);
  void place_bounds(double seconds);
  void place_entries();
  void place_step_entries(const Step& step);
  void add_speed_rows(double seconds);

  /// The numbers of a step from the variables: units, and what is held fixed.
  void read(const Step& step, In x, Eigen::VectorXd& numbers) const;
  Eigen::Vector3d force(const Step& step, In x, int held) const;
  void pose_rows(const Step& step, In x, Out c) const;
  /// Rows of the equations on an attachment's pose: d(position, rotation vector)/d(joints).
  Eigen::MatrixXd pose_slope(const Step& step, const JointVector& q, In x, int k) const;
  Vec3 held_rotation_vector(const Step& step, const Frame& pose, const Vec3& near, int k) const;
  Eigen::MatrixXd pose_hessian(const Step& step, const JointVector& q, In x, In multipliers) const;
  bool step_hessian(const Step& step, In x, double factor, In multipliers, Out entries, int& at);
  JointPath path_of(In x) const;

  const PackProblem& pack_;
  JointPath path_;
  PackDemands demands_;
  PathWeights weights_;
  PackStatics statics_;
  MixedRods rods_;
  double fixed_cost_ = 0;            ///< of the steps that no free via point moves
  std::vector<Step> steps_;
  std::vector<double> times_;

  // By number of a step.
  std::vector<int> column_of_, row_of_;   ///< within the step; -1: held in the world, or no equation
  std::vector<double> unit_, row_unit_;   ///< of the variable, and of its equation
  struct Pull {
    int attachment, node, column;         ///< three variables
  };
  std::vector<Pull> pulls_;               ///< attachments that hold a position
  struct PoseRow {
    int attachment, component, number, row;
  };
  std::vector<PoseRow> pose_rows_;
  int step_columns_ = 0, step_rows_ = 0;
  struct SpeedRow {
    int plus, minus;                      ///< variables; -1: an end of the path, which is in the bounds
  };
  std::vector<SpeedRow> speed_rows_;
  double force_unit_ = 1;                 ///< N

  StepTerms terms_, other_;};

}  // namespace tendril::dress_pack
