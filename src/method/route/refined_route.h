// Step 2 of routing: a nominal route refined in static equilibrium.
#pragma once

#include "method/route/nominal_step.h"

namespace tendril::route {

/// Where refinement fails: once more from a route with something in reserve, then with a revised weight of clearance, at last with
/// clips. `count`: its equilibria and restarts grow; `nominal_count`: what the restarts' nominal routes cost.
Route refined(const Search& search, Route route, MethodStep& count, MethodStep& nominal_count);

}  // namespace tendril::route
