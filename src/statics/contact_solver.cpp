#include "statics/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace tendril {

namespace {

constexpr double soft = 0.1, hard = 0.01;            // overlap under the reference force, in radii
constexpr double other_hardness[] = {0.03, 0.004};     // a stalled run is tried again from the start with these
constexpr double soft_tolerance = 2e-2;
constexpr double hard_step = 0.02, loose_step = 2e-3;  // radii: what may be left of a step before the first update, later
constexpr double slow = 0.4, hardening = 4;          // an overlap that falls less than this makes the law so much stiffer
constexpr double one_more = 3;                       // times the overlap aimed at: one update takes that away
constexpr double fitted_softness = 0.04;             // overlap under the forces that a motion comes with, in radii
constexpr double least_fitted = 1e-3;                // share of the reference force that the law is fitted to at least
constexpr int warm_iterations = 16;                  // a warm start that is worth it needs fewer
constexpr int soft_iterations = 40, hard_iterations = 80, update_iterations = 60, descent_iterations = 300;

std::string text(const char* format, double a) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a);
  return buffer;
}

/// False: nothing touches.
bool fit_laws(ContactNetwork& terms, const SystemEquilibrium& from) {
  bool any = false;
  for (const ContactNetwork::Rod& rod : terms.rods()) {
    double force = 0, length = 0;
    for (const ContactForce& contact : from.rods[rod.index].contacts) {
      force += contact.force.norm();
      length += contact.length;
    }
    if (!(force > 0 && length > 0)) continue;
    const double fitted = std::max(force / length, least_fitted * rod.reference);
    rod.terms->set().law = ContactLaw::for_overlap(fitted, rod.radius, fitted_softness);
    any = true;
  }
  return any;
}

}  // namespace

ContactSolver::ContactSolver(RodNetwork& network, const SolveOptions& options, const ContactOptions& contact)
    : network_(&network),
      options_(options),
      contact_(contact),
      terms_(network, options.element, options.clearance),
      newton_(network, &terms_) {}

NewtonOutcome ContactSolver::stage(RodState& state, Start start, double tolerance, int most_iterations, bool descend,
                                   const RunContext& context) {
  terms_.set_exact(descend);
  terms_.begin(state);
  NewtonOptions options;
  options.tolerance = tolerance;
  options.max_iterations = std::min(most_iterations, options_.max_iterations - used_);
  options.stable_only = options_.stable_only;
  options.warm = start == Start::warm;
  options.descend = descend;
  options.convex = (start == Start::cold || !another_try_) && !descend;
  const NewtonOutcome out = newton_.run(state, options, context);
  used_ += out.iterations;
  terms_.set_exact(false);
  return out;
}

double ContactSolver::loose(double step) const { return std::max(terms_.smallest_share(step), options_.tolerance); }

bool ContactSolver::over(const ContactOutcome& out) const {
  return out.newton.status == Status::cancelled || out.newton.status == Status::timeout ||
         used_ >= options_.max_iterations;
}

/// The hard law by Newton's method, else by descent from where it got, else by descent from the start.
NewtonOutcome ContactSolver::settle(RodState& state, const RodState& start, ContactOutcome& out,
                                    const RunContext& context) {
  out.newton = stage(state, out.newton.status == Status::solved ? Start::warm : Start::cold, loose(hard_step),
                     hard_iterations, false, context);
  for (int attempt = 0; attempt < 2 && out.newton.status != Status::solved && !over(out); ++attempt) {
    ++out.fallbacks;
    if (attempt == 1) state = start;
    out.newton = stage(state, Start::cold, loose(hard_step), descent_iterations, true, context);
    if (out.newton.status == Status::solved || over(out)) break;
    out.newton = stage(state, Start::warm, loose(hard_step), hard_iterations, false, context);
  }
  return out.newton;
}

/// Each round lets Newton's method come only as near as the next update needs it; the last one goes all the way.
void ContactSolver::remove_overlap(RodState& state, ContactOutcome& out, const RunContext& context) {
  double tolerance = loose(loose_step), before = std::numeric_limits<double>::infinity();
  while (out.newton.status == Status::solved && !over(out)) {
    const double deepest = terms_.deepest_at(state).radii;
    if (deepest <= contact_.overlap && terms_.widest_gap(state) <= largest_solved_overlap) {
      if (tolerance <= options_.tolerance) break;
      tolerance = options_.tolerance;
    } else {
      if (out.updates >= contact_.most_updates) break;
      // The update that will most likely be the last one is solved all the way at once.
      tolerance = deepest <= one_more * contact_.overlap ? options_.tolerance : loose(loose_step);
      terms_.update_shifts(state, contact_.overlap);
      // Where the rod can roll about its contacts the law must be stiff enough for the updates to come to rest.
      if (out.updates > 1 && deepest > slow * before) terms_.harden(hardening);
      before = deepest;
      ++out.updates;
    }
    const RodState start = state;
    out.newton = stage(state, Start::warm, tolerance, update_iterations, false, context);
    if (out.newton.status == Status::stalled && !over(out)) {
      ++out.fallbacks;
      state = start;
      out.newton = stage(state, Start::warm, tolerance, descent_iterations, true, context);
    }
  }
}

std::optional<RodState> ContactSolver::led_around(const RodState& state) {
  if (!terms_.first_crossing(state)) return std::nullopt;
  return tendril::clear_start(*network_, terms_, &state).state;
}

ContactOutcome ContactSolver::run(RodState& state, const SystemEquilibrium* from, const RunContext& context) {
  used_ = 0;
  another_try_ = false;
  if (options_.soft_contact > 0) return run_soft(state, from, context);
  ContactOutcome out = attempt(state, from, hard, context);
  another_try_ = true;
  for (const double other : other_hardness) {
    if (out.newton.status != Status::stalled || over(out)) break;
    RodState trial = clear_start();
    ContactOutcome again = attempt(trial, nullptr, other, context);
    again.fallbacks += out.fallbacks + 1;
    if (again.newton.status == Status::stalled && again.deepest > out.deepest) {
      out.newton.iterations = used_;
      continue;
    }
    out = std::move(again);
    state = std::move(trial);
  }
  return out;
}

/// The soft law alone: what overlaps stays.
ContactOutcome ContactSolver::run_soft(RodState& state, const SystemEquilibrium* from, const RunContext& context) {
  ContactOutcome out;
  const RodState start = state;
  terms_.forget_forces();
  terms_.set_softness(options_.soft_contact);
  out.newton = stage(state, from ? Start::warm : Start::cold, options_.tolerance, hard_iterations, false, context);
  if (out.newton.status == Status::stalled && !over(out)) {
    ++out.fallbacks;
    state = start;
    out.newton = stage(state, Start::cold, options_.tolerance, descent_iterations, true, context);
  }
  out.newton.iterations = used_;
  out.deepest = std::max(0.0, terms_.deepest_at(state).place.penetration);
  if (const auto crossing = terms_.first_crossing(state)) {
    out.message = "the rod crosses " + crossing_at(*crossing);
    if (out.newton.status == Status::solved) out.newton.status = Status::stalled;
  }
  return out;
}

ContactOutcome ContactSolver::attempt(RodState& state, const SystemEquilibrium* from, double hardness,
                                      const RunContext& context) {
  ContactOutcome out;
  const RodState start = state;
  terms_.forget_forces();
  terms_.set_softness(hardness);
  if (const auto crossing = terms_.first_crossing(state)) out.message = "the start crosses " + crossing_at(*crossing);

  const auto warm = [&] {
    for (const ContactNetwork::Rod& rod : terms_.rods()) rod.terms->take_forces(from->rods[rod.index].contacts);
    out.newton = stage(state, Start::warm, loose(hard_step), warm_iterations, false, context);
  };
  if (from) {
    const bool fitted = fitted_ && fit_laws(terms_, *from);
    warm();
    if (fitted && out.newton.status != Status::solved && !over(out)) {
      ++out.fallbacks;
      state = start;
      terms_.set_softness(hardness);
      warm();
    }
  } else {
    terms_.set_softness(soft);
    terms_.set_early_end(true);
    out.newton = stage(state, Start::cold, soft_tolerance, soft_iterations, false, context);
    terms_.set_early_end(false);
    terms_.set_softness(hardness);
  }
  if (!over(out) && !(from && out.newton.status == Status::solved)) settle(state, start, out, context);
  remove_overlap(state, out, context);
  out.newton.iterations = used_;
  judge(state, out);
  return out;
}

ContactOutcome ContactSolver::run_penalty(RodState& state, double stiffness, const RunContext& context) {
  ContactOutcome out;
  used_ = 0;
  for (const ContactNetwork::Rod& rod : terms_.rods())
    rod.terms->set().law = {stiffness, std::numeric_limits<double>::infinity()};
  out.newton = stage(state, Start::cold, options_.tolerance, hard_iterations, false, context);
  if (out.newton.status == Status::stalled) {
    ++out.fallbacks;
    out.newton = stage(state, Start::cold, options_.tolerance, descent_iterations, true, context);
  }
  out.newton.iterations = used_;
  out.deepest = terms_.deepest_at(state).place.penetration;
  return out;
}

/// Nothing that overlaps more than stated or crosses a surface is called solved.
void ContactSolver::judge(const RodState& state, ContactOutcome& out) {
  const ContactNetwork::Deepest deepest = terms_.deepest_at(state);
  out.deepest = std::max(0.0, deepest.place.penetration);
  std::string fault;
  if (const auto crossing = terms_.first_crossing(state))
    fault = "the rod crosses " + crossing_at(*crossing);
  else if (deepest.radii > largest_solved_overlap)
    fault = overlap_at(deepest, state);
  if (fault.empty()) return;
  out.message = (out.message.empty() ? "" : out.message + "; ") + fault;
  if (out.newton.status == Status::solved) out.newton.status = Status::stalled;
}

std::string ContactSolver::place_of(const ContactNetwork::Rod& rod, double s, const Vec3& at) const {
  return text("s = %.4g m", s) + (network_->rods() > 1 ? " of rod " + std::to_string(rod.index + 1) : "") +
         text(" (%.4g, ", at.x()) + text("%.4g, ", at.y()) + text("%.4g)", at.z());
}

std::string ContactSolver::crossing_at(const ContactNetwork::Crossing& crossing) const {
  return crossing.rod->terms->set().field().name(crossing.obstacle) + " at " + place_of(*crossing.rod, crossing.s, crossing.at);
}

std::string ContactSolver::overlap_at(const ContactNetwork::Deepest& deepest, const RodState& state) const {
  const ContactTerms& terms = *deepest.rod->terms;
  const std::string name = terms.set().field().name(deepest.place.obstacle);
  const std::string depth = text("%.3g mm ", 1e3 * deepest.place.penetration);
  const std::string place = place_of(*deepest.rod, deepest.place.point.s, terms.position_at(deepest.place.point.s, state));
  if (deepest.place.point.keep == 0) return "the rod overlaps " + name + " by " + depth + "at " + place;
  return "the rod comes " + depth + "nearer to " + name + " than its clearance at " + place;
}

void ContactSolver::add_exact(const RodState& state, BlockSystem& system) {
  for (const ContactNetwork::Rod& rod : terms_.rods()) rod.terms->add_to(state, true, system);
}

void ContactSolver::add_gradient(const RodState& state, std::vector<Vec6>& gradient) {
  scratch_.resize(network_->nodes(), static_cast<int>(network_->pattern().edges.size()));
  for (Vec6& g : scratch_.gradient) g.setZero();
  for (Mat6& block : scratch_.diagonal) block.setZero();
  for (Mat6& block : scratch_.upper) block.setZero();
  add_exact(state, scratch_);
  for (int i = 0; i < network_->nodes(); ++i) gradient[i] += scratch_.gradient[i];
}

void ContactSolver::describe(const RodState& state, int rod, Equilibrium& out) {
  out.contacts.clear();
  out.energy.contact = 0;
  ContactTerms* terms = terms_.of_rod(rod);
  if (!terms) return;
  terms->stand_at(state);
  const ContactSet& set = terms->set();
  for (int i = 0; i < set.size(); ++i) {
    const PointContact* c = set.at(i);
    if (!c || c->gradient.isZero(0)) continue;
    const ContactPoint& p = set.points()[i];
    out.contacts.push_back({p.s, set.positions()[i], -c->gradient, set.surface_distance(i) - p.radius, c->obstacle, p.weight});
    // What the shift adds is bookkeeping of the method, not stored energy.
    out.energy.contact += p.weight * set.law.at(p.radius - c->distance).energy;
  }
  for (const SlidingContacts::Point& p : terms->sliding().points()) {
    const PointContact& c = p.contact;
    if (!p.active || c.gradient.isZero(0)) continue;
    const double gap = c.distance + std::min(set.field().clearance(c.obstacle), p.at.keep) - p.at.radius;
    out.contacts.push_back({p.at.s, p.x, -c.gradient, gap, c.obstacle, p.at.weight});
    out.energy.contact += p.at.weight * set.law.at(p.at.radius - c.distance).energy;
  }
  std::sort(out.contacts.begin(), out.contacts.end(), [](const ContactForce& a, const ContactForce& b) { return a.s < b.s; });
  out.deepest_penetration = std::max(0.0, terms->deepest_at(state).penetration);
}

}  // namespace tendril
