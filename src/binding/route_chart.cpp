#include "binding/route_chart.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "binding/card.h"
#include "method/route/pareto_front.h"

namespace tendril {
namespace {

constexpr std::size_t most_names = 11;  // a chart holds twelve series, of which the front is one

void add_point(const route::Route& route, ChartSeries& series) {
  series.x.push_back(route.length() / units::mm);
  series.y.push_back(route.clearance() / units::mm);
}

}  // namespace

Chart front_chart(const route::Result& result, const std::string& title) {
  Chart chart;
  chart.title = title;
  chart.x_label = "length [mm]";
  chart.y_label = result.options.refine ? "smallest clearance in equilibrium [mm]" : "smallest clearance, nominal [mm]";
  chart.direct_labels = true;
  ChartSeries front{result.options.weights.size() > 1 ? "" : "route", {}, {}};
  for (const int i : route::pareto_front(result.routes))
    if (std::isfinite(result.routes[i].clearance())) add_point(result.routes[i], front);
  if (front.x.empty()) throw UsageError("routes:chart: no route keeps all that is demanded and has an obstacle near it: " + result.message);
  chart.series.push_back(front);
  for (std::size_t i = 0; i < result.routes.size() && i < most_names; ++i) {
    const route::Route& route = result.routes[i];
    if (!route.ok || !std::isfinite(route.clearance()) || result.options.weights.size() < 2) continue;
    ChartSeries series{"weight " + plain_number(route.weights.clearance / route.weights.length), {}, {}};
    add_point(route, series);
    chart.series.push_back(series);
  }
  if (result.options.space.clearance > 0) chart.references.push_back({ChartReference::Across::horizontal, result.options.space.clearance / units::mm, "demanded"});
  return chart;
}

}  // namespace tendril
