// One rod's statics problem, free of any scene, file or script.
#pragma once

#include <vector>

#include "base/frame.h"
#include "rod/rod.h"
#include "statics/contact_field.h"

namespace tendril {

/// A hold of the section at arc length `at` (m): position, orientation or both.
struct Hold {
  double at = 0;
  Frame frame;
  bool position = true;
  bool orientation = true;
  double turns = 0;  ///< extra full turns about the tangent relative to the start: a frame alone cannot tell 0 from 360 degrees
  /// The rod slips through without friction along d3: `at` is where the search begins, the arc length there an unknown.
  bool slide = false;
  /// Where a sliding section was when the rod was cut into segments: their number on both sides stays. Negative: at `at`.
  double cut_at = -1;
};

/// A dead load (constant in world axes) on the section at arc length `at`: force in N, moment in N m.
struct PointLoad {
  double at = 0;
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

/// Draws the section at arc length `at` to a pose: energy 1/2 position |r - frame.at|^2 + rotation (1 - cos phi), phi the angle
/// between the section's frame and the spring's.
struct PoseSpring {
  double at = 0;
  Frame frame;
  double position = 0;  ///< N/m
  double rotation = 0;  ///< N m
};

/// The rod element. staggered: the thesis's section 2.1.4, positions at vertices and rotations on segments, second
/// order. se3: frames at vertices, fourth order.
enum class Element { se3, staggered };

/// How the staggered element clamps an end. half_cell: a ghost frame at the very end (second order). thesis: the first
/// half-segment's rotation is fixed, equation (2.10b) (first order).
enum class ClampRule { half_cell, thesis };

/// A rod that is fastened to an obstacle lies near it there: within `reach` (m) of arc length from the hold the obstacle does not
/// act on the rod.
struct Fastening {
  int hold = 0;      ///< of the problem
  int obstacle = 0;  ///< of the surroundings
  double reach = 0;
};

struct RodProblem {
  Rod rod;
  std::vector<Hold> holds;       ///< any order; at most one for each place
  std::vector<PointLoad> loads;
  std::vector<PoseSpring> springs;  ///< they do not hold a rod: something else must keep it
  Vec3 gravity = Vec3::Zero();   ///< m/s^2; zero: the term is left out
  const ContactField* surroundings = nullptr;  ///< not owned; null: no contact term
  std::vector<Fastening> fastenings = {};      ///< without surroundings of no meaning

  /// Throws UsageError naming what cannot be: places outside the rod, contradictory holds, non-finite numbers, a weight
  /// that the rod's stretch stiffness cannot carry. `held_elsewhere`: false where nothing but its own holds keeps the rod.
  void check(bool held_elsewhere = false) const;
};

/// A section that belongs to a branch point.
struct JoinedSection {
  int rod = 0;      ///< which of the system's rods
  double at = 0;    ///< arc length, m
  Frame relative;   ///< the section's frame seen from the branch point's
};

/// A rigid point that sections of several rods share: they move and turn as one body.
struct BranchPoint {
  std::vector<JoinedSection> sections;
  Frame frame;               ///< where it is held; where it is free: only a hint for the first guess
  bool position = false;     ///< held
  bool orientation = false;  ///< held
};

/// Rods that are solved together.
struct SystemProblem {
  std::vector<RodProblem> rods;
  std::vector<BranchPoint> branches;

  /// Throws UsageError as RodProblem::check() does, and for branch points that join nothing, join a section that is held or
  /// joined elsewhere, or leave rods that nothing holds.
  void check() const;
};

/// What a clearance that an obstacle requires means to contact. judge: nothing, the rod may touch the surface. push: the
/// obstacle is felt at the clearance already. Near a held place the clearance grows from nothing along an arc of eight
/// radii, then at one in two, so that rods can be fastened to what they keep clear of.
enum class ClearanceRule { judge, push };

struct SolveOptions {
  Element element = Element::se3;
  ClampRule clamp = ClampRule::half_cell;
  double tolerance = 1e-9;   ///< largest last step: rotations in rad, positions relative to the length
  int max_iterations = 2000; ///< over all stages and fallbacks
  bool stable_only = true;   ///< leave saddles; false: take the equilibrium nearest to the start
  bool error = false;        ///< also estimate the discretisation error
  ClearanceRule clearance = ClearanceRule::judge;
  /// 0: surfaces are hard, as far as the method goes. Else obstacles give way by so many radii under the rods' own forces, and may
  /// overlap: far fewer passes, for motions that are looked at again with hard surfaces.
  double soft_contact = 0;
  bool follow = false;       ///< where a warm start does not lead on, run down the energy from it instead of starting anew
};

}  // namespace tendril
