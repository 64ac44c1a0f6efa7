// What the rods of a dress pack bear over time, on the given path and on the optimised one.
#pragma once

#include <string>

#include "method/dress_pack/dress_pack.h"
#include "view/chart.h"

namespace tendril {

/// Force of the holds, twist, bend radius and clearance, those that a limit was set for or that are of interest anyway; each before
/// and after, with its limit.
ChartSheet dress_pack_chart(const dress_pack::Result& result, const std::string& title);

}  // namespace tendril
