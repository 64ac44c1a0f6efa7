// What a refined design is worth: its final equilibrium against everything that is demanded, exactly.
#pragma once

#include "method/route/local_refinement.h"
#include "method/route/surroundings_by_use.h"

namespace tendril::routing {

/// Fills lengths, bend radius, clearance and `unmet` from result.equilibrium.
void judge(const SurroundingsByUse& around, const RefinementOptions& options, RefinementResult& result);

/// "infeasible: 3.2 mm to 'engine' at 0.41 m, 8 required; ..."
std::string text_of(const std::vector<Unmet>& unmet);

}  // namespace tendril::routing
