#include "binding/accuracy_chart.h"

#include <algorithm>
#include <cmath>

#include "binding/card.h"

namespace tendril {

std::string accuracy_table(const Accuracy& accuracy) {
  std::vector<std::string> head{"segments", "error", "order", "time", "iterations"};
  if (accuracy.solve.error) head.push_back("estimate");
  std::vector<std::vector<std::string>> rows;
  for (const AccuracyRow& row : accuracy.rows) {
    const bool solved = row.status == Status::solved;
    rows.push_back({std::to_string(row.segments), solved ? quantity(row.error, "m") : name_of(row.status),
                    std::isnan(row.order) ? "" : plain_number(std::round(row.order * 100) / 100), quantity(row.seconds, "s"),
                    std::to_string(row.iterations)});
    if (accuracy.solve.error) rows.back().push_back(std::isnan(row.estimate) ? "not valid" : quantity(row.estimate, "m"));
  }
  std::string text = "accuracy of element " + accuracy.element() + "\n" + table_text(head, rows);
  if (accuracy.status != Status::solved) return text + "\n" + name_of(accuracy.status) + ": " + accuracy.message;
  if (accuracy.reference_segments == 0) return text + "\nreference: exact";
  return text + "\nreference: " + std::to_string(accuracy.reference_segments) + " segments, known to " +
         quantity(accuracy.reference_uncertainty, "m") +
         (accuracy.unresolved() ? "; errors near or below that are not resolved" : "");
}

Chart accuracy_chart(const std::vector<Accuracy>& studies, const std::string& title) {
  Chart chart;
  chart.kind = ChartKind::lines;
  chart.title = title;
  chart.x_label = "run time [ms]";
  chart.y_label = "largest error of the centre line [m]";
  chart.log_x = chart.log_y = true;
  for (const Accuracy& study : studies) {
    ChartSeries series;
    series.name = study.element();
    if (!study.rows.empty())
      series.name += ", " + std::to_string(study.rows.front().segments) + " to " + std::to_string(study.rows.back().segments) + " segments";
    for (const AccuracyRow& row : study.rows) {
      series.x.push_back(1e3 * row.seconds);
      series.y.push_back(row.error);
    }
    chart.series.push_back(std::move(series));
  }
  double limit = 0;
  for (const Accuracy& study : studies)
    if (study.unresolved()) limit = std::max(limit, study.reference_uncertainty);
  if (limit > 0) chart.references.push_back({ChartReference::Across::horizontal, limit, "not resolved below"});
  check_chart(chart);
  return chart;
}

}  // namespace tendril
