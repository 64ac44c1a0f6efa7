// Step guards: no Newton step may carry a rod through a surface, however thin.
//
// Distances are unsigned for meshes, so a rod that has passed a sheet would settle happily behind it. The guards look at
// the motion that a step really makes (rotations included), not at its linearisation.
#pragma once

#include <vector>

#include "statics/contact_set.h"

namespace tendril {

/// A surface in the way of a point: the plane through the hit, facing the point.
struct Blockade {
  int point;
  Vec3 normal;
  double plane;  ///< normal . (place of the hit), m
};

/// The part of a step that may be taken.
struct GuardedStep {
  double share = 1;                 ///< 0 ... 1 of the step
  std::vector<Blockade> blockades;  ///< what made it smaller
};

class ContactGuard {
 public:
  /// `set` must outlive the guard.
  explicit ContactGuard(ContactSet& set) : set_(&set) {}

  /// Notes where the centre line already crosses a surface at the set's positions. Those places are not guarded against
  /// what they already do, but reported.
  void start();

  /// The largest admissible share (at most `most`) of a step from the shape that the set was last evaluated at.
  /// 1. A point that moves farther than its known distance casts a ray along its motion.
  /// 2. Between two points nearer to a surface than half their distance a ray looks for an edge that slips through.
  /// 3. After a hit the step is scaled so that at least half the radius, or half the height before the step when that
  ///    is less, stays above the plane of the hit.
  GuardedStep admit(const VertexShape& shape, std::span<const Vec6> step, double most = 1);

  /// To be called when the set stands at a new accepted shape: crossings that are gone are guarded from now on.
  void accept();

  /// Pairs of points (i, i + 1) between which the centre line crosses a surface at the set's positions.
  std::vector<int> crossings();

  long rays() const { return rays_; }

 private:
  double limit_by_points(const std::vector<Vec3>& moved, std::vector<Blockade>& blockades);
  bool slips_between(const std::vector<Vec3>& moved);
  bool crosses(int i, const std::vector<Vec3>& x);
  bool pair_counts(int i) const { return !set_->excluded(i) && !set_->excluded(i + 1); }

  ContactSet* set_;
  std::vector<char> crossed_;
  std::vector<Vec3> moved_;
  long rays_ = 0;
};

/// Pulls each blocked point, by a spring of `stiffness` (N/m) in the linear system, to half its radius above the plane:
/// what a step that the guards keep cutting short needs to go around instead of on.
void add_blockade_springs(const ContactSet& set, const VertexShape& shape, const std::vector<Blockade>& blockades,
                          double stiffness, BlockView system);

}  // namespace tendril
