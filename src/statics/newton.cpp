#include "statics/newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double largest_step = 1;        // rad, and share of the length
constexpr double saddle_step = 1e-6;      // a shifted step this small means that the slope is gone but the curvature is not
constexpr double rough_step = 0.2;        // steps above this leave a wrench too rough for the fourth-order terms
constexpr double rough_stress = 1;       // and so does a false stress above this
constexpr double smallest_neutral = 1e-7;  // EI/L^2; shifts from here on tell a neutral direction from a negative one
constexpr int most_mode_moves = 6;
constexpr double quadratic_regime = 1e-2; // below this a step predicts the next one
constexpr double settled_step = 1e-5;     // steps below this that shrink no more are rounding along a nearly neutral mode
constexpr int settled_rounds = 5;

/// What one dead moment adds to the second derivative: an antisymmetric 3x3 block.
Mat3 moment_block(const RodSystem::MomentTerm& term) { return -cross_matrix(term.body_moment); }

}  // namespace

void Newton::assemble(const RodState& state, Stress stress) {
  energy_ = system_.assemble(state, stress, block_);
  if (further_) energy_ += further_->assemble(state, stress, block_);
}

void Newton::add_shift(double change) {
  const double per_square = 0.01 / (system_.length() * system_.length());
  for (int i = 0; i < system_.nodes(); ++i) {
    const double rotation = change * system_.node_length()[i];
    const double position = rotation * per_square;
    block_.diagonal[i].diagonal() += (Vec6() << position, position, position, rotation, rotation, rotation).finished();
  }
}

void Newton::take_out_held(const RodState& state) {
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
    block_.gradient[target.node] += block_.diagonal[target.node] * way;
    if (target.node > 0) block_.gradient[target.node - 1] += block_.upper[target.node - 1] * way;
    if (target.node + 1 < n) block_.gradient[target.node + 1] += block_.upper[target.node].transpose() * way;
  }
  for (int i = 0; i < n; ++i) {
    if (!held[i]) continue;
    for (int k = 0; k < 6; ++k) {
      if (!(held[i] >> k & 1)) continue;
      block_.gradient[i][k] = 0;
      block_.diagonal[i].row(k).setZero();
      block_.diagonal[i].col(k).setZero();
      block_.diagonal[i](k, k) = 1;
      if (i + 1 < n) block_.upper[i].row(k).setZero();
      if (i > 0) block_.upper[i - 1].col(k).setZero();
    }
  }
}

int Newton::factor_positive(const NewtonOptions& options, int& factorisations) {
  const double smallest = system_.bending_scale();
  if (shift_ > 0) add_shift(shift_);
  int negative = ldlt_.factor(block_);
  ++factorisations;
  // Dead moments have no energy: the inertia of the symmetric part says nothing that a shift could mend.
  const bool any = !options.stable_only || system_.has_moments();
  if (any && !ldlt_.broken()) return negative;
  for (double neutral = smallest_neutral; shift_ == 0 && (negative > 0 || ldlt_.broken()) && neutral < system_.neutral_shift(); neutral *= 30) {
    add_shift(neutral * smallest * (neutral == smallest_neutral ? 1 : 29.0 / 30));
    negative = ldlt_.factor(block_);
    ++factorisations;
  }
  const int first = negative;
  while (negative > 0 || ldlt_.broken()) {
    const double before = shift_;
    shift_ = shift_ == 0 ? std::max(0.5 * smallest, 0.25 * last_shift_) : 10 * shift_;
    if (!(shift_ < 1e30 * smallest)) break;
    add_shift(shift_ - before);
    negative = ldlt_.factor(block_);
    ++factorisations;
    if (any && !ldlt_.broken()) break;
  }
  return first;
}

void Newton::solve_step(const RodState& state) {
  ldlt_.newton_step(step_);
  if (system_.has_moments()) {
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
      yu[i] = step_[terms[i / 3].node][3 + i % 3];
      for (int k = 0; k < m; ++k) zu(i, k) = z[k][terms[i / 3].node][3 + i % 3];
    }
    for (int k = 0; k < m / 3; ++k) a.block<3, 3>(3 * k, 3 * k) = moment_block(terms[k]);
    const Eigen::VectorXd c =
        (Eigen::MatrixXd::Identity(m, m) + a * zu).partialPivLu().solve(a * yu);
    for (int k = 0; k < m; ++k)
      for (int i = 0; i < system_.nodes(); ++i) step_[i] -= c[k] * z[k][i];
  }
  for (std::size_t i = 0; i < wanted_.size(); ++i) step_[i] += wanted_[i];
}

double Newton::size_of_step() const {
  double turn = 0, move = 0;
  for (const Vec6& s : step_) {
    move = std::max(move, s.head<3>().squaredNorm());
    turn = std::max(turn, s.tail<3>().squaredNorm());
  }
  const double size = std::sqrt(std::max(turn, move / (system_.length() * system_.length())));
  for (const Vec6& s : step_)
    if (!all_finite(s)) return INFINITY;
  return size;
}

void Newton::move_along_softest_mode(RodState& state) {
  // Inverse iteration with the shifted factor: the softest direction grows fastest.
  std::vector<Vec6> mode(system_.nodes());
  for (int i = 0; i < system_.nodes(); ++i)
    for (int k = 0; k < 6; ++k) mode[i][k] = system_.held()[i] >> k & 1 ? 0 : std::sin(1.0 + 0.7 * i + 1.3 * k);
  for (int round = 0; round < 8; ++round) {
    ldlt_.solve(mode);
    double norm = 0;
    for (const Vec6& m : mode) norm = std::max(norm, m.cwiseAbs().maxCoeff());
    for (Vec6& m : mode) m /= norm;
  }
  step_ = mode;
  const double size = size_of_step();
  if (!std::isfinite(size) || size == 0) return;
  const double share = 0.1 / size;
  state.apply(step_, further_ ? further_->allowed(state, step_, share) : share);
}

double Newton::energy_at(const RodState& state) const {
  const double energy = system_.gradient(state, scratch_);
  return further_ ? energy + further_->energy(state) : energy;
}

double Newton::armijo_share(const RodState& state, double share) const {
  double slope = 0, moment_work = 0;
  for (int i = 0; i < system_.nodes(); ++i) slope += block_.gradient[i].dot(step_[i]);
  for (const RodSystem::MomentTerm& term : system_.moment_terms(state))
    moment_work += term.body_moment.dot(Vec3(step_[term.node].tail<3>()));
  const double rounding = 1e-13 * (std::abs(energy_) + std::abs(slope));
  for (int half = 0; half < 30; ++half, share *= 0.5) {
    RodState trial = state;
    trial.apply(step_, share);
    const double change = energy_at(trial) - energy_ - share * moment_work;
    if (change <= 1e-4 * share * std::min(slope, 0.0) + rounding) return share;
  }
  return 0;
}

NewtonOutcome Newton::run(RodState& state, const NewtonOptions& options, const RunContext& context) {
  NewtonOutcome out;
  Stress stress = options.descend || options.warm ? Stress::actual : Stress::zero;
  shift_ = last_shift_ = 0;
  double previous_step = INFINITY;
  double smallest_step = settled_step;
  int mode_moves = 0, blocked = 0, unchanged = 0;
  for (int round = 0; out.iterations < options.max_iterations; ++round) {
    if (const auto stop = context.stop()) {
      out.status = *stop;
      return out;
    }
    assemble(state, stress);
    if (stress == Stress::predicted && system_.false_stress() > rough_stress) {
      stress = Stress::rough;
      assemble(state, stress);
    }
    take_out_held(state);
    out.negative_pivots = factor_positive(options, out.iterations);
    if (ldlt_.broken()) return out;
    solve_step(state);
    const double size = size_of_step();
    if (!std::isfinite(size)) return out;
    double share = std::min(1.0, largest_step / size);
    if (further_) {
      const double allowed = further_->allowed(state, step_, share);
      if (allowed < 0.3 * share && ++blocked > 1 && further_->stiffen(state, step_, share)) {
        blocked = 0;
        continue;
      }
      if (allowed >= 0.3 * share) blocked = 0;
      share = allowed;
    }
    if (options.descend) {
      const double guarded = share;
      share = armijo_share(state, share);
      if (further_ && share < guarded) share = further_->allowed(state, step_, share);
    }
    if (!options.descend) system_.predict(step_, share);
    if (further_) further_->stepped(state, step_, share);
    state.apply(step_, share);
    out.last_step = share * size;
    if (share == 0) return out;

    const bool full = share == 1;
    const bool held_in_place = wanted_.empty() || full;
    const bool exact = stress == Stress::predicted || stress == Stress::actual;
    if (shift_ == 0 && full && held_in_place && exact && (out.negative_pivots == 0 || !options.stable_only || system_.has_moments())) {
      // What is left: about size^3 / previous^2 if convergence is quadratic, with a tenfold margin; but the predicted
      // wrench is only right to first order in the step before, which leaves about size * previous.
      const double left = size < quadratic_regime && previous_step < 10 * quadratic_regime
                              ? 10 * size * size * size / (previous_step * previous_step) + 0.3 * size * previous_step
                              : size;
      unchanged = size < settled_step && size > 0.5 * smallest_step ? unchanged + 1 : 0;
      smallest_step = std::min(smallest_step, size);
      if (std::min(size, left) < options.tolerance || unchanged == settled_rounds) {
        out.status = Status::solved;
        return out;
      }
    }
    if (shift_ > 0 && out.last_step < saddle_step && mode_moves < most_mode_moves) {
      ++mode_moves;
      move_along_softest_mode(state);
    }
    if (full) {
      last_shift_ = shift_;
      shift_ = 0.25 * shift_ < 0.5 * system_.bending_scale() ? 0 : 0.25 * shift_;
    }
    previous_step = size;
    stress = options.descend ? Stress::actual : size > rough_step ? Stress::rough : Stress::predicted;
  }
  return out;
}

int Newton::negative_pivots_at(const RodState& state) {
  assemble(state, Stress::actual);
  take_out_held(state);
  return ldlt_.factor(block_);
}

}  // namespace tendril
