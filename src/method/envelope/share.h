// Which outcomes an envelope of a share of them leaves out.
#pragma once

#include <vector>

#include "method/envelope/outcomes.h"

namespace tendril::envelope {

/// How unusual each outcome is: the largest, over all nodes and 32 directions, of |d . (p - mean)| / deviation. Nodes that
/// move less than a ten-thousandth of the thinnest rod's radius do not count.
std::vector<float> outcome_scores(const EnvelopeOutcomes& outcomes, const RunContext& context);

/// The ceil(share n) outcomes of lowest score, in increasing order; of equal scores the earlier ones.
std::vector<int> most_usual(const std::vector<float>& scores, double share);

}  // namespace tendril::envelope
