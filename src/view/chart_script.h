// A chart as a gnuplot script with its data inline. Texts become quoted strings in which nothing is an order to
// gnuplot.
#pragma once

#include <string>

#include "view/chart.h"

namespace tendril {

struct ChartScript {
  std::string text;
  std::size_t drawn = 0, dropped = 0;  ///< points
};

/// `output`: the file that gnuplot writes; `svg`: its kind, else PNG.
ChartScript chart_script(const Chart& chart, const std::string& output, bool svg);

/// All charts of a sheet in one picture.
ChartScript sheet_script(const ChartSheet& sheet, const std::string& output, bool svg);

/// `text` in double quotes for gnuplot: quotes, backslashes, controls and the marks of enhanced text lose their
/// meaning.
std::string gnuplot_quoted(const std::string& text);

}  // namespace tendril
