#include "method/dress_pack/pack_simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/number_text.h"
#include "method/dress_pack/pack_follower.h"
#include "method/dress_pack/pack_report.h"
#include "statics/motion.h"

namespace tendril::dress_pack {
namespace {

void check(const SimulationOptions& options) {
  if (options.steps < 1) throw UsageError("dress pack: " + std::to_string(options.steps) + " time steps, expected at least 1");
  if (!(options.smallest_turn > 0) || !(options.largest_turn >= options.smallest_turn) || !std::isfinite(options.largest_turn))
    throw UsageError("dress pack: motions of " + number_text(options.smallest_turn) + " to " + number_text(options.largest_turn) +
                     " rad, expected two positive numbers in this order");
  if (!(options.tolerance > 0) || options.tolerance > 1e-3)
    throw UsageError("dress pack: a tolerance of " + number_text(options.tolerance) + ", expected more than 0 and at most 1e-3");
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

class FreeMotion {
 public:
  FreeMotion(const PackProblem& pack, const JointPath& path, const SimulationOptions& options)
      : path_(path), times_(JointPath::times(options.steps)), statics_(pack), reporter_(statics_),
        follower_(statics_, {options.largest_turn, options.smallest_turn, options.tolerance, true}) {}

  void run(const RunContext& context, PackMotion& out) {
    RodState state;
    const PackFollower::Outcome start = follower_.start(state, path_.at(0), context);
    out.iterations = start.iterations;
    out.status = start.status;
    if (!start.ok()) {
      out.message = "no equilibrium at the start of the path: " + start.message;
      return;
    }
    keep(0, state, out);
    for (std::size_t k = 1; k < times_.size(); ++k) {
      if (!advance(times_[k - 1], times_[k], state, context, out)) return;
      keep(times_[k], state, out);
      if (context.progress) context.progress(times_[k], "motion");
    }
    out.message = out.snaps.empty() ? "solved" : "solved, with " + std::to_string(out.snaps.size()) + " snap-through" + (out.snaps.size() > 1 ? "s" : "");
  }

 private:
  bool advance(double from, double to, RodState& state, const RunContext& context, PackMotion& out) {
    for (const double there : stations(path_, from, to)) {
      const PackFollower::Outcome way = follower_.advance(state, path_.at(from), path_.at(there), context);
      out.iterations += way.iterations;
      for (const PackFollower::Snap& snap : way.snaps)
        out.snaps.push_back({from + snap.share * (there - from), snap.rod, snap.move, snap.energy_drop});
      out.status = way.status;
      if (!way.ok()) {
        out.message = "no equilibrium beyond t = " + number_text(from + way.reached * (there - from)) + ": " + way.message;
        return false;
      }
      from = there;
    }
    return true;
  }

  void keep(double t, const RodState& state, PackMotion& out) {
    PackStep step;
    step.t = t;
    step.q = path_.at(t);
    step.state = state;
    reporter_.report(step);
    out.steps.push_back(std::move(step));
  }

  const JointPath& path_;
  std::vector<double> times_;
  PackStatics statics_;
  PackReporter reporter_;
  PackFollower follower_;
};

void run_in_contact(const PackProblem& pack, const JointPath& path, const SimulationOptions& options, const RunContext& context,
                    PackMotion& out) {
  PackStatics statics(pack);
  const PackReporter reporter(statics);
  MotionOptions motion;
  motion.steps = options.steps;
  SolveOptions solve;
  solve.tolerance = options.tolerance;
  std::vector<Frame> poses;
  const ProblemPath placed = [&](double t, SystemProblem& system) {
    pack.poses(path.at(t), poses);
    pack.place(poses, system);
  };
  const Motion found = follow(pack.system_at(path.at(0)), placed, motion, solve, context);
  out.status = found.status;
  out.message = found.message;
  out.iterations = found.solves;
  for (const SnapThrough& snap : found.snaps) out.snaps.push_back({snap.t, snap.rod, snap.move, snap.energy_drop});
  for (const MotionStep& one : found.steps) {
    if (!one.equilibrium.ok()) continue;
    PackStep step;
    step.t = one.t;
    step.q = path.at(one.t);
    step.state = statics.state_of(one.equilibrium);
    reporter.report(one.equilibrium, step);
    out.steps.push_back(std::move(step));
  }
}

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
  if (pack.has_surroundings())
    run_in_contact(pack, path, options, context, out);
  else
    FreeMotion(pack, path, options).run(context, out);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
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
double PackMotion::smallest_clearance() const {
  return -largest_of(steps, [](const RodReport& rod) { return -rod.clearance; });
}

}  // namespace tendril::dress_pack
