#include "binding/dress_pack_chart.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/units.h"

namespace tendril {
namespace {

using dress_pack::PackMotion;
using dress_pack::PackStep;
using Measure = std::function<double(const PackStep&)>;

// Beyond this no bend and no gap is of interest; m.
constexpr double straight = 1, far = 1;

double force_of(const PackStep& step) {
  double most = 0;
  for (const auto& end : step.ends) most = std::max(most, end.force.norm());
  return most;
}

double twist_of(const PackStep& step) {
  double most = 0;
  for (const auto& rod : step.rods) most = std::max(most, rod.twist);
  return most / units::deg;
}

double bend_radius_of(const PackStep& step) {
  double least = INFINITY;
  for (const auto& rod : step.rods) least = std::min(least, rod.bend_radius);
  return least <= straight ? least / units::mm : NAN;
}

double clearance_of(const PackStep& step) {
  double least = INFINITY;
  for (const auto& rod : step.rods) least = std::min(least, rod.clearance);
  return least <= far ? least / units::mm : NAN;
}

ChartSeries series_of(const PackMotion& motion, const char* name, double duration, const Measure& measure) {
  ChartSeries series{name, {}, {}};
  for (const PackStep& step : motion.steps) {
    series.x.push_back(step.t * duration);
    series.y.push_back(measure(step));
  }
  return series;
}

bool has_value(const ChartSeries& series) {
  return std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); });
}

struct Measured {
  const char* label;
  Measure measure;
  double limit;  ///< in the label's unit; not finite: none
};

void add_measure(const dress_pack::Result& result, double duration, const Measured& measured, ChartSheet& sheet) {
  Chart chart;
  chart.x_label = duration == 1 ? "share of the path" : "time [s]";
  chart.y_label = measured.label;
  chart.markers = false;
  const bool changed = result.path.via() != result.given.via();
  for (const bool after : {false, true}) {
    if (after && !changed) continue;
    ChartSeries series = series_of(after ? result.after : result.before, after ? "optimised path" : "given path", duration, measured.measure);
    if (has_value(series)) chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) return;
  if (std::isfinite(measured.limit)) chart.references.push_back({ChartReference::Across::horizontal, measured.limit, "limit"});
  sheet.charts.push_back(std::move(chart));
}

}  // namespace

ChartSheet dress_pack_chart(const dress_pack::Result& result, const std::string& title) {
  if (result.before.steps.empty()) throw UsageError("dress_pack:chart: the rods did not even find an equilibrium at the start: " + result.message);
  const double duration = result.duration > 0 ? result.duration : 1;
  const dress_pack::Limits& limits = result.limits;
  const std::vector<Measured> all{
      {"largest force of a hold [N]", force_of, limits.max_tension},
      {"largest twist [deg/m]", twist_of, limits.max_twist / units::deg},
      {"smallest bend radius [mm]", bend_radius_of, limits.min_bend_radius > 0 ? limits.min_bend_radius / units::mm : NAN},
      {"smallest clearance [mm]", clearance_of, limits.clearance >= 0 ? limits.clearance / units::mm : NAN},
  };
  ChartSheet sheet;
  sheet.title = title;
  sheet.columns = 2;
  for (const Measured& measured : all) add_measure(result, duration, measured, sheet);
  return sheet;
}

}  // namespace tendril
