#include "method/dress_pack/pack_follower.h"

#include <algorithm>
#include <cmath>

#include "statics/solve.h"

namespace tendril::dress_pack {
namespace {

constexpr double smooth_ratio = 0.1;     // corrector over predictor motion
constexpr double least_prediction = 1e-6;  // rad: predictions below it say nothing about the ratio
constexpr double snap_move = 5e-3;       // of the length, within the smallest step: more is a snap-through
constexpr double growth = 1.6;
constexpr int most_widenings = 4;

SolveOptions following() {
  SolveOptions options;
  options.follow = true;
  return options;
}

PackFollower::Outcome touching(PackFollower::Outcome& out) {
  out.status = Status::stalled;
  out.touches = true;
  out.message = "a rod touches a body";
  return std::move(out);
}

}  // namespace

PackFollower::Outcome PackFollower::start(RodState& state, const JointVector& q, const RunContext& context) {
  Outcome out;
  SystemProblem system = statics_.pack().system_at(q);
  system.check();
  const SystemEquilibrium found = solve(system, {}, context);
  out.status = found.rods.front().status;
  out.iterations = found.rods.front().iterations;
  if (!found.ok()) {
    out.message = found.rods.front().message;
    return out;
  }
  state = statics_.state_of(found);
  // The ordinary solver may have ended with another element; this one's equilibrium is a few steps away.
  const PackStatics::Moved moved = statics_.move(state, statics_.pack().poses(q), limits_.tolerance);
  out.iterations += moved.iterations;
  if (!moved.ok) {
    out.status = Status::stalled;
    out.message = "the rods are not stable, or their segments are too long for the tension in them; give them more segments";
  }
  return out;
}

PackFollower::Outcome PackFollower::advance(RodState& state, const JointVector& from, const JointVector& to, const RunContext& context) {
  Outcome out;
  const double way = from.size() ? (to - from).cwiseAbs().maxCoeff() : 0;
  const double longest = way > limits_.largest_turn ? limits_.largest_turn / way : 1;
  double step = 1 / std::ceil(1 / longest - 1e-9);
  const double full = step;
  std::vector<Frame> poses;
  while (out.reached < 1) {
    if (const auto stop = context.stop()) {
      out.status = *stop;
      out.message = "interrupted";
      return out;
    }
    const double next = out.reached + step > 1 - 1e-9 ? 1 : out.reached + step;
    const JointVector q = next == 1 ? to : JointVector(from + next * (to - from));
    statics_.pack().poses(q, poses);
    RodState trial = state;
    const PackStatics::Moved moved = statics_.move(trial, poses, limits_.tolerance);
    out.iterations += moved.iterations;
    const bool smallest = (next - out.reached) * way <= limits_.smallest_turn;
    if (moved.ok && moved.corrected <= smooth_ratio * std::max(moved.predicted, least_prediction)) {
      const MotionWatch::Verdict verdict = watch_ ? watch_->judge(trial, q) : MotionWatch::Verdict::clear;
      if (verdict == MotionWatch::Verdict::too_far && !smallest) {
        step = 0.5 * (next - out.reached);
        continue;
      }
      if (verdict != MotionWatch::Verdict::clear) return touching(out);
      if (watch_) watch_->accept();
      state = std::move(trial);
      out.reached = next;
      step = std::min(growth * step, full);
      continue;
    }
    if (!smallest) {
      step = 0.5 * (next - out.reached);
      continue;
    }
    // At the very turning point the energy is flat and its minimum hard to find; a little farther on it is not.
    const RodState before = state;
    const std::size_t snaps = out.snaps.size();
    double there = next;
    int wider = 0;
    bool settled = settle(state, q, there, context, out);
    for (double past = next - out.reached; !settled && wider < most_widenings && there < 1 && out.status == Status::stalled; ++wider) {
      past *= 4;
      there = std::min(1.0, out.reached + past);
      settled = settle(state, there == 1 ? to : JointVector(from + there * (to - from)), there, context, out);
    }
    if (!settled) return out;
    if (watch_ && watch_->judge(state, there == 1 ? to : JointVector(from + there * (to - from))) != MotionWatch::Verdict::clear) {
      state = before;  // it would have fallen through what is in its way
      out.snaps.resize(snaps);
      return touching(out);
    }
    if (watch_) watch_->accept();
    out.message.clear();
    out.reached = there;
  }
  out.status = Status::solved;
  return out;
}

/// What no small step makes smoothly: down the energy from here.
bool PackFollower::settle(RodState& state, const JointVector& q, double share, const RunContext& context, Outcome& out) {
  const SystemEquilibrium before = statics_.describe(state);
  SystemProblem system = statics_.pack().system_at(q);
  const SystemEquilibrium found = solve(system, following(), context, &before);
  out.iterations += found.rods.front().iterations;
  out.status = found.rods.front().status;
  if (!found.ok()) {
    out.message = found.rods.front().message;
    return false;
  }
  RodState there = statics_.state_of(found);
  const PackStatics::Moved moved = statics_.move(there, statics_.pack().poses(q), limits_.tolerance);
  out.iterations += moved.iterations;
  out.status = Status::stalled;
  if (!moved.ok) {
    out.message = "the rods find no stable equilibrium; their segments may be too long for the tension in them";
    return false;
  }
  Snap snap{share};
  double most = 0;
  for (int k = 0; k < statics_.network().rods(); ++k) {
    const int first = statics_.network().first_node(k);
    for (int i = first; i < first + statics_.network().rod(k).nodes(); ++i) {
      const double move = (there.r[i] - state.r[i]).norm();
      if (move > snap.move) snap.rod = k, snap.move = move;
      most = std::max(most, move / statics_.network().rod(k).length());
    }
  }
  if (most > snap_move) {
    if (!limits_.may_snap) {
      out.message = "a rod snaps through";
      return false;
    }
    snap.energy_drop = before.energy() - statics_.describe(there).energy();
    out.snaps.push_back(snap);
  }
  state = std::move(there);
  return true;
}

}  // namespace tendril::dress_pack
