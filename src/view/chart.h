// A chart as plain data, drawn by gnuplot as a process of its own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/run_context.h"

namespace tendril {

enum class ChartKind { lines, scatter, bars, histogram };

/// lines, scatter: points (x, y). bars: one y per category. histogram: the samples in y.
struct ChartSeries {
  std::string name;  ///< empty: not in the legend
  std::vector<double> x, y;
};

/// A dashed line across the chart.
struct ChartReference {
  enum class Across { horizontal, vertical };
  Across across = Across::horizontal;
  double at = 0;
  std::string label;
};

struct Chart {
  ChartKind kind = ChartKind::lines;
  std::string title;
  std::string x_label, y_label;         ///< with units: "segments", "error [m]"
  bool log_x = false, log_y = false;    ///< a log axis leaves out what is not positive
  bool markers = true;                  ///< lines: mark the points (up to 200 a series)
  bool direct_labels = false;           ///< lines and points: names beside them in their colours, no legend
  std::vector<ChartSeries> series;      ///< 1 to 12
  std::vector<std::string> categories;  ///< bars: names below the bars; empty: 1, 2, ...
  std::vector<ChartReference> references;
  int bins = 0;                    ///< histogram: 0 chooses by Freedman and Diaconis
  int width = 1200, height = 800;  ///< pixels
};

/// Charts side by side, row by row.
struct ChartSheet {
  std::string title;
  std::vector<Chart> charts;  ///< 1 to 40; their own sizes are not used
  int columns = 0;            ///< 0: as many as rows, or one more
  int width = 1600, height = 1200;  ///< pixels, of the whole
};

struct ChartReport {
  Status status = Status::solved;  ///< solved, cancelled or timeout; the file is written only when solved
  double seconds = 0;
  std::size_t drawn = 0;    ///< points
  std::size_t dropped = 0;  ///< points that are NaN, infinite or not positive on a log axis
};

/// Throws UsageError for a chart that cannot be drawn: no series, no finite point, arrays of different lengths, absurd
/// size.
void check_chart(const Chart& chart);
/// The same for each chart of a sheet, and for a sheet without charts or with more than 40.
void check_sheet(const ChartSheet& sheet);

/// Writes a .png or .svg, whole or not at all; a missing folder is created. Throws UsageError for another extension,
/// for what check_chart refuses, when gnuplot is missing (package gnuplot-nox) or fails, and when the file cannot be
/// written.
ChartReport save_chart(const Chart& chart, const std::string& path, const RunContext& context = {});
ChartReport save_sheet(const ChartSheet& sheet, const std::string& path, const RunContext& context = {});

}  // namespace tendril
