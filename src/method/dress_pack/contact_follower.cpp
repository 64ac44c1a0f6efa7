#include "method/dress_pack/contact_follower.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "statics/network_solver.h"
#include "statics/solve.h"

namespace tendril::dress_pack {
namespace {

constexpr double largest_move = 0.02;    // of the length, from where a vertex was carried
constexpr double growth = 1.7;
constexpr double most_ahead = 2;         // times the last step: no farther is its correction relied on,
constexpr double most_aside = 0.1;       // nor where the joints turn into another direction by more
constexpr double clear_radii = 0.3;
constexpr int trial_iterations = 250;    // of a step that may be halved; the smallest has
constexpr int last_iterations = 2000;

/// What a rigid body that was at one frame and is at another does to points and rotations.
struct RigidMove {
  Quat turn = Quat::Identity();
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  Vec3 at(const Vec3& p) const { return to + turn * (p - from); }
};

struct HeldMove {
  double s;
  RigidMove move;
};

/// Rigid moves of the holds of a rod, by arc length.
std::vector<HeldMove> held_moves(const PackProblem& pack, int rod, const Equilibrium& shape, const std::vector<Frame>& before,
                                 const std::vector<Frame>& after) {
  std::vector<HeldMove> out;
  for (std::size_t h = 0; h < pack.rods[rod].holds.size(); ++h) {
    HeldMove held{shape.reactions[h].s, {}};
    for (std::size_t k = 0; k < pack.attachments.size(); ++k)
      if (pack.attachments[k].rod == rod && pack.attachments[k].hold == static_cast<int>(h))
        held.move = {after[k].rotation * before[k].rotation.conjugate(), before[k].at, after[k].at};
    out.push_back(held);
  }
  std::sort(out.begin(), out.end(), [](const HeldMove& a, const HeldMove& b) { return a.s < b.s; });
  return out;
}

Frame moved(const Frame& frame, double s, const std::vector<HeldMove>& held) {
  std::size_t next = 0;
  while (next < held.size() && held[next].s < s) ++next;
  const HeldMove& b = held[std::min(next, held.size() - 1)];
  const HeldMove& a = next == 0 ? b : held[next - 1];
  const double share = b.s > a.s ? std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0) : 1.0;
  const Quat turn = a.move.turn.slerp(share, b.move.turn);
  return {(1 - share) * a.move.at(frame.at) + share * b.move.at(frame.at), (turn * frame.rotation).normalized()};
}

SystemEquilibrium solve_fitted(const SystemProblem& system, const SolveOptions& options, const RunContext& context,
                               const SystemEquilibrium* from) {
  system.check();
  NetworkSolver solver(system, options);
  solver.fit_contact_to_forces();
  return solver.solve(context, from);
}

PackFollower::Snap farthest(const SystemEquilibrium& a, const SystemEquilibrium& b, double& share) {
  PackFollower::Snap most;
  share = 0;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].points.size(); ++i) {
      const double move = (a.rods[k].points[i] - b.rods[k].points[i]).norm();
      if (move > most.move) most.rod = static_cast<int>(k), most.move = move;
      share = std::max(share, move / a.rods[k].s.back());
    }
  return most;
}

}  // namespace

ContactFollower::ContactFollower(PackBodies& bodies, const ContactLimits& limits)
    : bodies_(bodies), pack_(bodies.pack()), limits_(limits), system_{pack_.rods, {}} {
  bodies_.surround(system_);
  // Sliding sections keep their numbers of segments to both sides wherever they go.
  for (RodProblem& rod : system_.rods)
    for (Hold& hold : rod.holds)
      if (hold.slide && hold.cut_at < 0) hold.cut_at = hold.at;
}

const PackGaps& ContactFollower::gaps() {
  if (!gaps_ || pack_.slides()) {
    gaps_ = std::make_unique<PackGaps>(bodies_, here_, Compared::contact);
    memory_ = {};
  }
  return *gaps_;
}

void ContactFollower::take(SystemEquilibrium found) {
  here_ = std::move(found);
  for (std::size_t k = 0; k < system_.rods.size(); ++k)
    for (std::size_t h = 0; h < system_.rods[k].holds.size(); ++h)
      if (system_.rods[k].holds[h].slide) system_.rods[k].holds[h].at = here_.rods[k].reactions[h].s;
}

void ContactFollower::set_here(SystemEquilibrium equilibrium) {
  correction_.clear();
  take(std::move(equilibrium));
}

SystemEquilibrium ContactFollower::solve_at(const JointVector& q, const SystemEquilibrium* from, int most_iterations,
                                            const RunContext& context) {
  bodies_.move(q);
  pack_.place(pack_.poses(q), system_);
  SolveOptions options;
  options.tolerance = limits_.tolerance;
  options.max_iterations = most_iterations;
  options.follow = from != nullptr;
  ++solutions_;
  SystemEquilibrium found = pack_.slides() ? solve(system_, options, context, from) : solve_fitted(system_, options, context, from);
  iterations_ += found.rods.front().iterations;
  return found;
}

ContactFollower::Outcome ContactFollower::start(const JointVector& q, const SystemEquilibrium* from, const RunContext& context) {
  Outcome out;
  SystemEquilibrium found = solve_at(q, from, last_iterations, context);
  out.status = found.rods.front().status;
  if (!found.ok()) {
    out.message = found.rods.front().message;
    return out;
  }
  set_here(std::move(found));
  return out;
}

SystemEquilibrium ContactFollower::carried(const std::vector<Frame>& before, const std::vector<Frame>& after) const {
  SystemEquilibrium out = here_;
  for (std::size_t k = 0; k < out.rods.size(); ++k) {
    Equilibrium& rod = out.rods[k];
    const std::vector<HeldMove> held = held_moves(pack_, static_cast<int>(k), rod, before, after);
    for (std::size_t i = 0; i < rod.s.size(); ++i) {
      const Frame there = moved({rod.points[i], rod.rotations[i]}, rod.s[i], held);
      rod.points[i] = there.at;
      rod.rotations[i] = there.rotation;
    }
  }
  return out;
}

/// What the solver changed of a carried shape it will change again on the way straight on.
void ContactFollower::learn(const JointVector& way, const SystemEquilibrium& carried, const SystemEquilibrium& found) {
  last_way_ = way;
  correction_.clear();
  for (std::size_t k = 0; k < found.rods.size(); ++k) {
    const Equilibrium &a = carried.rods[k], &b = found.rods[k];
    for (std::size_t i = 0; i < b.points.size(); ++i)
      correction_.push_back({b.points[i] - a.points[i], (a.rotations[i].conjugate() * b.rotations[i]).normalized()});
  }
}

std::optional<SystemEquilibrium> ContactFollower::corrected(const JointVector& way, const SystemEquilibrium& carried) const {
  if (correction_.empty() || pack_.slides()) return std::nullopt;
  const double share = way.dot(last_way_) / last_way_.squaredNorm();
  if (!(share > 0 && share <= most_ahead) || (way - share * last_way_).norm() > most_aside * way.norm()) return std::nullopt;
  SystemEquilibrium out = carried;
  auto next = correction_.begin();
  for (Equilibrium& rod : out.rods)
    for (std::size_t i = 0; i < rod.points.size(); ++i, ++next) {
      rod.points[i] += share * next->at;
      rod.rotations[i] = (rod.rotations[i] * exp_rotation(share * log_rotation(next->rotation))).normalized();
    }
  return out;
}

double ContactFollower::haste(const SystemEquilibrium& moved, const JointVector& from, const JointVector& to) {
  if (bodies_.size() == 0) return 0;
  const PackGaps& gaps = this->gaps();
  gaps.place(state_of(here_), from, before_);
  gaps.place(state_of(moved), to, after_);
  return gaps.haste(before_, after_, memory_);
}

bool ContactFollower::clear(const JointVector& q) {
  for (const Equilibrium& rod : here_.rods)
    if (!rod.contacts.empty()) return false;
  const PackGaps& gaps = this->gaps();
  const RodState state = state_of(here_);
  gaps.place(state, q, after_);
  for (std::size_t k = 0; k < pack_.rods.size(); ++k) {
    const double limit = clear_radii * pack_.rods[k].rod.largest_radius();
    if (gaps.smallest(static_cast<int>(k), state, after_, limit, memory_).body >= 0) return false;
  }
  return true;
}

ContactFollower::Outcome ContactFollower::advance(const JointVector& from, const JointVector& to, bool leave, const RunContext& context) {
  Outcome out;
  const double way = from.size() ? (to - from).cwiseAbs().maxCoeff() : 0;
  const double longest = way > limits_.largest_turn ? limits_.largest_turn / way : 1;
  const double shortest = way > 0 ? std::min(1.0, limits_.smallest_turn / way) : 1;
  double step = longest;
  std::vector<Frame> before = pack_.poses(from);
  const auto at = [&](double share) { return share == 1 ? to : JointVector(from + share * (to - from)); };
  while (out.reached < 1) {
    if (const auto stop = context.stop()) {
      out.status = *stop;
      out.message = "interrupted";
      return out;
    }
    if (solutions_ >= limits_.most_solutions) {
      out.message = "not finished in " + std::to_string(solutions_) + " solutions with contact";
      return out;
    }
    const double next = out.reached + step > 1 - 1e-9 ? 1 : out.reached + step, made = next - out.reached;
    const JointVector q = at(next);
    const std::vector<Frame> after = pack_.poses(q);
    const SystemEquilibrium begin = carried(before, after);
    const bool smallest = made <= shortest * (1 + 1e-9);
    if (const double haste = this->haste(begin, at(out.reached), q); haste > 1 && !smallest) {
      step = std::max(shortest, std::min(0.9 / haste, 0.9) * made);
      continue;
    }
    const JointVector here = at(out.reached), made_way = q - here;
    std::optional<SystemEquilibrium> ahead = corrected(made_way, begin);
    if (ahead && haste(*ahead, here, q) > 1) ahead.reset();
    SystemEquilibrium found = solve_at(q, ahead ? &*ahead : &begin, smallest ? last_iterations : trial_iterations, context);
    out.status = found.rods.front().status;
    if (out.status == Status::cancelled || out.status == Status::timeout) {
      out.message = "interrupted";
      return out;
    }
    double moved = 0;
    PackFollower::Snap snap;
    if (found.ok()) snap = farthest(begin, found, moved);
    const bool smooth = found.ok() && moved <= largest_move;
    if (!smooth && !smallest) {
      step = std::max(shortest, 0.5 * made);
      continue;
    }
    if (!found.ok()) {
      out.message = found.rods.front().message;
      return out;
    }
    if (!smooth) {
      snap.share = next;
      snap.energy_drop = here_.energy() - found.energy();
      out.snaps.push_back(snap);
    }
    if (smooth) learn(made_way, begin, found);
    else correction_.clear();
    take(std::move(found));
    before = after;
    out.reached = next;
    if (smooth && moved < 0.5 * largest_move) step = std::min(growth * std::max(step, made), longest);
    if (leave && clear(q)) {
      out.free = true;
      break;
    }
  }
  out.status = Status::solved;
  return out;
}

}  // namespace tendril::dress_pack
