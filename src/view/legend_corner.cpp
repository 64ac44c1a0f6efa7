#include "view/legend_corner.h"

#include <limits>

namespace tendril {
namespace {

constexpr double legend_width = 0.42, row_height = 0.045;  // shares of the axes, with a margin
constexpr int steps_between = 16;

struct Corner {
  const char* name;
  bool right, top;
};

bool covered(const Corner& corner, double height, const std::array<double, 2>& p) {
  const double across = corner.right ? 1 - p[0] : p[0], down = corner.top ? 1 - p[1] : p[1];
  return across < legend_width && down < height;
}

int hidden(const Corner& corner, double height, const ChartTrace& trace, bool joined) {
  int count = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    count += steps_between * covered(corner, height, trace[i]);  // a point weighs as much as a piece of line
    if (!joined || i == 0) continue;
    for (int k = 1; k < steps_between; ++k) {
      const double t = double(k) / steps_between;
      count += covered(corner, height, {trace[i - 1][0] + t * (trace[i][0] - trace[i - 1][0]),
                                        trace[i - 1][1] + t * (trace[i][1] - trace[i - 1][1])});
    }
  }
  return count;
}

}  // namespace

const char* legend_corner(const std::vector<ChartTrace>& traces, int rows, bool joined) {
  constexpr std::array<Corner, 4> corners{{{"top right", true, true},
                                           {"top left", false, true},
                                           {"bottom right", true, false},
                                           {"bottom left", false, false}}};
  const double height = row_height * (rows + 0.5);
  const Corner* best = &corners[0];
  int least = std::numeric_limits<int>::max();
  for (const Corner& corner : corners) {
    int count = 0;
    for (const ChartTrace& trace : traces) count += hidden(corner, height, trace, joined);
    if (count < least) least = count, best = &corner;
  }
  return best->name;
}

}  // namespace tendril
