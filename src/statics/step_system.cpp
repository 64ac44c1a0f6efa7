#include "statics/step_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double smallest_neutral = 1e-7;  // EI/L^2; shifts from here on tell a neutral direction from a negative one
constexpr double neutral_growth = 30;
constexpr int most_alone = 12;               // rounds in which only rods that want it are shifted further
constexpr double largest_shift = 1e30;     // EI/L^2; beyond this the matrix holds something that is not a number

/// What one dead moment b = R^T m adds to the derivative of the gradient: -[b] of its own, and the half of the elastic
/// gradient, [g]/2, that the symmetric second derivative leaves out and that is [b]/2 in equilibrium.
Mat3 moment_block(const RodSystem::MomentTerm& term) { return -0.5 * cross_matrix(term.body_moment); }

}  // namespace

StepSystem::StepSystem(const RodNetwork& network) : network_(network), ldlt_(network.pattern()), rod_of_(network.nodes(), -1) {
  for (int k = 0; k < network.rods(); ++k)
    std::fill_n(rod_of_.begin() + network.first_node(k), network.rod(k).nodes(), k);
  begin();
}

void StepSystem::begin() {
  shifts_.assign(network_.rods(), 0);
  last_shifts_.assign(network_.rods(), 0);
}

double StepSystem::shift() const { return *std::max_element(shifts_.begin(), shifts_.end()); }

/// By rod; branch points take their share from the sections that are joined there.
void StepSystem::add_shift(const std::vector<double>& change) {
  const auto& weights = network_.shift_weights();
  const auto add = [&](int node, double position, double rotation) {
    block.diagonal[node].diagonal() += (Vec6() << position, position, position, rotation, rotation, rotation).finished();
  };
  for (int i = 0; i < network_.nodes(); ++i)
    if (rod_of_[i] >= 0 && change[rod_of_[i]] > 0)
      add(i, change[rod_of_[i]] * weights[i].position, change[rod_of_[i]] * weights[i].rotation);
  for (const Joints::Joint& joint : network_.joints()) {
    const double by = change[rod_of_[joint.section]];
    if (by > 0)
      add(joint.branch, joint.part & held_position ? by * weights[joint.section].position : 0,
          joint.part & held_rotation ? by * weights[joint.section].rotation : 0);
  }
}

/// Rods with pivots that are not positive; those of a branch point are its rods'. All, where nothing tells.
std::vector<char> StepSystem::rods_not_positive() const {
  std::vector<char> rods(network_.rods(), 0);
  if (!ldlt_.broken())
    for (const int node : ldlt_.nodes_not_positive()) {
      if (rod_of_[node] >= 0) rods[rod_of_[node]] = 1;
      else
        for (const Joints::Joint& joint : network_.joints())
          if (joint.branch == node) rods[rod_of_[joint.section]] = 1;
    }
  if (std::none_of(rods.begin(), rods.end(), [](char c) { return c; })) rods.assign(rods.size(), 1);
  return rods;
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
  auto shift_by = [&](const std::vector<double>& change) {
    add_shift(change);
    applied_ += *std::max_element(change.begin(), change.end());
    negative = ldlt_.factor(block);
    ++factorisations;
  };
  shift_by(shifts_);
  // Dead moments have no energy: the inertia of the symmetric part says nothing that a shift could mend.
  if (network_.has_moments()) only_positive = false;
  auto good_enough = [&] { return !ldlt_.broken() && (negative == 0 || !only_positive); };
  double neutral = 0;
  const bool unshifted = shift() == 0;
  for (double next = smallest_neutral; try_neutral && unshifted && !good_enough() && next < network_.neutral_shift(); next *= neutral_growth) {
    shift_by(std::vector<double>(shifts_.size(), next - neutral));
    neutral = next;
  }
  const int found = negative;
  for (int round = 0; !good_enough(); ++round) {
    const std::vector<char> wanting = round < most_alone ? rods_not_positive() : std::vector<char>(shifts_.size(), 1);
    std::vector<double> change(shifts_.size(), 0);
    for (std::size_t k = 0; k < shifts_.size(); ++k) {
      if (!wanting[k]) continue;
      const double next = shifts_[k] == 0 ? std::max(0.5, 0.25 * last_shifts_[k]) : 10 * shifts_[k];
      change[k] = next - shifts_[k];
      shifts_[k] = next;
    }
    if (!(shift() < largest_shift)) break;
    shift_by(change);
  }
  return found;
}

void StepSystem::relax_shift() {
  last_shifts_ = shifts_;
  for (double& shift : shifts_) shift = 0.25 * shift < 0.5 ? 0 : 0.25 * shift;
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
