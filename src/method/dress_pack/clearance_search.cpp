#include "method/dress_pack/clearance_search.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "method/dress_pack/trust_search.h"

namespace tendril::dress_pack {
namespace {

constexpr double first_weight = 1, heavier = 6;
constexpr int most_weights = 5;
constexpr double rough_tolerance = 1e-3;   // of the penalised objective: the second part does the rest
constexpr double spare = 3e-4;             // m, that the penalty aims beyond what is wanted
constexpr double largest_radius = 0.3, smallest_radius = 1e-5;  // rad
constexpr double reach = 1.5;              // m of motion for a radian: gaps within a step's reach count
constexpr double least_margin = 0.01;      // m
constexpr int most_corrections = 2;
constexpr int idle_steps = 2;              // that gain less than the tolerance
constexpr double idle_gain = 1e-3;         // of the objective

LinearLimits joined(const LinearLimits& a, const LinearLimits& b, const Eigen::VectorXd& shift) {
  LinearLimits out;
  out.rows.resize(a.rows.rows() + b.rows.rows(), std::max(a.rows.cols(), b.rows.cols()));
  out.most.resize(out.rows.rows());
  out.rows << a.rows, b.rows;
  out.most << a.most, b.most - shift;
  return out;
}

}  // namespace

std::string ClearanceSearch::ends_refused() {
  problem_.set_clearances(0, 0);
  const std::size_t last = problem_.states().size() - 1;
  for (const std::size_t k : {std::size_t{0}, last}) {
    const auto short_of = problem_.shortest_at(k);
    if (short_of && short_of->missing() > clearance_tolerance)
      return std::string("at the ") + (k == 0 ? "start" : "end") + " of the path, which stays as it is, " +
             problem_.clearances().text(short_of->row);
  }
  return {};
}

bool ClearanceSearch::feasible() {
  const auto short_of = problem_.shortest();
  return !short_of || short_of->missing() <= clearance_tolerance;
}

bool ClearanceSearch::run(double reserve, const RunContext& context, ReducedResult& out) {
  problem_.set_clearances(0, 0);
  // The ends have what they have: near them no more can be kept.
  for (const std::size_t k : {std::size_t{0}, problem_.states().size() - 1})
    if (const auto end = problem_.shortest_at(k)) reserve = std::min(reserve, std::max(0.0, -end->missing()));
  out.status = Status::solved;
  out.message = "solved";
  if (!approach(reserve, context, out)) {
    if (out.status == Status::cancelled || out.status == Status::timeout) return false;
    problem_.set_clearances(0, 0);
    const auto short_of = problem_.shortest();
    out.status = Status::infeasible;
    out.message = "no path with these clearances was found; on the best one, at t = " + number_text(short_of ? short_of->t : 0) + ", " +
                  (short_of ? problem_.clearances().text(short_of->row) : "");
    return false;
  }
  improve(context, out);
  return true;
}

/// By ever heavier penalties to where all clearances are kept.
bool ClearanceSearch::approach(double reserve, const RunContext& context, ReducedResult& out) {
  double weight = first_weight;
  for (int round = 0; round < most_weights; ++round, weight *= heavier) {
    problem_.set_clearances(weight, reserve + spare * round);
    TrustOptions trust{rough_tolerance, options_.most_iterations, options_.first_radius};
    if (round > 0)
      trust.enough = [&] {
        const auto short_of = problem_.shortest();
        return !short_of || short_of->missing() <= spare * round + clearance_tolerance;
      };
    if (problem_.variables() > 0) trust_search(problem_, limits_, trust, context, out);
    problem_.set_clearances(0, reserve);
    if (feasible()) return true;
    if (stopped(context, out) || problem_.variables() == 0) return false;
  }
  return false;
}

/// From a path that keeps all clearances to better ones that do.
void ClearanceSearch::improve(const RunContext& context, ReducedResult& out) {
  radius_ = std::min(largest_radius, options_.first_radius);
  out.status = Status::solved;
  out.message = "solved";
  int idle = 0;
  bool stale = true;
  for (int round = 0; round < options_.most_iterations && idle < idle_steps && radius_ > smallest_radius; ++round) {
    if (stopped(context, out)) return;
    if (stale && !problem_.derivatives(gradient_, hessian_, context)) {
      if (!stopped(context, out)) out.message = "solved; the search ended at a state that is not stable";
      return;
    }
    if (!problem_.gap_limits(std::max(least_margin, reach * radius_), gaps_)) return;
    const double before = problem_.objective();
    const Step made = step(context, out);
    if (made == Step::none) return;
    stale = made == Step::taken;
    idle = stale && before - problem_.objective() > idle_gain * std::abs(before) ? 0 : idle + (stale ? 1 : 0);
    if (context.progress) context.progress(std::min(0.99, out.iterations / (out.iterations + 5.0)), "optimisation");
  }
}

ClearanceSearch::Step ClearanceSearch::step(const RunContext& context, ReducedResult& out) {
  const Eigen::VectorXd u = problem_.values();
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(gaps_.limits.most.size());
  double tried = radius_;
  for (int correction = 0; correction <= most_corrections; ++correction) {
    const TrustStep trust = trust_step(gradient_, hessian_, joined(limits_, gaps_.limits, shift), u, radius_);
    const double size = trust.step.norm();
    if (trust.reduction <= options_.tolerance * std::abs(problem_.objective()) || size < smallest_radius) {
      if (correction == 0) return Step::none;
      break;  // with the corrections there is nothing to gain: only a shorter step may do
    }
    tried = std::min(tried, size);
    ++out.iterations;
    const ReducedProblem::Trial trial = problem_.try_values(u + trust.step, context);
    if (stopped(context, out)) return Step::none;
    const double gain = trial.ok() ? problem_.objective() - trial.objective : -1;
    const auto short_of = trial.ok() ? problem_.trial_shortest() : std::nullopt;
    const double missing = short_of ? short_of->missing() : 0;
    const bool accepted = trial.ok() && missing <= clearance_tolerance && gain > 1e-4 * trust.reduction;
    out.history.push_back({accepted ? trial.objective : problem_.objective(), size, radius_, accepted});
    if (accepted) {
      problem_.accept();
      if (gain > 0.5 * trust.reduction && trust.at_edge) radius_ = std::min(largest_radius, 2 * radius_);
      return Step::taken;
    }
    if (!trial.ok() || missing <= clearance_tolerance) break;
    const std::vector<double> lacking = problem_.trial_missing();
    for (int i = 0; i < shift.size(); ++i) {
      const double lack = lacking[gaps_.steps[i]];
      if (lack > 0) shift[i] += std::min(1.05 * lack + clearance_tolerance, std::max(0.0, gaps_.limits.most[i] - shift[i] - gaps_.limits.rows.row(i).dot(u)));
    }
  }
  radius_ = 0.4 * tried;
  return Step::refused;
}

}  // namespace tendril::dress_pack
