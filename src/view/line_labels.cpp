#include "view/line_labels.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr int steps_between = 24;
constexpr double gap = 0.012;            // between a point and its name, share of the x axis
constexpr double cost_of_a_name = 200;   // covering another name altogether, in covered places of a line
constexpr double cost_outside = 1000;

struct Box {
  double left, right, bottom, top;

  bool holds(const std::array<double, 2>& p) const {
    return p[0] > left && p[0] < right && p[1] > bottom && p[1] < top;
  }
  double shared_with(const Box& other) const {
    const double across = std::min(right, other.right) - std::max(left, other.left);
    const double up = std::min(top, other.top) - std::max(bottom, other.bottom);
    return std::max(across, 0.0) * std::max(up, 0.0) / ((right - left) * (top - bottom));
  }
};

Box box_of(const std::array<double, 2>& point, bool left, double width, double height) {
  const double edge = left ? point[0] - gap : point[0] + gap;
  return {left ? edge - width : edge, left ? edge : edge + width, point[1] - 0.5 * height, point[1] + 0.5 * height};
}

/// All lines as places close to each other.
ChartTrace dense(const std::vector<ChartTrace>& traces) {
  ChartTrace places;
  for (const ChartTrace& trace : traces)
    for (std::size_t i = 0; i < trace.size(); ++i) {
      places.push_back(trace[i]);
      for (int k = 1; i > 0 && k < steps_between; ++k) {
        const double t = double(k) / steps_between;
        places.push_back({trace[i - 1][0] + t * (trace[i][0] - trace[i - 1][0]),
                          trace[i - 1][1] + t * (trace[i][1] - trace[i - 1][1])});
      }
    }
  return places;
}

double cost(const Box& box, const ChartTrace& lines, const std::vector<Box>& names) {
  double sum = cost_outside * (std::max(0.0, -box.left) + std::max(0.0, box.right - 1) + std::max(0.0, -box.bottom) +
                               std::max(0.0, box.top - 1));
  for (const auto& place : lines) sum += box.holds(place);
  for (const Box& name : names) sum += cost_of_a_name * box.shared_with(name);
  return sum;
}

}  // namespace

std::vector<LinePlace> line_labels(const std::vector<ChartTrace>& traces, const std::vector<double>& widths, double height) {
  const ChartTrace lines = dense(traces);
  std::vector<LinePlace> places(traces.size());
  std::vector<Box> names;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    double least = INFINITY;
    Box best{};
    for (std::size_t back = 0; back < traces[i].size(); ++back)
      for (const bool left : {false, true}) {
        const std::size_t point = traces[i].size() - 1 - back;
        const Box box = box_of(traces[i][point], left, widths[i], height);
        const double here = cost(box, lines, names) + 0.01 * static_cast<double>(back);
        if (here < least) least = here, best = box, places[i] = {point, left};
      }
    if (!traces[i].empty() && widths[i] > 0) names.push_back(best);
  }
  return places;
}

}  // namespace tendril
