// From the equilibrium at one configuration of the robot to that at another, straight in the joint values, in steps as long as
// the rods follow smoothly.
#pragma once

#include <string>

#include "base/run_context.h"
#include "method/dress_pack/pack_statics.h"

namespace tendril::dress_pack {

struct FollowLimits {
  double largest_turn = 0.25;   ///< rad or m, of a joint in one motion
  double smallest_turn = 1e-4;  ///< rad or m
  double tolerance = 1e-9;      ///< see PackStatics::move()
  bool may_snap = true;         ///< false: a snap-through ends the way
};

/// Looks at every motion that a follower makes.
class MotionWatch {
 public:
  virtual ~MotionWatch() = default;
  /// clear: it may stay. too_far: something was met on the way, at a place that a shorter motion tells better. touches: here.
  enum class Verdict { clear, too_far, touches };
  /// From the state that was accepted last to this one at `q`.
  virtual Verdict judge(const RodState& state, const JointVector& q) = 0;
  /// What was judged last stays.
  virtual void accept() = 0;
};

class PackFollower {
 public:
  PackFollower(PackStatics& statics, const FollowLimits& limits) : statics_(statics), limits_(limits) {}

  struct Snap {
    double share = 0;                      ///< of the way, just after it
    int rod = 0;                           ///< that moved farthest
    double move = 0, energy_drop = 0;      ///< m, J
  };
  struct Outcome {
    Status status = Status::stalled;
    std::string message;                   ///< empty when solved
    int iterations = 0;                    ///< factorisations
    double reached = 0;                    ///< share of the way that `state` has come
    std::vector<Snap> snaps;
    bool touches = false;                  ///< the watch ended the way
    bool ok() const { return status == Status::solved; }
  };

  /// `state`: the equilibrium at `from`; becomes that at `to`, or at as much of the way as was reached.
  Outcome advance(RodState& state, const JointVector& from, const JointVector& to, const RunContext& context);

  /// Not owned; null: none.
  void set_watch(MotionWatch* watch) { watch_ = watch; }

  /// The equilibrium at `q` by the ordinary solver, from a first guess. Stalled with a message when there is none.
  Outcome start(RodState& state, const JointVector& q, const RunContext& context);

 private:
  bool settle(RodState& state, const JointVector& q, double share, const RunContext& context, Outcome& out);

  PackStatics& statics_;
  FollowLimits limits_;
  MotionWatch* watch_ = nullptr;
};

}  // namespace tendril::dress_pack
