// The alternatives of a route that no other one beats in both length and clearance.
#pragma once

#include <vector>

#include "method/route/options.h"

namespace tendril::route {

/// Numbers in `routes`, from 0, by rising length and so by rising clearance: those that keep all that is demanded and of which no
/// other that does is at most as long and at least as far from everything, and better in one of both. Of equal ones the first.
std::vector<int> pareto_front(const std::vector<Route>& routes);

}  // namespace tendril::route
