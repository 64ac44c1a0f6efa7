// The chart of a route's alternatives.
#pragma once

#include <string>

#include "method/route/options.h"
#include "view/chart.h"

namespace tendril {

/// Smallest clearance over length: each alternative that keeps all that is demanded, named by what clearance weighs against length,
/// and the line of those that no other one beats in both. Throws UsageError where none has a clearance to draw.
Chart front_chart(const route::Result& result, const std::string& title);

}  // namespace tendril
