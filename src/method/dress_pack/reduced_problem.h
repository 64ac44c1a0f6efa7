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
#include "method/dress_pack/clearance_rows.h"
#include "method/dress_pack/pack_cost.h"
#include "method/dress_pack/pack_follower.h"
#include "method/dress_pack/trust_step.h"

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

  double objective() const { return objective_; }        ///< with the penalty of clearances,
  double plain_objective() const { return plain_; }      ///< and without

  /// Clearances count as a penalty with this weight (clearance_rows.h), 0 to begin with; more is demanded by `reserve` (m).
  void set_clearances(double weight, double reserve);
  ClearanceRows& clearances() { return clearances_; }

  /// What falls shortest of its clearance at the accepted states, at the trial's, or at one time step; nothing when no clearances
  /// are demanded or all is far away.
  struct Shortest {
    ClearanceRow row;
    double t = 0;
    double missing() const { return row.wanted - row.gap; }  ///< m
  };
  std::optional<Shortest> shortest();
  std::optional<Shortest> trial_shortest();
  std::optional<Shortest> shortest_at(std::size_t k);
  std::vector<double> trial_missing();  ///< m, at each of the trial's time steps; not positive where all is kept

  /// Gaps at the accepted states smaller than wanted + `margin`, as inequalities of the free via points: the linearised gaps stay what
  /// is wanted. `steps` and `rows`: the time step of each and what it is about. False: a state is not stable.
  struct GapLimits {
    LinearLimits limits;
    std::vector<std::size_t> steps;
    std::vector<ClearanceRow> rows;
  };
  bool gap_limits(double margin, GapLimits& out);

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
  struct Cost {
    double plain = 0, penalty = 0;
  };
  double total(const std::vector<Cost>& costs, const JointPath& path, double* plain) const;
  Cost state_cost(const RodState& state, std::size_t k, const JointVector& q);
  bool state_gradient(const RodState& state, std::size_t k, const JointVector& q, JointVector& out);
  bool state_hessian(const RodState& state, std::size_t k, const JointVector& q, JointVector& gradient, Eigen::MatrixXd& hessian);
  std::optional<Shortest> shortest_of(const std::vector<RodState>& states, const JointPath& path);
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
  std::vector<Cost> costs_, trial_costs_;  ///< by time step
  ClearanceRows clearances_;
  double objective_ = 0, plain_ = 0;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd by_load_;
  std::vector<Vec6> by_node_;
};

}  // namespace tendril::dress_pack
