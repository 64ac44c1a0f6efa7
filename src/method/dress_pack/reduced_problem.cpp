#include "method/dress_pack/reduced_problem.h"

#include <cmath>

namespace tendril::dress_pack {
namespace {

constexpr double difference = 1e-5;  // rad or m, of a joint: the states are then off their equilibria by its square

FollowLimits limits_of(bool may_snap) {
  FollowLimits limits;
  limits.may_snap = may_snap;
  return limits;
}

}  // namespace

ReducedProblem::ReducedProblem(const PackProblem& pack, const JointPath& path, int steps, const PackDemands& demands,
                               const PathWeights& weights)
    : pack_(pack), path_(path), trial_path_(path), times_(JointPath::times(steps)), weights_(weights), statics_(pack),
      cost_(statics_, demands), states_(times_.size()), trial_states_(times_.size()), costs_(times_.size()), trial_costs_(times_.size()),
      clearances_(statics_, demands, static_cast<int>(times_.size())) {}

PackFollower::Outcome ReducedProblem::start(const RunContext& context) {
  PackFollower follower(statics_, limits_of(true));
  RodState state;
  PackFollower::Outcome way = follower.start(state, path_.at(0), context);
  if (!way.ok()) return way;
  std::vector<PackFollower::Snap> snaps;
  const int pieces = std::max(1, path_.points() - 1);
  double t = 0;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    while (t < times_[k]) {  // by way of the via points
      const double bend = (std::floor(t * pieces + 1e-9) + 1) / pieces, there = bend < times_[k] - 1e-9 ? bend : times_[k];
      way = follower.advance(state, path_.at(t), path_.at(there), context);
      snaps.insert(snaps.end(), way.snaps.begin(), way.snaps.end());
      if (!way.ok()) return way;
      t = there;
    }
    states_[k] = state;
    costs_[k] = state_cost(state, k, path_.at(times_[k]));
  }
  objective_ = total(costs_, path_, &plain_);
  way.snaps = snaps;
  return way;
}

Eigen::VectorXd ReducedProblem::values() const {
  Eigen::VectorXd u(variables());
  for (int j = 0; j < free_points(); ++j) u.segment(j * joints(), joints()) = path_.via()[j + 1];
  return u;
}

JointPath ReducedProblem::path_with(const Eigen::VectorXd& u) const {
  std::vector<JointVector> via = path_.via();
  for (int j = 0; j < free_points(); ++j) via[j + 1] = u.segment(j * joints(), joints());
  return JointPath(std::move(via));
}

ReducedProblem::Trial ReducedProblem::try_values(const Eigen::VectorXd& u, const RunContext& context) {
  PackFollower follower(statics_, limits_of(false));
  trial_path_ = path_with(u);
  Trial out;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const JointVector from = path_.at(times_[k]), to = trial_path_.at(times_[k]);
    trial_states_[k] = states_[k];
    trial_costs_[k] = costs_[k];
    if (from != to) {
      const PackFollower::Outcome way = follower.advance(trial_states_[k], from, to, context);
      out.status = way.status;
      if (!way.ok()) return out;
      trial_costs_[k] = state_cost(trial_states_[k], k, to);
    }
  }
  out.status = Status::solved;
  out.objective = total(trial_costs_, trial_path_, nullptr);
  return out;
}

void ReducedProblem::accept() {
  path_ = trial_path_;
  std::swap(states_, trial_states_);
  std::swap(costs_, trial_costs_);
  objective_ = total(costs_, path_, &plain_);
}

double ReducedProblem::share(std::size_t k) const {
  const double whole = 1.0 / static_cast<double>(times_.size() - 1);
  return k == 0 || k + 1 == times_.size() ? 0.5 * whole : whole;
}

double ReducedProblem::total(const std::vector<Cost>& costs, const JointPath& path, double* plain) const {
  double sum = weights_.effort * path.effort(weights_.joints), penalty = 0;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    sum += share(k) * costs[k].plain;
    penalty += share(k) * costs[k].penalty;
  }
  if (plain) *plain = sum;
  return sum + penalty;
}

ReducedProblem::Cost ReducedProblem::state_cost(const RodState& state, std::size_t k, const JointVector& q) {
  statics_.load_at(state);
  return {cost_.value(statics_, state), clearances_.penalty(state, q, static_cast<int>(k))};
}

bool ReducedProblem::state_gradient(const RodState& state, std::size_t k, const JointVector& q, JointVector& out) {
  if (!statics_.stand_at(state)) return false;
  cost_.slopes(statics_, state, by_load_, by_node_);
  JointVector of_bodies = JointVector::Zero(joints());
  clearances_.penalty(state, q, static_cast<int>(k), by_node_, of_bodies);
  pack_.jacobian(q, jacobian_);
  out = jacobian_.transpose() * statics_.pull_back(by_load_, by_node_) + of_bodies;
  return true;
}

bool ReducedProblem::state_hessian(const RodState& state, std::size_t k, const JointVector& q, JointVector& gradient, Eigen::MatrixXd& hessian) {
  if (!state_gradient(state, k, q, gradient)) return false;
  const int n = joints();
  std::vector<RodState> near(n, state);
  std::vector<Vec6> step;
  for (int j = 0; j < n; ++j) {
    statics_.respond(jacobian_.col(j), step);
    statics_.network().apply(near[j], step, difference);
  }
  hessian.resize(n, n);
  JointVector there;
  for (int j = 0; j < n; ++j) {
    if (!state_gradient(near[j], k, q + difference * JointVector::Unit(n, j), there)) return false;
    hessian.col(j) = (there - gradient) / difference;
  }
  hessian = 0.5 * (hessian + hessian.transpose()).eval();
  return true;
}

void ReducedProblem::set_clearances(double weight, double reserve) {
  clearances_.set_weight(weight);
  clearances_.set_reserve(reserve);
  for (std::size_t k = 0; k < times_.size(); ++k)
    costs_[k].penalty = clearances_.penalty(states_[k], path_.at(times_[k]), static_cast<int>(k));
  objective_ = total(costs_, path_, &plain_);
}

std::optional<ReducedProblem::Shortest> ReducedProblem::shortest_of(const std::vector<RodState>& states, const JointPath& path) {
  std::optional<Shortest> out;
  for (std::size_t k = 0; clearances_.any() && k < times_.size(); ++k) {
    std::optional<ClearanceRow> row = clearances_.worst(states[k], path.at(times_[k]), static_cast<int>(k));
    if (!row || (out && row->wanted - row->gap <= out->missing())) continue;
    out = Shortest{std::move(*row), times_[k]};
  }
  return out;
}

std::optional<ReducedProblem::Shortest> ReducedProblem::shortest() { return shortest_of(states_, path_); }
std::optional<ReducedProblem::Shortest> ReducedProblem::trial_shortest() { return shortest_of(trial_states_, trial_path_); }

std::optional<ReducedProblem::Shortest> ReducedProblem::shortest_at(std::size_t k) {
  if (!clearances_.any()) return std::nullopt;
  std::optional<ClearanceRow> row = clearances_.worst(states_[k], path_.at(times_[k]), static_cast<int>(k));
  if (!row) return std::nullopt;
  return Shortest{std::move(*row), times_[k]};
}

std::vector<double> ReducedProblem::trial_missing() {
  std::vector<double> out(times_.size(), 0);
  for (std::size_t k = 0; clearances_.any() && k < times_.size(); ++k)
    if (const auto row = clearances_.worst(trial_states_[k], trial_path_.at(times_[k]), static_cast<int>(k))) out[k] = row->wanted - row->gap;
  return out;
}

bool ReducedProblem::gap_limits(double margin, GapLimits& out) {
  out = {};
  std::vector<ClearanceRow> near;
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> most;
  const Eigen::VectorXd u = values();
  for (std::size_t k = 0; k < times_.size(); ++k) {
    bool wanted = false;
    at_points(times_[k], [&](int, double) { wanted = true; });
    if (!wanted) continue;
    if (!statics_.stand_at(states_[k])) return false;
    clearances_.near(statics_, states_[k], path_.at(times_[k]), static_cast<int>(k), margin, near);
    for (ClearanceRow& one : near) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(variables());
      at_points(times_[k], [&](int j, double w) { row.segment(j * joints(), joints()) -= w * one.slope; });
      // What is missing already may stay missing, but no more of it.
      most.push_back(row.dot(u) + std::max(0.0, one.gap - one.wanted));
      rows.push_back(std::move(row));
      out.steps.push_back(k);
      out.rows.push_back(std::move(one));
    }
  }
  out.limits.rows.resize(static_cast<int>(rows.size()), variables());
  out.limits.most.resize(static_cast<int>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.limits.rows.row(static_cast<int>(i)) = rows[i].transpose();
    out.limits.most[static_cast<int>(i)] = most[i];
  }
  return true;
}

/// The free via points that the path at `t` is made of, with their weights.
template <class Visit>
void ReducedProblem::at_points(double t, Visit visit) const {
  const JointPath::Place place = path_.place(t);
  if (place.first >= 1 && place.first <= free_points() && place.share < 1) visit(place.first - 1, 1 - place.share);
  if (place.first + 1 <= free_points() && place.share > 0) visit(place.first, place.share);
}

void ReducedProblem::add_effort(Eigen::VectorXd& gradient, Eigen::MatrixXd* hessian) const {
  const int n = joints(), pieces = path_.points() - 1;
  for (int i = 0; i < n; ++i) {
    const double weight = weights_.joints.empty() ? 1 : weights_.joints[i], k = weights_.effort * pieces * weight * weight;
    for (int p = 0; p < pieces; ++p) {
      const double pull = k * (path_.via()[p + 1][i] - path_.via()[p][i]);
      const int a = (p - 1) * n + i, b = a + n;
      const bool free_a = p >= 1, free_b = p < free_points();
      if (free_a) gradient[a] -= pull;
      if (free_b) gradient[b] += pull;
      if (!hessian) continue;
      if (free_a) (*hessian)(a, a) += k;
      if (free_b) (*hessian)(b, b) += k;
      if (!free_a || !free_b) continue;
      (*hessian)(a, b) -= k;
      (*hessian)(b, a) -= k;
    }
  }
}

bool ReducedProblem::gradient(Eigen::VectorXd& out) {
  const int n = joints();
  out.setZero(variables());
  JointVector slope;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    bool wanted = false;
    at_points(times_[k], [&](int, double) { wanted = true; });
    if (!wanted) continue;
    if (!state_gradient(states_[k], k, path_.at(times_[k]), slope)) return false;
    at_points(times_[k], [&](int j, double w) { out.segment(j * n, n) += share(k) * w * slope; });
  }
  add_effort(out, nullptr);
  return true;
}

bool ReducedProblem::derivatives(Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian, const RunContext& context) {
  const int n = joints();
  gradient.setZero(variables());
  hessian.setZero(variables(), variables());
  JointVector slope;
  Eigen::MatrixXd block;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    bool wanted = false;
    at_points(times_[k], [&](int, double) { wanted = true; });
    if (!wanted) continue;
    if (context.stop() || !state_hessian(states_[k], k, path_.at(times_[k]), slope, block)) return false;
    at_points(times_[k], [&](int j, double w) {
      gradient.segment(j * n, n) += share(k) * w * slope;
      at_points(times_[k], [&](int i, double v) { hessian.block(j * n, i * n, n, n) += share(k) * w * v * block; });
    });
  }
  add_effort(gradient, &hessian);
  return true;
}

}  // namespace tendril::dress_pack
