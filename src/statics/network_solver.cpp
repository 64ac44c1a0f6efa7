#include "statics/network_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "statics/contact_reach.h"
#include "statics/network_guess.h"

namespace tendril {
namespace {

/// Stretch stiffness that the softened fallback works with: enough that nothing else changes much.
double softened_stiffness(const RodNetwork& network) {
  double loads = 0, bending = 0;
  for (int k = 0; k < network.rods(); ++k) {
    const RodProblem& problem = network.rod(k).problem();
    loads += problem.rod.mass() * problem.gravity.norm();
    for (const PointLoad& load : problem.loads) loads += load.force.norm() + load.moment.norm() / network.rod(k).length();
    bending = std::max(bending, network.rod(k).bending_scale());
  }
  return std::max(1e4 * bending, 50 * loads);
}

// Where a force outweighs the bending stiffness over a segment, h^2 n/(12 EI), the fourth-order element's series is no
// longer one. From the second value on there is no hope that it converges, even from the staggered element's solution.
constexpr double too_long = 0.5, far_too_long = 2;
// Expected from the weight and the stretch: from here on the staggered element comes first.
constexpr double expected_too_long = 0.7;
constexpr int most_refining = 8;   // iterations from the staggered element's solution

double force_over_bending(const MeshSegment& segment, double force) {
  return segment.length * segment.length * force / (12 * std::min(segment.section.EI1, segment.section.EI2));
}

double largest_force_over_bending(const RodNetwork& network, const SystemEquilibrium& found) {
  double largest = 0;
  for (int k = 0; k < network.rods(); ++k) {
    const std::vector<Vec3>& forces = found.rods[k].forces;
    for (std::size_t i = 0; i < forces.size(); ++i)
      largest = std::max(largest, force_over_bending(network.rod(k).mesh().segments[i], forces[i].norm()));
  }
  return largest;
}

/// How far the holds pull the rod beyond its length, the largest between neighbours in position: a strain.
double stretch_between_holds(const RodProblem& problem) {
  double largest = 0;
  for (const Hold& a : problem.holds)
    for (const Hold& b : problem.holds) {
      const double apart = b.at - a.at;
      if (!(apart > 0) || !a.position || !b.position || a.slide || b.slide) continue;
      largest = std::max(largest, (b.frame.at - a.frame.at).norm() / apart - 1);
    }
  return largest;
}

/// The same before anything is solved: half the rod's weight, or what its holds stretch it by, on its softest long segment.
double expected_force_over_bending(const RodNetwork& network) {
  double largest = 0;
  for (int k = 0; k < network.rods(); ++k) {
    const RodProblem& problem = network.rod(k).problem();
    const double weight = 0.5 * problem.rod.mass() * problem.gravity.norm(), stretch = stretch_between_holds(problem);
    if (weight == 0 && stretch == 0) continue;
    for (const MeshSegment& segment : network.rod(k).mesh().segments)
      largest = std::max(largest, force_over_bending(segment, std::max(weight, stretch * segment.section.EA)));
  }
  return largest;
}

std::vector<int> segments_of(const SystemProblem& problem) {
  std::vector<int> segments;
  for (const RodProblem& rod : problem.rods) segments.push_back(rod.rod.segments);
  return segments;
}

int vertices_of(const RodNetwork& network) {
  int sum = 0;
  for (int k = 0; k < network.rods(); ++k) sum += network.rod(k).mesh().vertices();
  return sum;
}

/// One verdict for all rods of the system.
void set_verdict(const NewtonOutcome& outcome, const std::string& message, const std::vector<double>& steps, SystemEquilibrium& out) {
  for (Equilibrium& rod : out.rods) {
    rod.status = outcome.status;
    rod.iterations = outcome.iterations;
    rod.last_step = outcome.last_step;
    rod.steps = steps;
    rod.negative_pivots = outcome.negative_pivots;
    rod.stable = rod.ok() && outcome.negative_pivots == 0;
    rod.message = message;
  }
}

std::string explain_failure(const NewtonOutcome& outcome, const RodNetwork& network) {
  char text[256];
  switch (outcome.status) {
    case Status::cancelled: return "interrupted; this is the best state so far";
    case Status::timeout: return "out of time; this is the best state so far";
    default: break;
  }
  std::snprintf(text, sizeof text,
                "no equilibrium found in %d iterations (last step %.1e, %d negative pivots, %d vertices); try more segments, "
                "or move the holds there in steps",
                outcome.iterations, outcome.last_step, outcome.negative_pivots, vertices_of(network));
  return text;
}

}  // namespace

NetworkSolver::NetworkSolver(const SystemProblem& problem, const SolveOptions& options, int refinement)
    : options_(options),
      refinement_(refinement),
      network_(std::make_unique<RodNetwork>(problem, options, segments_of(problem), refinement)),
      newton_(*network_, nullptr) {
  if (can_touch(*network_, options_.clearance)) contact_ = std::make_unique<ContactSolver>(*network_, options_);
}

RodState NetworkSolver::starting_state(const SystemEquilibrium* from) const {
  if (!from && contact_) return contact_->clear_start();
  if (!from) {
    const NetworkGuess guess = network_guess(*network_);
    return network_->state_from(guess.rods, guess.branches);
  }
  std::vector<std::vector<Frame>> rods;
  for (int k = 0; k < network_->rods(); ++k) {
    const Equilibrium& rod = from->rods[k];
    const std::vector<double>& s = network_->rod(k).mesh().s;
    const double stretch = rod.s.back() / s.back();
    std::vector<Frame> frames;
    frames.reserve(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (rod.s.size() == s.size())
        frames.push_back({rod.points[i], rod.rotations[i]});
      else
        frames.push_back(rod.frame_at(s[i] * stretch));
    }
    rods.push_back(std::move(frames));
  }
  return network_->state_from(rods, from->branches);
}

NewtonOutcome NetworkSolver::iterate(RodState& state, bool warm, const RunContext& context) {
  NewtonOptions options;
  options.tolerance = options_.tolerance;
  // Of many rods one after the other may snap through on the way.
  options.max_iterations = std::min(network_->rods() > 1 ? 500 : 40, options_.max_iterations);
  options.stable_only = options_.stable_only;
  options.warm = warm;
  return newton_.run(state, options, context);
}

NewtonOutcome NetworkSolver::with_fallbacks(RodState& state, bool warm, const RunContext& context, int& fallbacks) {
  const RodState start = state;
  substitute_.reset();
  NewtonOutcome outcome;
  int spent = 0;
  const bool staggered_first = options_.element == Element::se3 && !warm && options_.stable_only && !network_->has_moments() &&
                               expected_force_over_bending(*network_) > expected_too_long;
  if (staggered_first) {
    outcome = by_staggered(state, options_.max_iterations, context);
    spent = outcome.iterations;
    if (outcome.status != Status::stalled) return outcome;
    state = start;
  }
  outcome = iterate(state, warm, context);
  outcome.iterations = spent += outcome.iterations;
  if (outcome.status != Status::stalled) return outcome;
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
  if (network_->has_moments()) {
    ++fallbacks;
    state = start;
    outcome = load_in_steps(state, context);
    outcome.iterations += spent;
    return outcome;
  }
  if (options_.follow) {
    ++fallbacks;
    attempt(true, options_.max_iterations, true);
    return outcome;
  }
  // B: by way of the staggered element.
  if (options_.element == Element::se3 && !staggered_first) {
    ++fallbacks;
    state = start;
    outcome = by_staggered(state, options_.max_iterations - spent, context);
    outcome.iterations = spent += outcome.iterations;
    if (outcome.status != Status::stalled) return outcome;
  }
  // C: down the energy of a rod that stretches easily, then mixed-stress steps on the true one.
  ++fallbacks;
  network_->cap_stretch_stiffness(softened_stiffness(*network_));
  attempt(true, 300, true);
  network_->cap_stretch_stiffness(INFINITY);
  if (outcome.status == Status::cancelled || outcome.status == Status::timeout) return outcome;
  attempt(false, 60, false);
  if (outcome.status != Status::stalled) return outcome;
  // D: down the true energy.
  ++fallbacks;
  attempt(true, options_.max_iterations, true);
  return outcome;
}

NewtonOutcome NetworkSolver::by_staggered(RodState& state, int most, const RunContext& context) {
  SolveOptions options = options_;
  options.element = Element::staggered;
  options.clamp = ClampRule::half_cell;
  options.max_iterations = most;
  NetworkSolver other(network_->problem(), options, refinement_);
  const auto frames_of = [](const RodNetwork& network, const RodState& from) {
    NetworkGuess frames;
    for (int k = 0; k < network.rods(); ++k) frames.rods.push_back(network.rod(k).frames_of(network.of_rod(k, from)));
    for (int b = 0; b < static_cast<int>(network.problem().branches.size()); ++b)
      frames.branches.push_back(network.branch_frame(b, from));
    return frames;
  };
  const NetworkGuess start = frames_of(*network_, state);
  RodState there = other.network_->state_from(start.rods, start.branches);
  int its_fallbacks = 0;
  NewtonOutcome outcome = other.with_fallbacks(there, false, context, its_fallbacks);
  newton_.add_to_record(other.newton_.record());
  if (outcome.status != Status::solved) return outcome;
  SystemEquilibrium found;
  other.describe(there, found);
  const double force = largest_force_over_bending(*network_, found);
  if (force > far_too_long) {
    substitute_ = std::make_unique<SystemEquilibrium>(std::move(found));
    return outcome;
  }
  const NetworkGuess reached = frames_of(*other.network_, there);
  RodState closer = network_->state_from(reached.rods, reached.branches);
  for (int k = 0; k < network_->rods(); ++k)
    network_->rod(k).expect(network_->of_rod(k, closer), found.rods[k].forces, found.rods[k].moments);
  NewtonOptions from_there;
  from_there.tolerance = options_.tolerance;
  from_there.continued = true;
  from_there.max_iterations = std::min(most_refining, most - outcome.iterations);
  NewtonOutcome refined = newton_.run(closer, from_there, context);
  refined.iterations += outcome.iterations;
  outcome.iterations = refined.iterations;
  if (refined.status == Status::solved || force <= too_long) {
    state = closer;
    return refined;
  }
  substitute_ = std::make_unique<SystemEquilibrium>(std::move(found));
  return outcome;
}

SystemEquilibrium NetworkSolver::solve_in_contact(const RunContext& context, const SystemEquilibrium* from) {
  SystemEquilibrium out;
  RodState state = starting_state(from);
  if (from)
    if (std::optional<RodState> aside = contact_->led_around(state)) {
      state = std::move(*aside);
      from = nullptr;
    }
  contact_->newton().begin_record();
  const ContactOutcome outcome = contact_->run(state, from, context);
  describe(state, out);
  const bool solved = outcome.newton.status == Status::solved;
  set_verdict(outcome.newton,
              solved                    ? "solved"
              : outcome.message.empty() ? explain_failure(outcome.newton, *network_)
                                        : outcome.message,
              contact_->newton().record(), out);
  for (Equilibrium& rod : out.rods) rod.fallbacks = outcome.fallbacks;
  return out;
}

NewtonOutcome NetworkSolver::load_in_steps(RodState& state, const RunContext& context) {
  NewtonOutcome outcome;
  int spent = 0;
  double share = 0, step = 0.1;
  while (share < 1 && step > 1e-3 && spent < options_.max_iterations) {
    const double next = std::min(1.0, share + step);
    network_->scale_moments(next);
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
  network_->scale_moments(1);
  outcome.iterations = spent;
  return outcome;
}

/// Vertices at the same arc lengths: a rod that has become longer or has slid begins without the stress of its stretching.
bool NetworkSolver::on_same_mesh(const SystemEquilibrium& from) const {
  for (int k = 0; k < network_->rods(); ++k) {
    const std::vector<double>& s = network_->rod(k).mesh().s;
    if (from.rods[k].s.size() != s.size()) return false;
    for (std::size_t i = 0; i < s.size(); ++i)
      if (std::abs(from.rods[k].s[i] - s[i]) > 1e-12 * s.back()) return false;
  }
  return true;
}

SystemEquilibrium NetworkSolver::solve(const RunContext& context, const SystemEquilibrium* from) {
  if (from && (from->rods.size() != network_->problem().rods.size() ||
               from->branches.size() != network_->problem().branches.size() || !from->complete()))
    from = nullptr;
  if (contact_) return solve_in_contact(context, from);
  return solve_from(starting_state(from), from && on_same_mesh(*from), context);
}

SystemEquilibrium NetworkSolver::solve_from(RodState state, bool warm, const RunContext& context) {
  SystemEquilibrium out;
  int fallbacks = 0;
  newton_.begin_record();
  const NewtonOutcome outcome = with_fallbacks(state, warm, context, fallbacks);
  const bool solved = outcome.status == Status::solved, substituted = solved && substitute_;
  if (substituted)
    out = std::move(*substitute_);
  else
    describe(state, out);
  set_verdict(outcome,
              substituted ? "solved with the staggered element: the segments are too long for the tension in them"
              : solved    ? "solved"
                          : explain_failure(outcome, *network_),
              newton_.record(), out);
  for (Equilibrium& rod : out.rods) rod.fallbacks = fallbacks;
  return out;
}

void NetworkSolver::assemble_exact(const RodState& state, StepSystem& linear) {
  network_->assemble(state, Stress::actual, linear.block);
  if (contact_) contact_->add_exact(state, linear.block);
  network_->join(state, Stress::actual, linear.block);
  linear.take_out_held(state);
}

void NetworkSolver::describe(const RodState& state, SystemEquilibrium& out) {
  out.rods.resize(network_->rods());
  network_->gradient(state, gradient_);
  if (contact_) contact_->add_gradient(state, gradient_);
  for (int k = 0; k < network_->rods(); ++k) {
    RodSystem& system = network_->rod(k);
    Equilibrium& rod = out.rods[k];
    const StateView own = network_->of_rod(k, state);
    rod.s = system.mesh().s;
    rod.points.reserve(rod.s.size());
    rod.rotations.reserve(rod.s.size());
    for (const Frame& frame : system.frames_of(own)) {
      rod.points.push_back(frame.at);
      rod.rotations.push_back(frame.rotation);
    }
    for (const MeshSegment& segment : system.mesh().segments) rod.radii.push_back(segment.section.radius());
    system.describe(own, rod);
    rod.reactions.resize(system.problem().holds.size());
    for (std::size_t h = 0; h < rod.reactions.size(); ++h) {
      rod.reactions[h].s = system.problem().holds[h].at;
      system.add_reaction(static_cast<int>(h), own, gradient_.data() + network_->first_node(k), rod.reactions[h]);
    }
  }
  for (int k = 0; contact_ && k < network_->rods(); ++k) contact_->describe(state, k, out.rods[k]);
  describe_joints(state, gradient_, out);
  network_->join_gradient(state, gradient_);
  double residual = 0;
  for (int i = 0; i < network_->nodes(); ++i)
    for (int c = 0; c < 6; ++c)
      if (!(network_->held()[i] >> c & 1))
        residual = std::max(residual, std::abs(gradient_[i][c]) / (c < 3 ? 1 : network_->size()));
  for (Equilibrium& rod : out.rods) rod.residual = residual;
}

/// What the branch points do to the rods, and what holds the branch points. `gradient`: not joined.
void NetworkSolver::describe_joints(const RodState& state, const std::vector<Vec6>& gradient, SystemEquilibrium& out) const {
  const std::vector<BranchPoint>& branches = network_->problem().branches;
  std::vector<int> seen(network_->rods(), 0);
  for (int b = 0; b < static_cast<int>(branches.size()); ++b) {
    const Frame frame = network_->branch_frame(b, state);
    out.branches.push_back(frame);
    Reaction support;
    for (const JoinedSection& section : branches[b].sections) {
      const RodSystem& system = network_->rod(section.rod);
      const auto at = system.section_at(system.mesh().joint_vertex[seen[section.rod]++]);
      const int first = network_->first_node(section.rod);
      Reaction on_rod;
      on_rod.s = section.at;
      on_rod.force = gradient[first + at.position].head<3>();
      on_rod.moment = state.q[first + at.rotation] * Vec3(gradient[first + at.rotation].tail<3>());
      support.force += on_rod.force;
      support.moment += on_rod.moment + (state.r[first + at.position] - frame.at).cross(on_rod.force);
      out.rods[section.rod].reactions.push_back(on_rod);
    }
    out.branch_supports.push_back(support);
  }
}

}  // namespace tendril
