// Whether two hoses take the same passage (step 4 of thesis 3.2), by a free-space diagram as for the Frechet distance.
//
// A rung is the straight between a place of one curve and a place of the other. Both curves are walked from start to finish,
// each at its own pace and never back: where every rung on the way is free, one curve can be moved into the other along the
// rungs. Rungs are looked at so close together that what lies between two of them is free as well, at half the distance that
// is kept clear: the middle lines met on the way pass through no surface.
#pragma once

#include <vector>

#include "method/pcc/curve_distance.h"
#include "method/preform/options.h"

namespace tendril::preform {

using routing::places_along;

/// True: certain, for what lies outside the free ends (m, arc length at either end). False: no such matching was found;
/// `blocking`, if given, gets the numbers of the obstacles that stand between places at equal shares of the lengths, the most
/// frequent first.
bool same_passage(const FreeSpace& space, const PccPoints& a, const PccPoints& b, double free_ends = 0,
                  std::vector<int>* blocking = nullptr);

}  // namespace tendril::preform
