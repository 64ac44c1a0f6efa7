// The room between a settled rod and what it must keep clear of, all along it.
#pragma once

#include <utility>
#include <vector>

#include "method/route/local_refinement.h"
#include "method/route/signed_gap.h"
#include "statics/equilibrium.h"

namespace tendril::routing {

/// Arc lengths (m) between which clearance is demanded: those outside the free stretches at the ends and beside the clips.
std::vector<std::pair<double, double>> judged_stretches(const RodProblem& problem, const RefinementOptions& options);

/// A place of the rod and its room.
struct Room {
  double s = 0;        ///< m
  double value = 0;    ///< m, from the rod's surface to where the obstacle's clearance begins; negative: too near
  Vec3 normal = Vec3::Zero(), on = Vec3::Zero();
  int obstacle = -1;   ///< of the field
  bool lowest = false; ///< less room than at its neighbours, or at the end of a stretch
};

class GapProfile {
 public:
  /// `outside`: an equilibrium in front of all surfaces; it must outlive this. `limit` (m): more room than this is not looked at.
  GapProfile(const SignedGap& field, const Equilibrium& outside, double limit)
      : field_(&field), outside_(&outside), limit_(limit) {}

  /// At most two radii apart over every stretch, in order, and the lowest places between them to a hundredth of a millimetre.
  std::vector<Room> along(const Rod& rod, const Equilibrium& equilibrium,
                          const std::vector<std::pair<double, double>>& stretches) const;
  Room at(const Rod& rod, const Equilibrium& equilibrium, double s) const;

 private:
  Room lowest_between(const Rod& rod, const Equilibrium& equilibrium, double a, double b) const;

  const SignedGap* field_;
  const Equilibrium* outside_;
  double limit_;
};

}  // namespace tendril::routing
