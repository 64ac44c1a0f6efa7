// Whether an equilibrium that was found without obstacles is one among them too.
#pragma once

#include <vector>

#include "statics/contact_field.h"
#include "statics/equilibrium.h"
#include "statics/problem.h"

namespace tendril::variation {

/// Knows how far the nominal rods are from everything: an outcome whose rods moved less than that touches nothing, and neither
/// did the way there. Others are measured.
class ClearWay {
 public:
  /// The nominal equilibrium; `field` must outlive this.
  ClearWay(const SystemProblem& problem, const std::vector<Equilibrium>& nominal, const ContactField& field);

  /// Nothing touches in the nominal equilibrium itself.
  bool nominal_is_clear() const { return clear_; }

  /// True when the rod is clear of all obstacles, and so are the straight ways of its points from where they are nominally.
  bool clear(int rod, const Rod& design, const Equilibrium& outcome) const;

 private:
  /// One point of the centre line, at a share of a rod's length.
  struct Point {
    double share;
    Vec3 at;
    double free;   ///< m, how far it can move before the rod about it, up to half way to its neighbours, can touch anything
  };
  bool rod_is_clear(const Rod& design, const Equilibrium& rod) const;

  const ContactField& field_;
  std::vector<std::vector<Point>> points_;  ///< by rod
  std::vector<double> reach_;               ///< m, largest radius plus half the points' distance, with a margin
  bool clear_ = true;
};

}  // namespace tendril::variation
