// Where in a chart the legend hides least.
#pragma once

#include <array>
#include <vector>

namespace tendril {

/// A line or cloud of points in units of the axes' lengths: 0 at the left and bottom, 1 at the right and top.
using ChartTrace = std::vector<std::array<double, 2>>;

/// "top right", "top left", "bottom right" or "bottom left": the first of these that a legend of `rows` rows covers the
/// least of the traces in. `joined`: the points are joined by lines, which count too.
const char* legend_corner(const std::vector<ChartTrace>& traces, int rows, bool joined);

}  // namespace tendril
