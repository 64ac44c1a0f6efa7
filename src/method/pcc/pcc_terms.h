// What a descent minimises: the length or the cost of a curve, and a quadratic penalty for each demand that it misses,
//   objective + w sum max(0, multiplier / 2 w - slack)^2
// With multipliers at zero this is the penalty method; with those that update() estimates, the augmented Lagrangian.
#pragma once

#include <vector>

#include "method/free_space/free_space.h"
#include "method/pcc/pcc_samples.h"

namespace tendril::routing {

class PccTerms {
 public:
  /// `margin` (m) is kept to the surroundings on top of what is demanded. Holds references to all of its arguments.
  PccTerms(const FreeSpace& space, const PccDemands& demands, const PccUnknowns& unknowns, double margin);

  double weight = 1;  ///< 1/m
  bool fine_costs = false;  ///< FreeSpace::cost_interpolated on its finer grid
  double slack = 0;   ///< m, kept on top of the straights that are demanded, so that arcs do not overlap by what is left to miss

  /// Places samples along the curve anew, and forgets their multipliers; see PccSamples::plan.
  void plan(const Eigen::VectorXd& x, double spacing);
  /// Whether the samples are still close enough together.
  bool planned(const Eigen::VectorXd& x);

  /// m; fills the gradient. Allocates nothing after the first call.
  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
  /// By the ends, of the last evaluation; see PccUnknowns::pull_to_ends.
  Ends by_ends(const Eigen::VectorXd& x) const { return unknowns_.pull_to_ends(x, adjoint_); }

  /// New multipliers from the slacks of the last evaluation; those of the surroundings only if asked for. They stay below what a
  /// curve can push with: where fixed ends are nearer than the margin no multiplier would help.
  void update_multipliers(bool with_gaps);
  /// How far the last evaluation was from the solution of the constrained problem: the largest miss, or multiplier of a demand
  /// that is more than kept, m; of the curve's own demands and of the distances to its surroundings (but for those beyond help).
  double mismatch() const { return mismatch(0, fixed_); }
  double gap_mismatch() const { return mismatch(fixed_, static_cast<int>(slacks_.size())); }
  int queries() const { return queries_; }  ///< exact gaps that were asked for

 private:
  /// Adds the penalty for a slack and returns its derivative.
  double penalty(int term, double slack, double& sum);
  double mismatch(int from, int to) const;
  void add_demands(double& sum);
  double add_samples(double& sum);
  Gap gap_of(int sample, double limit);

  const FreeSpace& space_;
  const PccDemands& demands_;
  const PccUnknowns& unknowns_;
  double margin_, unit_;  ///< unit_: m per rad
  double most_;           ///< multiplier of a gap
  PccShape shape_;
  PccAdjoint adjoint_;
  PccSamples samples_;
  bool sampled_;
  int fixed_ = 0;  ///< number of terms before those of the samples
  /// A sample was here, and the gap there was at least so large: what it moves by is all that it can have lost since.
  struct Known {
    Vec3 at;
    double low;  ///< m
  };
  std::vector<Known> known_;
  std::vector<double> multipliers_, slacks_;
  int queries_ = 0;
};

}  // namespace tendril::routing
