#include "binding/assembly_chart.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace tendril {
namespace {

// Beyond this no bend and no gap is of interest; m.
constexpr double straight = 1, far = 1;

double strain_of(const SceneEquilibrium& state) {
  double strain = 0;
  for (const SolvedRod& rod : state.rods) strain = std::max(strain, rod.equilibrium.largest_strain());
  return 100 * strain;
}

double bend_radius_of(const SceneEquilibrium& state) {
  double radius = INFINITY;
  for (const SolvedRod& rod : state.rods) radius = std::min(radius, rod.equilibrium.smallest_bend_radius());
  return radius <= straight ? radius / units::mm : NAN;
}

double gap_of(const SceneEquilibrium& state) {
  double gap = INFINITY;
  for (const SolvedRod& rod : state.rods) gap = std::min(gap, state.clearance(rod).value);
  return gap <= far ? gap / units::mm : NAN;
}

/// A chart of one measure; without a finite value a line at 0 would lie, so there is none.
void add_measure(const assembly::Result& result, const std::string& name, double (*measure)(const SceneEquilibrium&), ChartSheet& sheet) {
  Chart chart;
  chart.x_label = "time [s]";
  chart.y_label = name;
  chart.markers = false;
  ChartSeries series;
  for (const assembly::KeyFrame& frame : result.play) {
    series.x.push_back(frame.t * result.duration);
    series.y.push_back(measure(*frame.equilibrium));
  }
  if (std::none_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); })) return;
  chart.series.push_back(std::move(series));
  sheet.charts.push_back(std::move(chart));
}

/// Hands against time, in steps.
void add_hands(const assembly::Result& result, ChartSheet& sheet) {
  if (result.manipulation.grips.empty()) return;
  Chart chart;
  chart.x_label = "time [s]";
  chart.y_label = "hands";
  chart.markers = false;
  ChartSeries series;
  double before = 0;
  int held = result.manipulation.hands(0);
  for (const double t : result.manipulation.times) {
    const int now = result.manipulation.hands(t);
    if (now != held) {
      series.x.push_back(before * result.duration);
      series.y.push_back(held);
    }
    series.x.push_back(t * result.duration);
    series.y.push_back(now);
    held = now;
    before = t;
  }
  chart.series.push_back(std::move(series));
  sheet.charts.push_back(std::move(chart));
}

}  // namespace

ChartSheet assembly_chart(const assembly::Result& result, const std::string& title) {
  if (result.play.empty()) throw UsageError("assembly:chart: no manipulation was proven: " + result.message);
  ChartSheet sheet;
  sheet.title = title;
  sheet.columns = 1;
  add_measure(result, "largest strain [%]", strain_of, sheet);
  add_measure(result, "smallest bend radius [mm]", bend_radius_of, sheet);
  if (!result.play.front().equilibrium->obstacles.empty()) add_measure(result, "smallest clearance [mm]", gap_of, sheet);
  add_hands(result, sheet);
  return sheet;
}

}  // namespace tendril
