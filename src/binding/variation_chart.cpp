#include "binding/variation_chart.h"

#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"

namespace tendril {
namespace {

/// Where a column stands: of the variables, or behind them of the measures.
struct Place {
  const variation::Column* column;
  bool is_measure;
  int index;
};

Place place_of(const variation::Result& result, const std::string& name) {
  std::vector<std::string> names;
  for (const bool is_measure : {false, true}) {
    const auto& columns = is_measure ? result.outcomes.measures() : result.outcomes.variables();
    for (int k = 0; k < static_cast<int>(columns.size()); ++k) {
      if (columns[k].name == name) return {&columns[k], is_measure, k};
      names.push_back(columns[k].name);
    }
  }
  throw UsageError("variation: unknown " + unknown_name(name, "columns", names));
}

/// Lengths are drawn in mm, angles in degrees.
struct Scale {
  double factor;
  std::string unit;
};

Scale scale_of(const std::string& unit) {
  if (unit == "m") return {1e3, "mm"};
  if (unit == "rad") return {180 / 3.14159265358979323846, "deg"};
  return {1, unit};
}

std::string label_of(const variation::Column& column) {
  const std::string unit = scale_of(column.unit).unit;
  return column.name + (unit.empty() ? "" : " [" + unit + "]");
}

std::vector<double> scaled_column(const variation::Result& result, const std::string& name) {
  std::vector<double> values = column_of(result, name);
  const double factor = scale_of(place_of(result, name).column->unit).factor;
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace

std::vector<double> column_of(const variation::Result& result, const std::string& name) {
  const Place place = place_of(result, name);
  std::vector<double> values;
  for (int k = result.outcomes.first(); k < result.outcomes.last(); ++k) {
    const auto row = place.is_measure ? result.outcomes.measures_of(k) : result.outcomes.variables_of(k);
    const bool known = place.is_measure ? result.outcomes.has_measures(k) : result.outcomes.status(k) != variation::OutcomeStatus::unsolved;
    values.push_back(known ? row[place.index] : std::nan(""));
  }
  return values;
}

Chart histogram_of(const variation::Result& result, int measure, const std::string& title, std::optional<double> limit) {
  const variation::Column& column = result.outcomes.measures()[measure];
  const double factor = scale_of(column.unit).factor;
  Chart chart;
  chart.kind = ChartKind::histogram;
  chart.title = title.empty() ? column.name + ", " + std::to_string(result.outcomes.size()) + " outcomes" : title;
  chart.x_label = label_of(column);
  chart.y_label = "outcomes";
  chart.series = {{"", {}, scaled_column(result, column.name)}};
  if (std::isfinite(column.nominal)) chart.references.push_back({ChartReference::Across::vertical, column.nominal * factor, "nominal"});
  if (limit) chart.references.push_back({ChartReference::Across::vertical, *limit * factor, "limit"});
  return chart;
}

Chart scatter_of(const variation::Result& result, int measure, const std::string& over) {
  const variation::Column& column = result.outcomes.measures()[measure];
  const Place across = place_of(result, over);
  Chart chart;
  chart.kind = ChartKind::scatter;
  chart.title = column.name + " over " + over;
  chart.x_label = label_of(*across.column);
  chart.y_label = label_of(column);
  chart.series = {{"", scaled_column(result, over), scaled_column(result, column.name)}};
  return chart;
}

}  // namespace tendril
