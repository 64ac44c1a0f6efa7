#include "view/chart_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "view/colour_map.h"
#include "view/histogram.h"
#include "view/legend_corner.h"
#include "view/line_labels.h"

namespace tendril {
namespace {

std::string hex(std::size_t category) {
  const Rgb colour = category_colour(category);
  char text[8];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", int(std::lround(255 * colour.r)), int(std::lround(255 * colour.g)),
                int(std::lround(255 * colour.b)));
  return text;
}

constexpr std::size_t most_marked = 200;
constexpr int smallest_on_sheet = 13;  // pixels of a letter

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// What is left of the data, and what it spans.
struct Drawable {
  struct Series {
    std::string name;
    std::vector<std::array<double, 2>> points;
  };
  std::vector<Series> series;
  std::size_t dropped = 0;
  int letter = 0;  ///< pixels of the chart's letters
};

Drawable drawable_of(const Chart& chart) {
  Drawable result;
  for (const ChartSeries& series : chart.series) {
    Drawable::Series kept{series.name, {}};
    const bool indexed = chart.kind == ChartKind::bars || chart.kind == ChartKind::histogram;
    for (std::size_t i = 0; i < series.y.size(); ++i) {
      const double x = indexed ? static_cast<double>(i) : series.x[i], y = series.y[i];
      const bool log_x = chart.log_x && !indexed, log_y = chart.log_y && chart.kind != ChartKind::histogram;
      const bool log_sample = chart.log_x && chart.kind == ChartKind::histogram;
      if (!std::isfinite(x) || !std::isfinite(y) || (log_x && x <= 0) || (log_y && y <= 0) || (log_sample && y <= 0))
        ++result.dropped;
      else kept.points.push_back({x, y});
    }
    result.series.push_back(std::move(kept));
  }
  return result;
}

/// Pixels of the letters.
int font_size(int width, int height) {
  return std::max(6, static_cast<int>(std::lround(18 * std::min(width / 1200.0, height / 800.0))));
}

void add_terminal(int width, int height, int font, const std::string& output, bool svg, std::string& text) {
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  text += svg ? "set terminal svg noenhanced size " + size + " background rgb '#ffffff' font 'DejaVu Sans," +
                    std::to_string(font) + "'\n"
              : "set terminal pngcairo noenhanced size " + size + " background rgb '#ffffff' font 'DejaVu Sans," +
                    std::to_string(std::max(5, font * 3 / 4)) + "'\n";
  text += "set output " + gnuplot_quoted(output) + "\nset encoding utf8\n";
}

void add_look(const Chart& chart, int font, bool svg, std::string& text) {
  text +=
      "set border 3 lc rgb '#404040' lw 1.2\nset tics nomirror out scale 0.6 textcolor rgb "
      "'#303030'\n"
      "set grid back lc rgb '#dcdcdc' lw 0.8 lt 1\nset rmargin 3\nset key top right reverse Left samplen 2.2 spacing "
      "1.25 textcolor rgb '#303030'\n";
  if (!chart.title.empty())
    text += "set title " + gnuplot_quoted(chart.title) + " font 'DejaVu Sans" + (svg ? "," : ":Bold,") +
            std::to_string(font) + "' textcolor rgb '#202020'\n";
  text += "set xlabel " + gnuplot_quoted(chart.x_label) + "\nset ylabel " + gnuplot_quoted(chart.y_label) + "\n";
  if (chart.log_x && chart.kind != ChartKind::bars) text += "set logscale x 10\n";
  if (chart.log_y) text += "set logscale y 10\n";
  if (chart.log_x || chart.log_y)
    text += "set grid mxtics mytics lc rgb '#dcdcdc' lw 0.8 lt 1, lc rgb '#eeeeee' lw 0.6 lt 1\n";
}

/// Numbers along a short log axis, from 10^a to 10^b: 1, 2 and 5 times the powers of ten.
std::string short_log_tics(const char* axis, double a, double b) {
  std::string tics;
  for (int power = static_cast<int>(std::floor(a)); power <= static_cast<int>(std::ceil(b)); ++power)
    for (int digit : {1, 2, 5}) {
      const double exponent = power + std::log10(digit);
      if (exponent < a || exponent > b) continue;
      char label[32];
      std::snprintf(label, sizeof label, "%g", digit * std::pow(10, power));
      tics += (tics.empty() ? "\"" : ", \"") + std::string(label) + "\" " + number(digit * std::pow(10, power));
    }
  return std::string("set ") + axis + "tics (" + tics + ")\n";
}

/// One axis' range with a little to spare; on a log axis at least most of a decade.
std::string range_text(const char* axis, double low, double high, bool log, bool from_zero) {
  if (log) {
    double a = std::log10(low), b = std::log10(high);
    const double spare = std::max(0.06 * (b - a), 0.15);
    a = std::max(a - spare, -307.0), b = std::min(b + spare, 307.0);
    std::string powers;
    if (b - a < 2) powers = short_log_tics(axis, a, b);
    else if (a < -3.5 || b > 5.5) powers = std::string("set format ") + axis + " '1e%L'\n";  // not 0.000000010
    return powers + "set " + axis + "range [" + number(std::pow(10, a)) + ":" + number(std::pow(10, b)) + "]\n";
  }
  const double size = std::max(std::abs(low), std::abs(high));
  double spare = 0.05 * high - 0.05 * low;
  if (!(spare > 1e-12 * size)) spare = size > 0 ? 0.1 * size : 1;
  const double limit = 1.6e308;
  double from = from_zero && low >= 0 ? 0 : std::max(low - spare, -limit),
         to = from_zero && high <= 0 ? 0 : std::min(high + spare, limit);
  if (!(from < to)) from -= 1, to += 1;
  return std::string("set ") + axis + "range [" + number(from) + ":" + number(to) + "]\n";
}

struct Span {
  double low = INFINITY, high = -INFINITY;
  void take(double v) { low = std::min(low, v), high = std::max(high, v); }
};

void add_references(const Chart& chart, std::string& text) {
  int tag = 1;
  const bool named = chart.direct_labels;  // names beside the points: of lines that rise they are on the left where it is low
  for (const ChartReference& line : chart.references) {
    const bool level = line.across == ChartReference::Across::horizontal;
    if (line.at <= 0 && (level ? chart.log_y : chart.log_x)) continue;
    const std::string at = number(line.at);
    const std::string from = level ? "graph 0, first " + at : "first " + at + ", graph 0";
    const std::string to = level ? "graph 1, first " + at : "first " + at + ", graph 1";
    text += "set arrow " + std::to_string(tag) + " from " + from + " to " + to +
            " nohead front lw 1.6 dt 2 lc rgb '#a02020'\n";
    if (!line.label.empty())
      text += "set label " + std::to_string(tag) + " " + gnuplot_quoted(line.label) + " at " +
              (!level ? "first " + at + ", graph 0.97" : (named ? "graph 0.988, first " : "graph 0.012, first ") + at) +
              (!level ? " left offset 0.6,0" : named ? " right offset 0,0.55" : " left offset 0,0.55") + " front textcolor rgb '#a02020'\n";
    ++tag;
  }
}

void add_plot(const std::vector<std::string>& parts, std::string& text) {
  text += "plot ";
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i ? ", \\\n  " : "") + parts[i];
  text += "\n";
}

constexpr double letter_width = 0.62, line_height = 1.35;  // shares of a letter's size
constexpr double axes_width = 0.86, axes_height = 0.8;     // shares of the chart that lie within the axes

/// Names beside the lines, tagged behind those of the reference lines.
void add_line_labels(const Drawable& data, const std::vector<ChartTrace>& traces, const Chart& chart, std::string& text) {
  const double letter = data.letter;
  std::vector<double> widths;
  for (const Drawable::Series& series : data.series)
    widths.push_back(letter_width * letter * static_cast<double>(series.name.size()) / (axes_width * chart.width));
  const std::vector<LinePlace> places = line_labels(traces, widths, line_height * letter / (axes_height * chart.height));
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    const Drawable::Series& series = data.series[i];
    if (series.points.empty() || series.name.empty()) continue;
    const auto& point = series.points[places[i].point];
    text += "set label " + std::to_string(1001 + i) + " " + gnuplot_quoted(series.name) + " at first " + number(point[0]) +
            ", first " + number(point[1]) + (places[i].left ? " right offset -0.8,0" : " left offset 0.8,0") +
            " front textcolor rgb '" + hex(i) + "'\n";
  }
  text += "set key off\n";
}

/// Moves the legend of lines and points to where it hides least.
void add_legend(const Chart& chart, const Drawable& data, const Span& x, const Span& y, std::string& text) {
  const auto share = [](const Span& span, bool log, double v) {
    const double low = log ? std::log10(span.low) : span.low, high = log ? std::log10(span.high) : span.high;
    return high > low ? 0.05 + 0.9 * ((log ? std::log10(v) : v) - low) / (high - low) : 0.5;  // the axes' spare room
  };
  std::vector<ChartTrace> traces;
  int rows = 0;
  for (const Drawable::Series& series : data.series) {
    ChartTrace trace;
    for (const auto& p : series.points) trace.push_back({share(x, chart.log_x, p[0]), share(y, chart.log_y, p[1])});
    traces.push_back(std::move(trace));
    rows += !series.points.empty() && !series.name.empty();
  }
  if (chart.direct_labels) {
    add_line_labels(data, traces, chart, text);
    return;
  }
  text += std::string("set key ") + legend_corner(traces, rows, chart.kind == ChartKind::lines) + "\n";
}

std::string title_of(const std::string& name) { return name.empty() ? "notitle" : "title " + gnuplot_quoted(name); }

void add_points(const Chart& chart, const Drawable& data, std::string& text) {
  Span x, y;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    const Drawable::Series& series = data.series[i];
    if (series.points.empty()) continue;
    const std::string block = "$data" + std::to_string(i), colour = hex(i);
    text += block + " << EOD\n";
    for (const auto& point : series.points) {
      text += number(point[0]) + " " + number(point[1]) + "\n";
      x.take(point[0]), y.take(point[1]);
    }
    text += "EOD\n";
    const bool line = chart.kind == ChartKind::lines,
               marked = !line || (chart.markers && series.points.size() <= most_marked);
    const std::string look =
        line ? (marked ? "linespoints lw 2.2 pt 7 ps 0.9" : "lines lw 2.2") : "points pt 7 ps 0.75";
    parts.push_back(block + " using 1:2 with " + look + " lc rgb '" + colour + "' " + title_of(series.name));
  }
  for (const ChartReference& line : chart.references) {
    const bool level = line.across == ChartReference::Across::horizontal, log = level ? chart.log_y : chart.log_x;
    if (!log || line.at > 0) (level ? y : x).take(line.at);
  }
  text += range_text("x", x.low, x.high, chart.log_x, false) + range_text("y", y.low, y.high, chart.log_y, false);
  add_legend(chart, data, x, y, text);
  add_references(chart, text);
  add_plot(parts, text);
}

/// Names of tics are formats to gnuplot: a percent sign is written twice.
std::string without_formats(const std::string& text) {
  std::string plain;
  for (char c : text) plain += c == '%' ? std::string("%%") : std::string(1, c);
  return plain;
}

void add_bars(const Chart& chart, const Drawable& data, std::string& text) {
  Span y;
  std::size_t most = 0;
  std::vector<std::string> parts;
  const double width = 0.8 / static_cast<double>(data.series.size());
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    const Drawable::Series& series = data.series[i];
    most = std::max(most, chart.series[i].y.size());
    if (series.points.empty()) continue;
    const std::string block = "$data" + std::to_string(i);
    text += block + " << EOD\n";
    for (const auto& point : series.points) {
      text += number(point[0] + 1 - 0.4 + (static_cast<double>(i) + 0.5) * width) + " " + number(point[1]) + " " +
              number(0.92 * width) + "\n";
      y.take(point[1]);
    }
    text += "EOD\n";
    parts.push_back(block + " using 1:2:3 with boxes fs solid 0.9 noborder lc rgb '" + hex(i) +
                    "' " + title_of(series.name));
  }
  text += "set grid noxtics nomxtics\nset xtics scale 0 (";
  for (std::size_t i = 0; i < most; ++i)
    text += std::string(i ? ", " : "") +
            gnuplot_quoted(i < chart.categories.size() ? without_formats(chart.categories[i]) : std::to_string(i + 1)) +
            " " + std::to_string(i + 1);
  text += ")\nset xrange [0.4:" + number(static_cast<double>(most) + 0.6) + "]\n";
  for (const ChartReference& line : chart.references)
    if (line.across == ChartReference::Across::horizontal && (!chart.log_y || line.at > 0)) y.take(line.at);
  text += range_text("y", y.low, y.high, chart.log_y, true);
  add_references(chart, text);
  add_plot(parts, text);
}

void add_histogram(const Chart& chart, const Drawable& data, std::string& text) {
  Span x;
  double tallest = 1;
  std::vector<std::string> parts;
  const bool many = data.series.size() > 1;
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    std::vector<double> samples;
    for (const auto& point : data.series[i].points) samples.push_back(chart.log_x ? std::log10(point[1]) : point[1]);
    if (samples.empty()) continue;
    const Histogram bins = histogram_of(std::move(samples), chart.bins);
    const std::string block = "$data" + std::to_string(i);
    text += block + " << EOD\n";
    for (std::size_t k = 0; k < bins.counts.size(); ++k) {
      const auto edge = [&](std::size_t e) { return chart.log_x ? std::pow(10, bins.edges[e]) : bins.edges[e]; };
      // A log axis cannot show an empty bin: it is left out there.
      if (chart.log_y && bins.counts[k] == 0) continue;
      text += number(0.5 * edge(k) + 0.5 * edge(k + 1)) + " " + std::to_string(bins.counts[k]) + " " + number(edge(k)) +
              " " + number(edge(k + 1)) + "\n";
      x.take(edge(k)), x.take(edge(k + 1));
      tallest = std::max(tallest, static_cast<double>(bins.counts[k]));
    }
    text += "EOD\n";
    const std::string colour = hex(i);
    parts.push_back(block + " using 1:2:3:4:(" + (chart.log_y ? "0.5" : "0") + "):2 with boxxyerror fs " +
                    (many ? "transparent solid 0.45" : "solid 0.85") + " border rgb '#ffffff' lc rgb '" + colour +
                    "' " + title_of(data.series[i].name));
  }
  for (const ChartReference& line : chart.references)
    if (line.across == ChartReference::Across::horizontal) tallest = std::max(tallest, line.at);
    else if (!chart.log_x || line.at > 0) x.take(line.at);
  text += range_text("x", x.low, x.high, chart.log_x, false);
  text += "set yrange [" + std::string(chart.log_y ? "0.5" : "0") + ":" + number(1.08 * tallest) + "]\n";
  add_references(chart, text);
  add_plot(parts, text);
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) quoted += ' ';
    else if (c == '"' || c == '\\') quoted += std::string("\\") + c;
    else if (c == '`') quoted += "\\140";  // a backquote in double quotes would run a command
    else quoted += c;
  }
  return quoted + "\"";
}

namespace {

void add_chart(const Chart& chart, int font, bool svg, ChartScript& script) {
  Drawable data = drawable_of(chart);
  data.letter = font;
  script.dropped += data.dropped;
  for (const Drawable::Series& series : data.series) script.drawn += series.points.size();
  add_look(chart, font, svg, script.text);
  if (chart.kind == ChartKind::bars) add_bars(chart, data, script.text);
  else if (chart.kind == ChartKind::histogram) add_histogram(chart, data, script.text);
  else add_points(chart, data, script.text);
}

}  // namespace

ChartScript chart_script(const Chart& chart, const std::string& output, bool svg) {
  const int font = font_size(chart.width, chart.height);
  ChartScript script;
  add_terminal(chart.width, chart.height, font, output, svg, script.text);
  add_chart(chart, font, svg, script);
  script.text += "unset output\n";
  return script;
}

ChartScript sheet_script(const ChartSheet& sheet, const std::string& output, bool svg) {
  const int count = static_cast<int>(sheet.charts.size());
  const int columns = sheet.columns > 0 ? std::min(sheet.columns, count) : static_cast<int>(std::ceil(std::sqrt(count)));
  const int rows = (count + columns - 1) / columns;
  const int width = sheet.width / columns, height = sheet.height / rows;
  const int font = std::max(smallest_on_sheet, font_size(width, height));
  ChartScript script;
  add_terminal(sheet.width, sheet.height, font, output, svg, script.text);
  script.text += "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + " rowsfirst";
  if (!sheet.title.empty())
    script.text += " title " + gnuplot_quoted(sheet.title) + " font 'DejaVu Sans" + (svg ? "," : ":Bold,") +
                   std::to_string(font * 5 / 4) + "' textcolor rgb '#202020'";
  script.text += "\n";
  for (Chart panel : sheet.charts) {
    panel.width = width, panel.height = height;
    script.text += "reset\n";
    add_chart(panel, font, svg, script);
  }
  script.text += "unset multiplot\nunset output\n";
  return script;
}

}  // namespace tendril
