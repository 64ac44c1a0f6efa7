// What sets each hose of a set apart for whoever has to choose.
#pragma once

#include <string>
#include <vector>

#include "method/preform/options.h"

namespace tendril::preform {

/// The hoses are ranked and have their passages. `blocking`: for each hose the numbers of the obstacles that stand between it and
/// the first one, the most frequent first; empty in the first one's passage.
///
/// The first is "shortest", or "best" where more than the length counts. Each other one says how much longer it is, its number of
/// bends where that differs, and the side: which obstacles it passes on the other side, or, where there is but one or it shares
/// its passage with an earlier hose, how far it runs from that hose and in which direction (of the world's axes) where they are
/// farthest apart: "+12 mm, 4 bends, 120 mm above hose 1 at (0.41, 0.52, 0.30)".
std::vector<std::string> labels_of(const FreeSpace& space, const std::vector<Hose>& hoses,
                                   const std::vector<std::vector<int>>& blocking);

}  // namespace tendril::preform
