// The path of a robot with a dress pack as a function of its via points alone: the equilibria follow from them (thesis 3.5, with
// the states eliminated by the implicit function theorem).
//
//     f(u) = 1/N sum_k cost(equilibrium at theta_k) + weight * effort,   theta_k = sum_j w_kj u_j,
// the first and the last of the N + 1 times for half (trapezoidal rule: the mean over time to second order), and with the effort of joint_path.h: short, and of uniform speed. First and last via points are fixed.
//
// Gradient: one adjoint solution a time step. Second derivative: a joints x joints matrix a time step, from differences of the
// gradient at states that the linear response predicts, without solving for them; block tridiagonal in the via points.
#pragma once

#include <vector>

#include "base/run_context.h"
#include "method/dress_pack/pack_cost.h"
#include "method/dress_pack/pack_follower.h"

namespace tendril::dress_pack {

struct PathWeights {
  double effort = 0.02;            ///< of the path's effort
  std::vector<double> joints = {}; ///< of the joints in it; empty: all 1
};

class ReducedProblem {
 public:
  ReducedProblem(const PackProblem& pack, const JointPath& path, int steps, const PackDemands& demands, const PathWeights& weights);

  /// Follows the path from its start; ok() when all equilibria are there.
  PackFollower::Outcome start(const RunContext& context);

  const JointPath& path() const { return path_; }
  const std::vector<RodState>& states() const { return states_; }
  int joints() const { return path_.size(); }
  int free_points() const { return std::max(0, path_.points() - 2); }
  int variables() const { return free_points() * joints(); }
  Eigen::VectorXd values() const;  ///< of the free via points, one after the other
  JointPath path_with(const Eigen::VectorXd& u) const;

  double objective() const { return objective_; }

  /// Moves every time step's equilibrium to the path with these via points; a way that snaps through or finds no equilibrium is
  /// refused. The new states count once they are accepted.
  struct Trial {
    Status status = Status::stalled;
    double objective = 0;
    bool ok() const { return status == Status::solved; }
  };
  Trial try_values(const Eigen::VectorXd& u, const RunContext& context);
  void accept();

  /// At the accepted states. False when a state is not stable, or the context says stop.
  bool derivatives(Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian, const RunContext& context);
  /// The gradient alone.
  bool gradient(Eigen::VectorXd& out);

 private:
  double share(std::size_t k) const;
  double total(const std::vector<double>& costs, const JointPath& path) const;
  double state_cost(const RodState& state);
  bool state_gradient(const RodState& state, const JointVector& q, JointVector& out);
  bool state_hessian(const RodState& state, const JointVector& q, JointVector& gradient, Eigen::MatrixXd& hessian);
  template <class Visit>
  void at_points(double t, Visit visit) const;
  void add_effort(Eigen::VectorXd& gradient, Eigen::MatrixXd* hessian) const;

  const PackProblem& pack_;
  JointPath path_, trial_path_;
  std::vector<double> times_;
  PathWeights weights_;
  PackStatics statics_;
  PackCost cost_;
  std::vector<RodState> states_, trial_states_;
  std::vector<double> costs_, trial_costs_;  ///< by time step
  double objective_ = 0;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd by_load_;
  std::vector<Vec6> by_node_;
};

}  // namespace tendril::dress_pack
