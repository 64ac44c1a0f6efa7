// A path that keeps clearances: first to where they are kept, by a penalty, then to the best path that keeps them.
//
// The second part is sequential quadratic programming within a trust region: gaps that are near become linear inequalities of the
// step, and only iterates whose true gaps are kept are accepted, so that there is a best feasible path at any time. A step that
// falls short because gaps are curved is corrected by what it falls short of (second-order correction; Nocedal, Wright: Numerical
// Optimization, 2006, section 18.11).
#pragma once

#include "method/dress_pack/reduced.h"

namespace tendril::dress_pack {

/// Gaps may fall short by so much, m.
inline constexpr double clearance_tolerance = 1e-5;

class ClearanceSearch {
 public:
  /// The problem has been started.
  ClearanceSearch(ReducedProblem& problem, const LinearLimits& limits, const ReducedOptions& options)
      : problem_(problem), limits_(limits), options_(options) {}

  /// What the first or the last configuration, which no search can change, falls short of; empty when nothing.
  std::string ends_refused();

  /// From the problem's path to one that keeps its clearances and `reserve` (m) more, as much of it as the ends leave. False:
  /// none was found; the path that falls least short stays, and the message says where.
  bool run(double reserve, const RunContext& context, ReducedResult& out);

 private:
  bool feasible();
  bool approach(double reserve, const RunContext& context, ReducedResult& out);
  void improve(const RunContext& context, ReducedResult& out);
  enum class Step { taken, refused, none };
  Step step(const RunContext& context, ReducedResult& out);

  ReducedProblem& problem_;
  const LinearLimits& limits_;
  const ReducedOptions& options_;
  double radius_ = 0;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
  ReducedProblem::GapLimits gaps_;
};

}  // namespace tendril::dress_pack
