#include "statics/newton.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double largest_step = 1;         // rad, and share of the length
constexpr double saddle_step = 1e-6;       // a shifted step this small: the slope is gone, the negative curvature is not
constexpr double rough_step = 0.2;         // steps above this leave a wrench too rough for the fourth-order terms,
constexpr double rough_stress = 1;         // and so does a false stress above this
constexpr double stiff_stretch = 1e3;       // h^2 EA/(12 EI): above it no step is small enough to leave no false stress
constexpr int most_mode_moves = 6;
constexpr double mode_step = 0.1;          // rad, and share of the length: how far a saddle is left
constexpr double quadratic_regime = 1e-2;  // below this a step predicts the next one
constexpr double lingering_ratio = 0.3;      // of a step to the one before it
constexpr double settled_step = 1e-5;      // steps below this that shrink no more are rounding along a nearly neutral mode
constexpr int settled_rounds = 5;
constexpr double blocked_share = 0.3;      // of a step; the guards left less
constexpr int long_cycle = 16;
constexpr int most_left_out = 6;           // beyond this the wrench is not false: the rod is about to buckle

}  // namespace

void Newton::assemble(const RodState& state) {
  auto all_terms = [&] {
    energy_ = network_.assemble(state, stress_, linear_.block);
    if (further_) energy_ += further_->assemble(state, stress_, linear_.block);
    network_.join(state, stress_, linear_.block);
  };
  all_terms();
  if (stress_ != Stress::predicted || network_.false_stress() <= rough_stress) return;
  stress_ = network_.stretch_stiffness() > stiff_stretch ? Stress::deferred : Stress::rough;
  all_terms();
}

/// The share of the step that crosses no surface; nothing when the terms have stiffened and the step must be found anew.
std::optional<double> Newton::guarded_share(const RodState& state, double share) {
  if (!further_) return share;
  const double allowed = further_->allowed(state, step_, share);
  if (allowed >= blocked_share * share) {
    blocked_ = 0;
  } else if (++blocked_ > 1 && further_->stiffen(state, step_, share)) {
    blocked_ = 0;
    return std::nullopt;
  }
  return allowed;
}

double Newton::energy_at(const RodState& state) {
  const double energy = network_.gradient(state, scratch_);
  return further_ ? energy + further_->energy(state) : energy;
}

double Newton::armijo_share(const RodState& state, double share) {
  double slope = 0, moment_work = 0;
  for (int i = 0; i < network_.nodes(); ++i) slope += linear_.block.gradient[i].dot(step_[i]);
  for (const RodSystem::MomentTerm& term : network_.moment_terms(state))
    moment_work += term.body_moment.dot(Vec3(step_[term.node].tail<3>()));
  const double rounding = 1e-13 * (std::abs(energy_) + std::abs(slope));
  for (int half = 0; half < 30; ++half, share *= 0.5) {
    RodState trial = state;
    network_.apply(trial, step_, share);
    const double change = energy_at(trial) - energy_ - share * moment_work;
    if (change <= 1e-4 * share * std::min(slope, 0.0) + rounding) return share;
  }
  return 0;
}

double Newton::descending_share(const RodState& state, double share) {
  const double found = armijo_share(state, share);
  return further_ && found < share ? further_->allowed(state, step_, found) : found;
}

/// After a full, unshifted step of this size: is what is left below the tolerance?
bool Newton::settled(double size, const NewtonOptions& options) {
  // What is left: about size^3 / previous^2 if convergence is quadratic, with a tenfold margin; but the predicted wrench
  // is only right to first order in the step before, which leaves about size * previous.
  double left = size;
  if (size < quadratic_regime && previous_size_ < 10 * quadratic_regime)
    left = 10 * size * size * size / (previous_size_ * previous_size_) + 0.3 * size * previous_size_;
  // Contact's second derivative grows with the root of the overlap: only the ratio of two steps can be relied on.
  if (further_) left = std::max(left, size * std::clamp(size / previous_size_, 0.1, 1.0));
  not_shrinking_ = size < settled_step && size > 0.5 * smallest_size_ ? not_shrinking_ + 1 : 0;
  smallest_size_ = std::min(smallest_size_, size);
  return std::min(size, left) < options.tolerance || not_shrinking_ == settled_rounds;
}

void Newton::leave_saddle(RodState& state) {
  ++mode_moves_;
  step_ = linear_.softest_mode(state);
  const double size = network_.size_of(step_);
  if (!std::isfinite(size) || size == 0) return;
  const double share = mode_step / size;
  network_.apply(state, step_, further_ ? further_->allowed(state, step_, share) : share);
}

/// Contacts that open and close can lead round in circles: when steps have not become smaller for long they are halved.
double Newton::damped(double size) {
  if (!further_) return 1;
  if (size < 0.3 * smallest_of_cycle_) {
    smallest_of_cycle_ = size;
    since_smallest_ = 0;
    return 1;
  }
  return ++since_smallest_ > long_cycle && size > quadratic_regime ? 0.5 : 1;
}

void Newton::factor(const RodState& state, const NewtonOptions& options, NewtonOutcome& out) {
  linear_.take_out_held(state);
  if (options.convex && stress_ != Stress::zero && linear_.shift() == 0 && left_out_ < most_left_out) {
    out.negative_pivots = linear_.factor_as_is(out.iterations);
    if (out.negative_pivots == 0 && !linear_.broken()) return;
    ++left_out_;
    stress_ = Stress::zero;
    assemble(state);
    linear_.take_out_held(state);
  }
  out.negative_pivots = linear_.factor(options.stable_only, out.iterations, !options.convex);
}

NewtonOutcome Newton::run(RodState& state, const NewtonOptions& options, const RunContext& context) {
  NewtonOutcome out;
  stress_ = options.descend || options.warm ? Stress::actual : options.continued ? Stress::predicted : Stress::zero;
  linear_.begin();
  previous_size_ = INFINITY;
  smallest_size_ = settled_step;
  smallest_of_cycle_ = INFINITY;
  since_smallest_ = 0;
  mode_moves_ = blocked_ = not_shrinking_ = left_out_ = 0;
  lingering_ = false;
  while (out.iterations < options.max_iterations) {
    if (const auto stop = context.stop()) {
      out.status = *stop;
      return out;
    }
    assemble(state);
    factor(state, options, out);
    if (linear_.broken()) return out;
    linear_.solve(state, step_);
    const double size = network_.size_of(step_);
    if (!std::isfinite(size)) return out;
    record_.push_back(size);

    std::optional<double> share = guarded_share(state, damped(size) * std::min(1.0, largest_step / size));
    if (!share) continue;
    if (options.descend) share = descending_share(state, *share);
    if (!options.descend) network_.predict(step_, *share);
    if (further_) further_->stepped(state, step_, *share);
    network_.apply(state, step_, *share);
    out.last_step = *share * size;
    if (*share == 0) return out;

    const bool full = *share == 1;
    const bool exact = stress_ == Stress::predicted || stress_ == Stress::actual;
    const bool sound = out.negative_pivots == 0 || !options.stable_only || network_.has_moments();
    if (full && exact && sound && linear_.shift() == 0 && settled(size, options)) {
      out.status = Status::solved;
      return out;
    }
    if (linear_.shift() > 0 && out.last_step < saddle_step && mode_moves_ < most_mode_moves) leave_saddle(state);
    if (full) linear_.relax_shift();
    // Close to the solution of a large network the predicted wrench can keep the steps from shrinking; there the actual one is sound.
    // A single rod that lingers does so along a nearly neutral direction, on which the predicted one is the safer guide; steps in
    // contact shrink slowly for reasons of their own.
    lingering_ = !further_ && network_.rods() > 1 && size < quadratic_regime && (lingering_ || size > lingering_ratio * previous_size_);
    previous_size_ = size;
    stress_ = options.descend || lingering_ ? Stress::actual : size > rough_step ? Stress::rough : Stress::predicted;
  }
  return out;
}

}  // namespace tendril
