// The certificate of a finished curve: its smallest gap over all true straights and arcs, by exact distances to triangles, and
// everything else that was demanded.
//
// The gap is measured at places along the curve; what lies between two of them is bounded by gap_search.h, and divided until
// that bound decides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::routing {

/// The smallest gap of a curve and where. Nothing below the limit: obstacle -1, and the value is the limit.
struct CurveGap {
  double value = 0;       ///< m, as Gap::value
  double s = 0;           ///< m, arc length
  Vec3 at = Vec3::Zero(), on = Vec3::Zero();
  int obstacle = -1;
};

/// Of what lies outside the free ends (m, arc length at either end); looked for below `limit` (m). It is measured at `at`, and
/// nowhere on the true curve is the gap smaller by more than `tolerance` (m), 0.1 mm where the centre line is inside a solid.
CurveGap smallest_gap(const FreeSpace& space, const PccPoints& curve, double free_ends, double limit, double tolerance = 1e-5);
CurveGap smallest_gap(const FreeSpace& space, const PccPoints& curve, double free_start, double free_finish, double limit, double tolerance);

/// The smallest distance between the object's surface and an obstacle's (m; the clearance demanded is not taken off), and that
/// obstacle's name; empty: nothing within `limit`.
struct CurveClearance {
  CurveGap gap;
  std::string to;
};
CurveClearance clearance_of(const FreeSpace& space, const PccPoints& curve, double free_start, double free_finish, double limit);

/// True: the gap is at least -tolerance everywhere outside the free ends, for certain. False: somewhere it is below -tolerance/2.
/// Cheaper than smallest_gap.
bool is_clear(const FreeSpace& space, const PccPoints& curve, double free_ends, double tolerance = 1e-5);

/// What the curve violates by more than `tolerance` (m; rad), the worst first by its share of what was demanded; empty: it is
/// feasible. Of gaps the worst of each straight and arc, one for each obstacle; as in is_clear() half the tolerance is the
/// least that counts. Within the free ends the centre line must still not pass through a surface or leave keep_in. Arcs that do
/// not fit between their neighbours are a straight that is too short: of such a curve no gap is looked for.
///
/// Throws UsageError for a curve or a demand that is not finite, without a radius for each vertex, or that does not begin and
/// end where the ends are.
std::vector<Violation> violations(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& curve,
                                  double tolerance = 1e-5);

/// "10.2 mm too near to 'engine' at 0.31 m".
std::string text_of(const Violation& violation, const FreeSpace& space);

}  // namespace tendril::routing
