#include "statics/step_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double smallest_neutral = 1e-7;  // EI/L^2; shifts from here on tell a neutral direction from a negative one
constexpr double neutral_growth = 30;
constexpr double largest_shift = 1e30;     // EI/L^2; beyond this the matrix holds something that is not a number

/// What one dead moment b = R^T m adds to the derivative of the gradient: -[b] of its own, and the half of the elastic
/// gradient, [g]/2, that the symmetric second derivative leaves out and that is [b]/2 in equilibrium.
Mat3 moment_block(const RodSystem::MomentTerm& term) { return -0.5 * cross_matrix(term.body_moment); }

}  // namespace

void StepSystem::add_shift(double change) {
  for (int i = 0; i < network_.nodes(); ++i) {
    const auto& weight = network_.shift_weights()[i];
    const double position = change * weight.position, rotation = change * weight.rotation;
    block.diagonal[i].diagonal() += (Vec6() << position, position, position, rotation, rotation, rotation).finished();
  }
}

void StepSystem::take_out_held(const RodState& state) {
  const auto& targets = network_.targets();
  wanted_.clear();
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const RodSystem::Target& target = targets[k];
    Vec6 way = Vec6::Zero();
    if (target.mask & held_position) way.head<3>() = target.frame.at - state.r[target.node];
    if (target.mask & held_rotation)
      way.tail<3>() = log_rotation(state.q[target.node].conjugate() * target.frame.rotation);
    if (way.head<3>().norm() <= 1e-14 * network_.size() && way.tail<3>().norm() <= 1e-14) continue;
    if (wanted_.empty()) wanted_.assign(network_.nodes(), Vec6::Zero());
    wanted_[target.node] += way;
    block.gradient[target.node] += block.diagonal[target.node] * way;
    for (const int e : network_.edges_at(static_cast<int>(k))) {
      const BlockPattern::Edge& edge = network_.pattern().edges[e];
      if (edge.a == target.node)
        block.gradient[edge.b] += block.upper[e].transpose() * way;
      else
        block.gradient[edge.a] += block.upper[e] * way;
    }
  }
  for (std::size_t k = 0; k < targets.size(); ++k) clear_held(targets[k].node, network_.edges_at(static_cast<int>(k)));
  for (const int node : network_.dummies()) clear_held(node, {});
}

/// Held rows and columns become those of the unit matrix.
void StepSystem::clear_held(int node, const std::vector<int>& edges) {
  const HeldMask held = network_.held()[node];
  for (int k = 0; k < 6; ++k) {
    if (!(held >> k & 1)) continue;
    block.gradient[node][k] = 0;
    block.diagonal[node].row(k).setZero();
    block.diagonal[node].col(k).setZero();
    block.diagonal[node](k, k) = 1;
    for (const int e : edges)
      if (network_.pattern().edges[e].a == node)
        block.upper[e].row(k).setZero();
      else
        block.upper[e].col(k).setZero();
  }
}

int StepSystem::factor_as_is(int& factorisations) {
  ++factorisations;
  return ldlt_.factor(block);
}

int StepSystem::factor(bool only_positive, int& factorisations, bool try_neutral) {
  int negative = 0;
  applied_ = 0;
  auto shift_by = [&](double change) {
    if (change > 0) add_shift(change);
    applied_ += change;
    negative = ldlt_.factor(block);
    ++factorisations;
  };
  shift_by(shift_);
  // Dead moments have no energy: the inertia of the symmetric part says nothing that a shift could mend.
  if (network_.has_moments()) only_positive = false;
  auto good_enough = [&] { return !ldlt_.broken() && (negative == 0 || !only_positive); };
  double neutral = 0;
  for (double next = smallest_neutral; try_neutral && shift_ == 0 && !good_enough() && next < network_.neutral_shift(); next *= neutral_growth) {
    shift_by(next - neutral);
    neutral = next;
  }
  const int found = negative;
  while (!good_enough()) {
    const double before = shift_;
    shift_ = shift_ == 0 ? std::max(0.5, 0.25 * last_shift_) : 10 * shift_;
    if (!(shift_ < largest_shift)) break;
    shift_by(shift_ - before);
  }
  return found;
}

void StepSystem::relax_shift() {
  last_shift_ = shift_;
  shift_ = 0.25 * shift_ < 0.5 ? 0 : 0.25 * shift_;
}

void StepSystem::solve(const RodState& state, std::vector<Vec6>& step) const {
  ldlt_.newton_step(step);
  if (network_.has_moments()) solve_with_moments(state, step);
  for (std::size_t i = 0; i < wanted_.size(); ++i) step[i] += wanted_[i];
  network_.complete(state, step);
}

void StepSystem::solve_with_moments(const RodState& state, std::vector<Vec6>& step) const {
  // Dead moments make the matrix unsymmetric in 3x3 blocks: x = y - Z (I + A Z_u)^-1 A y_u with Z = S^-1 U.
  const std::vector<RodSystem::MomentTerm> terms = network_.moment_terms(state);
  const int m = 3 * static_cast<int>(terms.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m, m), zu(m, m);
  Eigen::VectorXd yu(m);
  std::vector<std::vector<Vec6>> z(m);
  for (int k = 0; k < m; ++k) {
    z[k].assign(network_.nodes(), Vec6::Zero());
    z[k][terms[k / 3].node][3 + k % 3] = 1;
    ldlt_.solve(z[k]);
  }
  for (int i = 0; i < m; ++i) {
    yu[i] = step[terms[i / 3].node][3 + i % 3];
    for (int k = 0; k < m; ++k) zu(i, k) = z[k][terms[i / 3].node][3 + i % 3];
  }
  for (int k = 0; k < m / 3; ++k) a.block<3, 3>(3 * k, 3 * k) = moment_block(terms[k]);
  const Eigen::VectorXd c = (Eigen::MatrixXd::Identity(m, m) + a * zu).partialPivLu().solve(a * yu);
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < network_.nodes(); ++i) step[i] -= c[k] * z[k][i];
}

void StepSystem::apply_inverse(const RodState& state, std::vector<Vec6>& x) const {
  for (int i = 0; i < network_.nodes(); ++i)
    for (int k = 0; k < 6; ++k)
      if (network_.held()[i] >> k & 1) x[i][k] = 0;
  for (const Joints::Joint& joint : network_.joints())
    for (int k = 0; k < 6; ++k)
      if (joint.part >> k & 1) x[joint.section][k] = 0;
  ldlt_.solve(x);
  network_.complete(state, x);
}

std::vector<Vec6> StepSystem::softest_mode(const RodState& state) const {
  std::vector<Vec6> mode(network_.nodes());
  for (int i = 0; i < network_.nodes(); ++i)
    for (int k = 0; k < 6; ++k) mode[i][k] = network_.held()[i] >> k & 1 ? 0 : std::sin(1.0 + 0.7 * i + 1.3 * k);
  for (int round = 0; round < 8; ++round) {
    ldlt_.solve(mode);
    double norm = 0;
    for (const Vec6& m : mode) norm = std::max(norm, m.cwiseAbs().maxCoeff());
    for (Vec6& m : mode) m /= norm;
  }
  network_.complete(state, mode);
  return mode;
}

}  // namespace tendril
