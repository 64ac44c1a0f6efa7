#include "statics/step_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double smallest_neutral = 1e-7;  // EI/L^2; shifts from here on tell a neutral direction from a negative one
constexpr double neutral_growth = 30;
constexpr double largest_shift = 1e30;     // EI/L^2; beyond this the matrix holds something that is not a number

/// What one dead moment adds to the second derivative: an antisymmetric 3x3 block.
Mat3 moment_block(const RodSystem::MomentTerm& term) { return -cross_matrix(term.body_moment); }

}  // namespace

void StepSystem::add_shift(double change) {
  const double per_square = 0.01 / (system_.length() * system_.length());
  for (int i = 0; i < system_.nodes(); ++i) {
    const double rotation = change * system_.node_length()[i];
    const double position = rotation * per_square;
    block.diagonal[i].diagonal() += (Vec6() << position, position, position, rotation, rotation, rotation).finished();
  }
}

void StepSystem::take_out_held(const RodState& state) {
  const std::vector<HeldMask>& held = system_.held();
  const int n = system_.nodes();
  wanted_.clear();
  for (const RodSystem::Target& target : system_.targets()) {
    Vec6 way = Vec6::Zero();
    if (target.mask & held_position) way.head<3>() = target.frame.at - state.r[target.node];
    if (target.mask & held_rotation)
      way.tail<3>() = log_rotation(state.q[target.node].conjugate() * target.frame.rotation);
    if (way.head<3>().norm() <= 1e-14 * system_.length() && way.tail<3>().norm() <= 1e-14) continue;
    if (wanted_.empty()) wanted_.assign(n, Vec6::Zero());
    wanted_[target.node] += way;
    block.gradient[target.node] += block.diagonal[target.node] * way;
    if (target.node > 0) block.gradient[target.node - 1] += block.upper[target.node - 1] * way;
    if (target.node + 1 < n) block.gradient[target.node + 1] += block.upper[target.node].transpose() * way;
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; held[i] && k < 6; ++k) {
      if (!(held[i] >> k & 1)) continue;
      block.gradient[i][k] = 0;
      block.diagonal[i].row(k).setZero();
      block.diagonal[i].col(k).setZero();
      block.diagonal[i](k, k) = 1;
      if (i + 1 < n) block.upper[i].row(k).setZero();
      if (i > 0) block.upper[i - 1].col(k).setZero();
    }
  }
}

int StepSystem::factor(bool only_positive, int& factorisations) {
  const double scale = system_.bending_scale();
  int negative = 0;
  auto shift_by = [&](double change) {
    if (change > 0) add_shift(change);
    negative = ldlt_.factor(block);
    ++factorisations;
  };
  shift_by(shift_);
  // Dead moments have no energy: the inertia of the symmetric part says nothing that a shift could mend.
  if (system_.has_moments()) only_positive = false;
  auto good_enough = [&] { return !ldlt_.broken() && (negative == 0 || !only_positive); };
  double neutral = 0;
  for (double next = smallest_neutral; shift_ == 0 && !good_enough() && next < system_.neutral_shift(); next *= neutral_growth) {
    shift_by((next - neutral) * scale);
    neutral = next;
  }
  const int found = negative;
  while (!good_enough()) {
    const double before = shift_;
    shift_ = shift_ == 0 ? std::max(0.5 * scale, 0.25 * last_shift_) : 10 * shift_;
    if (!(shift_ < largest_shift * scale)) break;
    shift_by(shift_ - before);
  }
  return found;
}

void StepSystem::relax_shift() {
  last_shift_ = shift_;
  shift_ = 0.25 * shift_ < 0.5 * system_.bending_scale() ? 0 : 0.25 * shift_;
}

void StepSystem::solve(const RodState& state, std::vector<Vec6>& step) const {
  ldlt_.newton_step(step);
  if (system_.has_moments()) solve_with_moments(state, step);
  for (std::size_t i = 0; i < wanted_.size(); ++i) step[i] += wanted_[i];
}

void StepSystem::solve_with_moments(const RodState& state, std::vector<Vec6>& step) const {
  // Dead moments make the matrix unsymmetric in 3x3 blocks: x = y - Z (I + A Z_u)^-1 A y_u with Z = S^-1 U.
  const std::vector<RodSystem::MomentTerm> terms = system_.moment_terms(state);
  const int m = 3 * static_cast<int>(terms.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m, m), zu(m, m);
  Eigen::VectorXd yu(m);
  std::vector<std::vector<Vec6>> z(m);
  for (int k = 0; k < m; ++k) {
    z[k].assign(system_.nodes(), Vec6::Zero());
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
    for (int i = 0; i < system_.nodes(); ++i) step[i] -= c[k] * z[k][i];
}

std::vector<Vec6> StepSystem::softest_mode() const {
  std::vector<Vec6> mode(system_.nodes());
  for (int i = 0; i < system_.nodes(); ++i)
    for (int k = 0; k < 6; ++k) mode[i][k] = system_.held()[i] >> k & 1 ? 0 : std::sin(1.0 + 0.7 * i + 1.3 * k);
  for (int round = 0; round < 8; ++round) {
    ldlt_.solve(mode);
    double norm = 0;
    for (const Vec6& m : mode) norm = std::max(norm, m.cwiseAbs().maxCoeff());
    for (Vec6& m : mode) m /= norm;
  }
  return mode;
}

double StepSystem::size_of(const std::vector<Vec6>& step) const {
  double turn = 0, move = 0;
  bool finite = true;
  for (const Vec6& s : step) {
    finite = finite && all_finite(s);
    move = std::max(move, s.head<3>().squaredNorm());
    turn = std::max(turn, s.tail<3>().squaredNorm());
  }
  return finite ? std::sqrt(std::max(turn, move / (system_.length() * system_.length()))) : INFINITY;
}

}  // namespace tendril
