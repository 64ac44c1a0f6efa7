// The smallest gap along a piece of a curve, certain for all that lies between the places looked at.
//
// Two places a and b of a straight at distances l apart, da and db from the surface: a surface point y is at least da from a
// and db from b, and by Stewart's theorem its distance from x = (1 - u) a + u b is
//
//   |y - x|^2 = (1 - u) |y - a|^2 + u |y - b|^2 - u (1 - u) l^2  >=  (1 - u) da^2 + u db^2 - u (1 - u) l^2,
//
// a parabola in u with its minimum in closed form. Next to a plane that runs along, l^2 / (8 d) is lost instead of the l / 2
// that the way travelled alone allows. An arc lies within its sagitta of its chord.
#pragma once

#include <limits>

#include "method/pcc/pcc_check.h"

namespace tendril::routing {

/// At least this far from the surface is every point between two places whose distances are `da` and `db` (m), `chord` apart; m.
double least_between(double da, double db, double chord);

/// Asks the field first and the trees where it does not decide. Not for several threads at once.
class GapSearch {
 public:
  /// Values below `limit` (m) are looked for. `loss`: m, what may be missed of them. `first`: the first value below is enough.
  GapSearch(const FreeSpace& space, double limit, double loss, bool first = false);

  /// Goes along a piece between two arc lengths of the curve (m). Only what beats best() is looked for.
  void along(const PccPiece& piece, double from, double to);

  /// Measures at the pieces' ends and between, at most `spacing` (m) apart: the lower best() is, the less is left to look for.
  void sample(const PccPiece& piece, double from, double to, double spacing);

  /// The smallest of all pieces; obstacle -1 and the limit where nothing is below it.
  const CurveGap& best() const { return best_; }
  void forget() { best_ = CurveGap{limit_}; }
  long queries() const { return queries_; }  ///< of the trees

 private:
  struct Place {
    double s = 0;
    Vec3 at = Vec3::Zero();
    double low = 0, high = 0;  ///< m, of the gap
    double reach = -std::numeric_limits<double>::infinity();  ///< m: measured, and found to be more when it is not below
  };
  Place place(const PccPiece& piece, double s) const;
  void measure(Place& place, double reach);
  void divide(const PccPiece& piece, Place& a, Place& b, int depth);
  bool clear(const Place& a, const Place& b, double chord, double sagitta, bool hoped) const;
  bool ended() const { return first_ && best_.obstacle >= 0; }
  double threshold() const;

  const FreeSpace& space_;
  double limit_, loss_;
  bool first_;
  double thickness_;  ///< m, at least so far is the centre line from a surface where the gap is 0
  CurveGap best_;
  long queries_ = 0;
};

}  // namespace tendril::routing
