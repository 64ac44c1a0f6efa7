// A dress pack on a robot that follows a path, from equilibrium to equilibrium (thesis 3.5: quasi-static motion).
//
// Each motion of the holds is answered by the first-order response of the rods and then corrected by Newton's method. On a smooth
// way the correction over the prediction falls with the step, at a snap-through it grows: a motion with a ratio above 0.1 is made
// in two halves. What cannot be made in the smallest steps is left to the ordinary solver, which runs down the energy from there:
// the rods have snapped through when that took them far.
//
// Bodies are watched by a bound on what has moved: far from them that is all. Where a rod comes to touch one, the ordinary solver
// with contact makes the steps (contact_follower.h), until it has come free; and all steps of a pack that slides through a hold.
// Not done: friction, contact between the rods of a pack.
#pragma once

#include <limits>
#include <string>

#include "base/run_context.h"
#include "method/dress_pack/pack_statics.h"

namespace tendril::dress_pack {

struct SimulationOptions {
  int steps = 40;              ///< reports, evenly spaced in time; via points are passed exactly in any case
  double largest_turn = 0.25;  ///< rad or m, of a joint in one motion
  double smallest_turn = 1e-4; ///< rad or m; what happens within it is a snap-through
  double tolerance = 1e-9;     ///< see SolveOptions
  bool robot_clearance = false; ///< also look how far the links' bodies are from the fixed ones
  int most_solutions = 5000;   ///< with contact or sliding; then the motion has stalled
};

/// What one attachment exerts on its rod, in world axes, the moment about the section's centre.
struct EndLoad {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m
};

struct RodReport {
  double tension = 0;      ///< N, the largest force along the rod; negative: compression everywhere
  double twist = 0;        ///< rad/m, the largest change against the unstressed rod, without sign
  double bend_radius = 0;  ///< m, the smallest
  double clearance = std::numeric_limits<double>::infinity();  ///< m, between the surfaces; infinite beyond 0.5 m; negative: overlap
  int body = -1;           ///< that is nearest; -1: none within reach
  std::vector<ContactForce> contacts = {};  ///< with the bodies' numbers
  double contact_force() const;             ///< N, the sizes of the contact forces added up
};

/// The link's body that is nearest to a fixed one.
struct RobotReport {
  double clearance = std::numeric_limits<double>::infinity();  ///< m; infinite beyond 0.5 m; 0 or less where they meet
  int link = -1, body = -1;                                    ///< the robot's link; the fixed body
};

struct PackStep {
  double t = 0;                ///< 0 ... 1
  JointVector q;
  std::vector<EndLoad> ends;   ///< by attachment
  std::vector<RodReport> rods;
  RobotReport robot;           ///< where SimulationOptions ask for it
  double residual = 0;         ///< N, largest unbalanced force, or moment over length
  RodState state;              ///< by node: PackStatics::describe() makes it an equilibrium
  std::shared_ptr<const SystemEquilibrium> solved;  ///< where rods touch or slide: the ordinary solver's answer, contact forces included
};

struct PackSnap {
  double t = 0;            ///< just after this time
  int rod = 0;             ///< that moved farthest
  double move = 0;         ///< by so much, m
  double energy_drop = 0;  ///< J
};

struct PackMotion {
  Status status = Status::stalled;
  std::string message;
  std::vector<PackStep> steps;   ///< those that were reached
  std::vector<PackSnap> snaps;
  int iterations = 0;            ///< factorisations
  int contact_solutions = 0;     ///< of the ordinary solver, with contact or sliding
  double seconds = 0;
  bool ok() const { return status == Status::solved; }

  double largest_end_force() const;    ///< N, over attachments and steps
  double largest_tension() const;      ///< N
  double largest_twist() const;        ///< rad/m
  double smallest_bend_radius() const; ///< m
  double smallest_clearance() const;   ///< m
  double smallest_robot_clearance() const; ///< m
};

/// Throws UsageError for a pack or options that make no sense. A path beyond the robot's limits is refused as infeasible, with the
/// reason; where the rods find no equilibrium the motion has stalled and ends with the last step that was reached.
PackMotion simulate(const PackProblem& pack, const JointPath& path, const SimulationOptions& options = {},
                    const RunContext& context = {});

}  // namespace tendril::dress_pack
