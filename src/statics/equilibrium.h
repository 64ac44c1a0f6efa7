// The answer of statics for one rod.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frame.h"
#include "statics/problem.h"

namespace tendril {

/// J, by term. Dead point loads are in `load` (minus force times displacement from the world origin).
struct Energy {
  double bend = 0, twist = 0, stretch = 0, shear = 0, gravity = 0, contact = 0, load = 0, spring = 0;
  double total() const { return bend + twist + stretch + shear + gravity + contact + load + spring; }
};

/// A force that the surroundings exert on the rod.
struct ContactForce {
  double s;        ///< arc length, m
  Vec3 point;      ///< on the centre line, m
  Vec3 force;      ///< N, on the rod
  double gap;      ///< distance of the surfaces, m; negative: penetration
  int obstacle;
  double length = 0;  ///< m of the rod that it stands for
};

/// What a support exerts on the rod at a hold, in world axes, the moment about the centre-line point of the hold.
struct Reaction {
  double s = 0;
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m
};

/// Estimated discretisation error of the centre line.
struct ErrorEstimate {
  double value = 0;      ///< m, the largest distance of a vertex from the exact rod
  bool valid = false;    ///< false: the mesh is too coarse for the estimate to be trusted; see `why`
  double order = 0;      ///< observed order of convergence
  std::string why;
};

/// A rod in (or on its way to) static equilibrium. Arrays over vertices have segments + 1 entries, over segments one less.
struct Equilibrium {
  Status status = Status::stalled;
  std::string message;
  bool ok() const { return status == Status::solved; }

  double seconds = 0;
  int iterations = 0;        ///< factorisations
  double residual = 0;       ///< largest unbalanced force (N) or moment over length (N)
  std::vector<double> steps; ///< sizes of the steps that Newton's method asked for, one an iteration; as last_step
  double last_step = 0;      ///< rotations in rad, positions relative to the length
  /// No negative eigenvalue of the energy's second derivative. Dead moments have no energy: then of its symmetric part,
  /// which is sufficient, not necessary.
  bool stable = false;
  int negative_pivots = 0;
  int fallbacks = 0;         ///< 0: the first method solved it
  Energy energy;
  std::optional<ErrorEstimate> error;

  std::vector<double> s;             ///< vertices' arc lengths, m
  std::vector<Vec3> points;          ///< vertices, m
  std::vector<Quat> rotations;       ///< vertices' section orientations
  std::vector<Vec3> forces;          ///< per segment: internal force n in world axes, N (by [s,L] on [0,s])
  std::vector<Vec3> strains;         ///< per segment: Gamma - Gamma0 in the section frame
  std::vector<Vec3> curvatures;      ///< per segment: Omega in the section frame, 1/m
  std::vector<Vec3> curvature_changes;  ///< per segment: Omega - Omega0, 1/m
  std::vector<Vec3> moments;         ///< per segment: internal moment m at mid-segment, section frame, N m
  std::vector<Reaction> reactions;   ///< one per hold, in the problem's order, then one per branch point that it belongs to
  std::vector<ContactForce> contacts;
  double deepest_penetration = 0;    ///< m, 0 without contact; into the clearance where that pushes

  /// Points of the centre line at most `spacing` (m) apart, vertices included, with their arc lengths.
  struct Sample {
    double s;
    Frame frame;
  };
  std::vector<Sample> sampled(double spacing) const;

  /// The section's frame at an arc length (cubic between vertices).
  Frame frame_at(double arc_length) const;
  double contact_length() const;  ///< m of the rod that the surroundings press on

  double smallest_bend_radius() const;  ///< m; infinity for a straight rod
  double largest_tension() const;       ///< N, force along d3; negative: compression everywhere
  double largest_strain() const;        ///< largest |stretch| + radius * |curvature change|
  double settled_length() const;        ///< m, of the deformed centre line
  std::vector<double> radii;            ///< per segment: section radius, m
  std::vector<double> bend_radii() const;  ///< per vertex, m
};

/// Rods that were solved together. Status, message and counts are the same for all of them.
struct SystemEquilibrium {
  std::vector<Equilibrium> rods;          ///< in the problem's order
  std::vector<Frame> branches;            ///< where the branch points are
  std::vector<Reaction> branch_supports;  ///< what holds them, about their places; zero but for rounding where they are free

  bool ok() const { return !rods.empty() && rods.front().ok(); }
  /// Has shapes to start from.
  bool complete() const {
    for (const Equilibrium& rod : rods)
      if (rod.s.empty()) return false;
    return !rods.empty();
  }
  /// J, of all rods.
  double energy() const {
    double sum = 0;
    for (const Equilibrium& rod : rods) sum += rod.energy.total();
    return sum;
  }
};

}  // namespace tendril
