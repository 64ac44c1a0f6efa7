#include "method/dress_pack/trust_search.h"

#include <algorithm>
#include <cmath>

namespace tendril::dress_pack {
namespace {

constexpr double smallest_radius = 1e-9;  // rad
constexpr double smallest_step = 1e-9;    // rad

class Search {
 public:
  Search(ReducedProblem& problem, const LinearLimits& limits, const TrustOptions& options)
      : problem_(problem), limits_(limits), options_(options), radius_(options.first_radius) {}

  void run(const RunContext& context, ReducedResult& out) {
    const int last = out.iterations + options_.most_iterations;
    out.status = Status::solved;
    out.message = "solved";
    if (problem_.variables() == 0) return;
    bool stale = true;
    while (out.iterations < last) {
      if (stopped(context, out)) return;
      if (stale && !problem_.derivatives(gradient_, hessian_, context)) {
        if (!stopped(context, out)) fail("a state is not stable", out);
        return;
      }
      const Eigen::VectorXd u = problem_.values();
      const TrustStep step = trust_step(gradient_, hessian_, limits_, u, radius_);
      const double size = step.step.norm();
      if (step.reduction <= options_.tolerance * std::abs(problem_.objective()) && !step.at_edge) return;
      if (size < smallest_step) return;
      if (radius_ < smallest_radius) return fail("no step improves the path any more", out);
      ++out.iterations;
      const ReducedProblem::Trial trial = problem_.try_values(u + step.step, context);
      if (stopped(context, out)) return;
      stale = judge(step, size, trial, out);
      if (stale && options_.enough && options_.enough()) return;
      if (context.progress) context.progress(std::min(0.99, out.iterations / (out.iterations + 5.0)), "optimisation");
    }
    fail("not finished in " + std::to_string(options_.most_iterations) + " iterations", out);
  }

 private:
  bool judge(const TrustStep& step, double size, const ReducedProblem::Trial& trial, ReducedResult& out) {
    const double gain = trial.ok() ? problem_.objective() - trial.objective : -1;
    const double ratio = gain / std::max(step.reduction, 1e-300);
    const bool accepted = trial.ok() && gain > 0 && ratio > 1e-4;
    out.history.push_back({accepted ? trial.objective : problem_.objective(), size, radius_, accepted});
    if (ratio < 0.25) radius_ = 0.3 * size;
    if (ratio > 0.7 && step.at_edge) radius_ *= 2;
    if (accepted) problem_.accept();
    return accepted;
  }

  static void fail(const std::string& why, ReducedResult& out) {
    out.status = Status::stalled;
    out.message = why + "; this is the best path so far";
  }

  ReducedProblem& problem_;
  const LinearLimits& limits_;
  const TrustOptions& options_;
  double radius_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
};

}  // namespace

bool stopped(const RunContext& context, ReducedResult& out) {
  const auto why = context.stop();
  if (!why) return false;
  out.status = *why;
  out.message = *why == Status::timeout ? "out of time; this is the best path so far" : "interrupted; this is the best path so far";
  return true;
}

void trust_search(ReducedProblem& problem, const LinearLimits& limits, const TrustOptions& options, const RunContext& context,
                  ReducedResult& out) {
  Search(problem, limits, options).run(context, out);
}

}  // namespace tendril::dress_pack
