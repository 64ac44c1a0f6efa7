// Candidates that know nothing but the two ends: the shortest curves of straights and arcs of open space, among them what
// Dubins' words become in space (two arcs with a straight between, three arcs that touch).
#pragma once

#include <vector>

#include "method/preform/options.h"

namespace tendril::preform {

/// The best local optima without obstacles that differ by more than Options::same, the shortest first; at most `most`. They come
/// from descents from many starts. Arcs of more than 150 degrees are two bends.
std::vector<PccPoints> end_seeds(const Options& options, int most, const RunContext& context = {});

}  // namespace tendril::preform
