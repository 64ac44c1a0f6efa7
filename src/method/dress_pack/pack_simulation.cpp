#include "method/dress_pack/pack_simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "base/error.h"
#include "base/number_text.h"
#include "method/dress_pack/contact_follower.h"
#include "method/dress_pack/pack_report.h"

namespace tendril::dress_pack {
namespace {

constexpr double touching_radii = 0.15;    // gaps below are left to the solver with contact
constexpr double longest_touching = 0.5;   // radii: it begins no farther than that from where a rod touches
constexpr double same_state = 1e-3;        // of the length

void check(const SimulationOptions& options) {
  if (options.steps < 1) throw UsageError("dress pack: " + std::to_string(options.steps) + " time steps, expected at least 1");
  if (!(options.smallest_turn > 0) || !(options.largest_turn >= options.smallest_turn) || !std::isfinite(options.largest_turn))
    throw UsageError("dress pack: motions of " + number_text(options.smallest_turn) + " to " + number_text(options.largest_turn) +
                     " rad, expected two positive numbers in this order");
  if (!(options.tolerance > 0) || options.tolerance > 1e-3)
    throw UsageError("dress pack: a tolerance of " + number_text(options.tolerance) + ", expected more than 0 and at most 1e-3");
  if (options.most_solutions < 1)
    throw UsageError("dress pack: at most " + std::to_string(options.most_solutions) + " solutions with contact, expected at least 1");
}

/// The times at which the path bends, between two others.
std::vector<double> stations(const JointPath& path, double from, double to) {
  std::vector<double> out;
  const int pieces = path.points() - 1;
  for (int k = static_cast<int>(std::ceil(from * pieces)); k < to * pieces; ++k)
    if (k > from * pieces + 1e-9 && k < to * pieces - 1e-9) out.push_back(static_cast<double>(k) / pieces);
  out.push_back(to);
  return out;
}

/// Compares each motion of the free pack with the places before.
class GapWatch final : public MotionWatch {
 public:
  GapWatch(const PackBodies& bodies, const RodNetwork& network) : gaps_(bodies, network, Compared::contact) {}

  void stand_at(const RodState& state, const JointVector& q) { gaps_.place(state, q, before_); }
  bool touches() { return !gaps_.watch(before_, before_, touching_radii, memory_).clear; }

  Verdict judge(const RodState& state, const JointVector& q) override {
    gaps_.place(state, q, after_);
    const PackGaps::Watch seen = gaps_.watch(before_, after_, touching_radii, memory_);
    if (seen.clear) return Verdict::clear;
    return seen.move > longest_touching ? Verdict::too_far : Verdict::touches;
  }
  void accept() override { std::swap(before_, after_); }

 private:
  PackGaps gaps_;
  PackGaps::Memory memory_;
  PackPlaces before_, after_;
};

class PackRun {
 public:
  PackRun(const PackProblem& pack, const JointPath& path, const SimulationOptions& options)
      : path_(path), times_(JointPath::times(options.steps)), bodies_(pack), reporter_(bodies_, options.robot_clearance),
        in_contact_(bodies_, {options.largest_turn, options.smallest_turn, options.tolerance, options.most_solutions}) {
    if (pack.slides()) return;
    statics_ = std::make_unique<PackStatics>(pack);
    follower_ = std::make_unique<PackFollower>(*statics_, FollowLimits{options.largest_turn, options.smallest_turn, options.tolerance, true});
    if (bodies_.size() == 0) return;
    watch_ = std::make_unique<GapWatch>(bodies_, statics_->network());
    follower_->set_watch(watch_.get());
  }

  void run(const RunContext& context, PackMotion& out) {
    if (!start(context, out)) return;
    keep(0, out);
    for (std::size_t k = 1; k < times_.size(); ++k) {
      if (!advance(times_[k - 1], times_[k], context, out)) break;
      keep(times_[k], out);
      if (context.progress) context.progress(times_[k], "motion");
    }
    out.iterations += static_cast<int>(in_contact_.iterations());
    out.contact_solutions = in_contact_.solutions();
    if (out.ok())
      out.message = out.snaps.empty() ? "solved" : "solved, with " + std::to_string(out.snaps.size()) + " snap-through" + (out.snaps.size() > 1 ? "s" : "");
  }

 private:
  bool start(const RunContext& context, PackMotion& out) {
    std::string why;
    if (follower_) {
      const PackFollower::Outcome start = follower_->start(state_, path_.at(0), context);
      out.iterations = start.iterations;
      out.status = start.status;
      why = start.message;
      free_ = start.ok();
      if (free_ && watch_) {
        watch_->stand_at(state_, path_.at(0));
        free_ = !watch_->touches();
      }
    }
    if (!free_ && (bodies_.size() > 0 || !follower_) && !context.stop()) {
      const ContactFollower::Outcome start = in_contact_.start(path_.at(0), nullptr, context);
      out.status = start.status;
      why = start.message;
    }
    if (!out.ok()) out.message = "no equilibrium at the start of the path: " + why;
    return out.ok();
  }

  bool advance(double from, double to, const RunContext& context, PackMotion& out) {
    for (const double there : stations(path_, from, to)) {
      while (from < there) {
        const double reached = free_ ? freely(from, there, context, out) : touching(from, there, context, out);
        if (!out.ok()) return false;
        from = reached;
      }
      from = there;
    }
    return true;
  }

  /// Until a rod touches. Returns the time that was reached.
  double freely(double from, double to, const RunContext& context, PackMotion& out) {
    const PackFollower::Outcome way = follower_->advance(state_, path_.at(from), path_.at(to), context);
    const double reached = way.reached >= 1 ? to : from + way.reached * (to - from);
    note(way.snaps, from, to, out);
    out.iterations += way.iterations;
    out.status = way.touches ? Status::solved : way.status;
    if (way.touches) {
      in_contact_.set_here(statics_->describe(state_));
      free_ = false;
    } else if (!way.ok()) {
      out.message = "no equilibrium beyond t = " + number_text(reached) + ": " + way.message;
    }
    return reached;
  }

  /// Until no rod touches any more.
  double touching(double from, double to, const RunContext& context, PackMotion& out) {
    const ContactFollower::Outcome way = in_contact_.advance(path_.at(from), path_.at(to), follower_ != nullptr, context);
    const double reached = way.reached >= 1 ? to : from + way.reached * (to - from);
    note(way.snaps, from, to, out);
    out.status = way.status;
    if (!way.ok()) out.message = "no equilibrium beyond t = " + number_text(reached) + ": " + way.message;
    if (way.free) come_free(path_.at(reached));
    return reached;
  }

  /// The other element of formulation stands where the ordinary solver stood, or else that goes on.
  void come_free(const JointVector& q) {
    RodState state = state_of(in_contact_.here());
    const RodState before = state;
    if (!statics_->move(state, bodies_.pack().poses(q)).ok) return;
    for (std::size_t i = 0; i < state.r.size(); ++i)
      if ((state.r[i] - before.r[i]).norm() > same_state * statics_->network().size()) return;
    watch_->stand_at(state, q);
    if (watch_->touches()) return;
    state_ = std::move(state);
    free_ = true;
  }

  static void note(const std::vector<PackFollower::Snap>& snaps, double from, double to, PackMotion& out) {
    for (const PackFollower::Snap& snap : snaps) out.snaps.push_back({from + snap.share * (to - from), snap.rod, snap.move, snap.energy_drop});
  }

  void keep(double t, PackMotion& out) {
    PackStep step;
    step.t = t;
    step.q = path_.at(t);
    step.state = free_ ? state_ : state_of(in_contact_.here());
    if (!free_) step.solved = std::make_shared<const SystemEquilibrium>(in_contact_.here());
    if (free_) reporter_.report(*statics_, step);
    else reporter_.report(in_contact_.here(), step);
    out.steps.push_back(std::move(step));
  }

  const JointPath& path_;
  std::vector<double> times_;
  PackBodies bodies_;
  PackReporter reporter_;
  ContactFollower in_contact_;
  std::unique_ptr<PackStatics> statics_;    ///< these three null for a pack that slides
  std::unique_ptr<PackFollower> follower_;
  std::unique_ptr<GapWatch> watch_;         ///< null without bodies
  RodState state_;                          ///< while free
  bool free_ = false;
};

template <class Read>
double largest_of(const std::vector<PackStep>& steps, Read read) {
  double most = -std::numeric_limits<double>::infinity();
  for (const PackStep& step : steps)
    for (const RodReport& rod : step.rods) most = std::max(most, read(rod));
  return most;
}

}  // namespace

PackMotion simulate(const PackProblem& pack, const JointPath& path, const SimulationOptions& options, const RunContext& context) {
  pack.check();
  check(options);
  const auto begin = std::chrono::steady_clock::now();
  PackMotion out;
  const std::string beyond = beyond_robot(path, *pack.robot);
  if (!beyond.empty()) {
    out.status = Status::infeasible;
    out.message = beyond;
    return out;
  }
  PackRun(pack, path, options).run(context, out);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

double RodReport::contact_force() const {
  double sum = 0;
  for (const ContactForce& contact : contacts) sum += contact.force.norm();
  return sum;
}

double PackMotion::largest_end_force() const {
  double most = 0;
  for (const PackStep& step : steps)
    for (const EndLoad& end : step.ends) most = std::max(most, end.force.norm());
  return most;
}

double PackMotion::largest_tension() const {
  return largest_of(steps, [](const RodReport& rod) { return rod.tension; });
}
double PackMotion::largest_twist() const {
  return largest_of(steps, [](const RodReport& rod) { return rod.twist; });
}
double PackMotion::smallest_bend_radius() const {
  return -largest_of(steps, [](const RodReport& rod) { return -rod.bend_radius; });
}
double PackMotion::smallest_robot_clearance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const PackStep& step : steps) least = std::min(least, step.robot.clearance);
  return least;
}
double PackMotion::smallest_clearance() const {
  return -largest_of(steps, [](const RodReport& rod) { return -rod.clearance; });
}

}  // namespace tendril::dress_pack
