#include "statics/solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "statics/first_guess.h"

namespace tendril {
namespace {

/// Stretch stiffness that the softened fallback works with: enough that nothing else changes much.
double softened_stiffness(const RodSystem& system) {
  const RodProblem& problem = system.problem();
  double loads = problem.rod.mass() * problem.gravity.norm();
  for (const PointLoad& load : problem.loads) loads += load.force.norm() + load.moment.norm() / system.length();
  return std::max(1e4 * system.bending_scale(), 50 * loads);
}

/// Segments so long that the tension outweighs the bending stiffness over them: the fourth-order element's series in
/// h^2 n/(12 EI) is then no longer one.
bool too_long_for_tension(const RodSystem& system, const Equilibrium& found) {
  double largest = 0;
  for (std::size_t i = 0; i < found.forces.size(); ++i) {
    const MeshSegment& segment = system.mesh().segments[i];
    const double softest = std::min(segment.section.EI1, segment.section.EI2);
    largest = std::max(largest, segment.length * segment.length * found.forces[i].norm() / (12 * softest));
  }
  return largest > 0.5;
}

std::string explain_failure(const NewtonOutcome& outcome, const RodSystem& system) {
  char text[256];
  switch (outcome.status) {
    case Status::cancelled: return "interrupted; this is the best state so far";
    case Status::timeout: return "out of time; this is the best state so far";
    default: break;
  }
  std::snprintf(text, sizeof text,
                "no equilibrium found in %d iterations (last step %.1e, %d negative pivots, %d vertices); try more segments, "
                "or move the holds there in steps",
                outcome.iterations, outcome.last_step, outcome.negative_pivots, system.mesh().vertices());
  return text;
}

}  // namespace

RodSolver::RodSolver(const RodProblem& problem, const SolveOptions& options, int segments, int refinement)
    : options_(options),
      segments_(segments),
      refinement_(refinement),
      system_(make_rod_system(problem, options, cut_into_segments(problem, segments, refinement))),
      newton_(*system_, nullptr) {
  if (problem.surroundings) contact_ = std::make_unique<ContactSolver>(*system_, options_);
}

RodState RodSolver::starting_state(const Equilibrium* from) const {
  if ((!from || from->s.empty()) && contact_) return contact_->clear_start();
  if (!from || from->s.empty()) return system_->state_from(first_guess(system_->problem(), system_->mesh()));
  const std::vector<double>& s = system_->mesh().s;
  const double stretch = from->s.back() / s.back();
  std::vector<Frame> frames;
  frames.reserve(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (from->s.size() == s.size())
      frames.push_back({from->points[i], from->rotations[i]});
    else
      frames.push_back(from->frame_at(s[i] * stretch));
  }
  return system_->state_from(frames);
}

NewtonOutcome RodSolver::iterate(RodState& state, bool warm, const RunContext& context) {
  NewtonOptions options;
  options.tolerance = options_.tolerance;
  options.max_iterations = std::min(40, options_.max_iterations);
  options.stable_only = options_.stable_only;
  options.warm = warm;
  return newton_.run(state, options, context);
}

NewtonOutcome RodSolver::with_fallbacks(RodState& state, bool warm, const RunContext& context, int& fallbacks) {
  const RodState start = state;
  substitute_.reset();
  NewtonOutcome outcome = iterate(state, warm, context);
  if (outcome.status != Status::stalled) return outcome;
  int spent = outcome.iterations;
  auto attempt = [&](bool descend, int most, bool from_start) {
    if (from_start) state = start;
    NewtonOptions options;
    options.tolerance = options_.tolerance;
    options.stable_only = true;
    options.descend = descend;
    options.warm = !descend && !from_start;
    options.max_iterations = std::min(most, options_.max_iterations - spent);
    outcome = newton_.run(state, options, context);
    outcome.iterations = spent += outcome.iterations;
  };
  if (system_->has_moments()) {
    ++fallbacks;
    state = start;
    outcome = load_in_steps(state, context);
    outcome.iterations += spent;
    return outcome;
  }
  // B: by way of the staggered element.
  if (options_.element == Element::se3) {
    ++fallbacks;
    state = start;
    outcome = by_staggered(state, options_.max_iterations - spent, context);
    outcome.iterations = spent += outcome.iterations;
    if (outcome.status != Status::stalled) return outcome;
  }
  // C: down the energy of a rod that stretches easily, then mixed-stress steps on the true one.
  ++fallbacks;
  system_->cap_stretch_stiffness(softened_stiffness(*system_));
  attempt(true, 300, true);
  system_->cap_stretch_stiffness(INFINITY);
  if (outcome.status == Status::cancelled || outcome.status == Status::timeout) return outcome;
  attempt(false, 60, false);
  if (outcome.status != Status::stalled) return outcome;
  // D: down the true energy.
  ++fallbacks;
  attempt(true, options_.max_iterations, true);
  return outcome;
}

NewtonOutcome RodSolver::by_staggered(RodState& state, int most, const RunContext& context) {
  SolveOptions options = options_;
  options.element = Element::staggered;
  options.clamp = ClampRule::half_cell;
  options.max_iterations = most;
  RodSolver other(system_->problem(), options, segments_, refinement_);
  RodState there = other.system_->state_from(system_->frames_of(state));
  int its_fallbacks = 0;
  NewtonOutcome outcome = other.with_fallbacks(there, false, context, its_fallbacks);
  if (outcome.status != Status::solved) return outcome;
  Equilibrium found;
  other.describe(there, found);
  RodState closer = system_->state_from(other.system_->frames_of(there));
  system_->expect(closer, found.forces, found.moments);
  NewtonOptions from_there;
  from_there.tolerance = options_.tolerance;
  from_there.continued = true;
  from_there.max_iterations = std::min(40, most - outcome.iterations);
  NewtonOutcome refined = newton_.run(closer, from_there, context);
  refined.iterations += outcome.iterations;
  outcome.iterations = refined.iterations;
  if (refined.status == Status::solved || !too_long_for_tension(*system_, found)) {
    state = closer;
    return refined;
  }
  substitute_ = std::make_unique<Equilibrium>(std::move(found));
  return outcome;
}

Equilibrium RodSolver::solve_in_contact(const RunContext& context, const Equilibrium* from) {
  Equilibrium out;
  RodState state = starting_state(from);
  const ContactOutcome outcome = contact_->run(state, from, context);
  out.status = outcome.newton.status;
  out.iterations = outcome.newton.iterations;
  out.last_step = outcome.newton.last_step;
  out.negative_pivots = outcome.newton.negative_pivots;
  out.fallbacks = outcome.fallbacks;
  out.stable = out.ok() && out.negative_pivots == 0;
  out.message = out.ok()                  ? "solved"
                : outcome.message.empty() ? explain_failure(outcome.newton, *system_)
                                          : outcome.message;
  describe(state, out);
  return out;
}

NewtonOutcome RodSolver::load_in_steps(RodState& state, const RunContext& context) {
  NewtonOutcome outcome;
  int spent = 0;
  double share = 0, step = 0.1;
  while (share < 1 && step > 1e-3 && spent < options_.max_iterations) {
    const double next = std::min(1.0, share + step);
    system_->scale_moments(next);
    RodState trial = state;
    outcome = iterate(trial, share > 0, context);
    spent += outcome.iterations;
    if (outcome.status == Status::cancelled || outcome.status == Status::timeout) break;
    if (outcome.status != Status::solved) {
      step *= 0.5;
      continue;
    }
    state = trial;
    share = next;
    step *= 1.5;
  }
  system_->scale_moments(1);
  outcome.iterations = spent;
  return outcome;
}

Equilibrium RodSolver::solve(const RunContext& context, const Equilibrium* from) {
  if (contact_) return solve_in_contact(context, from);
  Equilibrium out;
  RodState state = starting_state(from);
  const NewtonOutcome outcome = with_fallbacks(state, from != nullptr, context, out.fallbacks);
  const bool substituted = outcome.status == Status::solved && substitute_;
  if (substituted) {
    const int fallbacks = out.fallbacks;
    out = *substitute_;
    out.fallbacks = fallbacks;
  }
  out.status = outcome.status;
  out.iterations = outcome.iterations;
  out.last_step = outcome.last_step;
  out.negative_pivots = outcome.negative_pivots;
  out.stable = outcome.status == Status::solved && outcome.negative_pivots == 0;
  out.message = substituted ? "solved with the staggered element: the segments are too long for the tension in them"
                : out.ok()  ? "solved"
                            : explain_failure(outcome, *system_);
  if (!substituted) describe(state, out);
  return out;
}

void RodSolver::describe(const RodState& state, Equilibrium& out) {
  const RodMesh& mesh = system_->mesh();
  out.s = mesh.s;
  for (const Frame& frame : system_->frames_of(state)) {
    out.points.push_back(frame.at);
    out.rotations.push_back(frame.rotation);
  }
  for (const MeshSegment& segment : mesh.segments) out.radii.push_back(segment.section.radius());
  system_->describe(state, out);
  system_->gradient(state, gradient_);
  if (contact_) {
    contact_->add_gradient(state, gradient_);
    contact_->describe(state, out);
  }
  out.reactions.resize(system_->problem().holds.size());
  for (std::size_t k = 0; k < out.reactions.size(); ++k) {
    const Hold& hold = system_->problem().holds[k];
    out.reactions[k].s = hold.at;
    system_->add_reaction(static_cast<int>(k), state, gradient_, out.reactions[k]);
  }
  for (int i = 0; i < system_->nodes(); ++i)
    for (int k = 0; k < 6; ++k)
      if (!(system_->held()[i] >> k & 1))
        out.residual = std::max(out.residual, std::abs(gradient_[i][k]) / (k < 3 ? 1 : system_->length()));
}

}  // namespace tendril
