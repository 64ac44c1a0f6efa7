// The certificate of a finished curve: its smallest gap over all true straights and arcs, by exact distances to triangles, and
// everything else that was demanded.
//
// The gap changes by at most the way travelled: a piece whose ends and middle are known is clear where the gap exceeds what
// its half length can take off; else it is divided. Straights and arcs are divided down to 10 um of the gap.
#pragma once

#include <optional>
#include <vector>

#include "base/run_context.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::routing {

/// The smallest gap of a curve and where: exact to `tolerance` (m). Beyond `limit` (m): nothing is known but that.
struct CurveGap {
  double value = 0;       ///< m, as Gap::value
  double s = 0;           ///< m, arc length
  Vec3 at = Vec3::Zero(), on = Vec3::Zero();
  int obstacle = -1;
};
CurveGap smallest_gap(const FreeSpace& space, const PccPoints& curve, double free_ends, double limit, double tolerance = 1e-5);

/// True when the gap is at least -tolerance everywhere outside the free ends: cheaper than smallest_gap.
bool is_clear(const FreeSpace& space, const PccPoints& curve, double free_ends, double tolerance = 1e-5);

/// What the curve violates by more than `tolerance` (m; rad), the worst first by its share of what was demanded; empty: it is
/// feasible. Within the free ends the centre line must still not pass through a surface.
std::vector<Violation> violations(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& curve,
                                  double tolerance = 1e-5);

/// "10.2 mm too near to 'engine' at 0.31 m".
std::string text_of(const Violation& violation, const FreeSpace& space);

}  // namespace tendril::routing
