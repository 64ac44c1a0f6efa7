// Names beside the lines of a chart, in place of a legend.
#pragma once

#include <vector>

#include "view/legend_corner.h"

namespace tendril {

/// Where a line's name stands: beside one of its points.
struct LinePlace {
  std::size_t point = 0;
  bool left = false;   ///< the name ends at the point, else it begins there
};

/// One place a trace (those without points: any). `widths`: of the names, in shares of the x axis; `height`: of a line of
/// text, in shares of the y axis. A name covers as little as can be of the lines, of the names before it and of what lies
/// outside the axes; of places that cover the same, the one nearest to the line's last point.
std::vector<LinePlace> line_labels(const std::vector<ChartTrace>& traces, const std::vector<double>& widths, double height);

}  // namespace tendril
