#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "base/write_file.h"
#include "view/chart.h"
#include "view/chart_script.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

Chart small_chart() {
  Chart chart;
  chart.title = "Error against run time";
  chart.x_label = "run time [s]";
  chart.y_label = "error [m]";
  chart.series = {{"order 2", {1, 2, 4, 8}, {1, 0.25, 0.0625, 0.015625}}};
  chart.width = 300, chart.height = 200;
  return chart;
}

std::string complaint(const std::function<void(Chart&)>& spoil) {
  Chart chart = small_chart();
  spoil(chart);
  try {
    save_chart(chart, (std::filesystem::temp_directory_path() / "tendril_test_chart.svg").string());
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no complaint";
}

std::filesystem::path fresh_folder(const char* name) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tendril_test_chart_" + std::to_string(getpid()) + "_" + name);
  std::filesystem::remove_all(folder);
  return folder;
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a chart is written as PNG or SVG by its name, its folder made") {
  const auto folder = fresh_folder("kinds");
  const ChartReport report = save_chart(small_chart(), (folder / "a" / "chart.png").string());
  CHECK(report.status == Status::solved);
  CHECK(report.drawn == 4);
  CHECK(report.dropped == 0);
  CHECK(read_file((folder / "a" / "chart.png").string()).substr(0, 8) == "\x89PNG\r\n\x1a\n");
  save_chart(small_chart(), (folder / "chart.svg").string());
  const std::string svg = read_file((folder / "chart.svg").string());
  CHECK_THAT(svg,
             Contains("<svg") && Contains("Error against run time") && Contains("error [m]") && Contains("order 2"));
  save_chart(small_chart(), (folder / "again.svg").string());
  CHECK(read_file((folder / "again.svg").string()) == svg);
  std::filesystem::remove_all(folder);
}

TEST_CASE("points that cannot be shown are left out and counted") {
  Chart chart = small_chart();
  chart.series[0].x.insert(chart.series[0].x.end(), {NAN, 1, INFINITY, -1, 1});
  chart.series[0].y.insert(chart.series[0].y.end(), {1, NAN, 1, 1, 0});
  CHECK(chart_script(chart, "out", true).dropped == 3);
  chart.log_x = true;
  CHECK(chart_script(chart, "out", true).dropped == 4);
  chart.log_y = true;
  const ChartScript script = chart_script(chart, "out", true);
  CHECK(script.dropped == 5);
  CHECK(script.drawn == 4);
  CHECK_THAT(script.text, !Contains("nan") && !Contains("inf"));
}

TEST_CASE("a histogram's bars add up to its samples") {
  Chart chart = small_chart();
  chart.kind = ChartKind::histogram;
  chart.series = {{"gap", {}, {1, 2, 2, 3, 3, 3, NAN}}};
  chart.bins = 4;
  const ChartScript script = chart_script(chart, "out", true);
  CHECK(script.drawn == 6);
  CHECK(script.dropped == 1);
  CHECK_THAT(script.text, Contains("1.25 1 1 1.5\n1.75 0 1.5 2\n2.25 2 2 2.5\n2.75 3 2.5 3\nEOD"));
}

TEST_CASE("every kind, scale and number of points is drawn") {
  const auto folder = fresh_folder("all");
  for (ChartKind kind : {ChartKind::lines, ChartKind::scatter, ChartKind::bars, ChartKind::histogram})
    for (bool log : {false, true})
      for (int points : {1, 2, 300}) {
        Chart chart = small_chart();
        chart.kind = kind;
        chart.log_x = chart.log_y = log;
        chart.series.clear();
        for (int s = 0; s < 2; ++s) {
          ChartSeries series;
          series.name = "series " + std::to_string(s);
          for (int i = 0; i < points; ++i) {
            if (kind == ChartKind::lines || kind == ChartKind::scatter) series.x.push_back(i + 1);
            series.y.push_back(std::pow(1.02, i) * (s + 1));
          }
          chart.series.push_back(series);
        }
        chart.references = {{ChartReference::Across::horizontal, 1.5, "limit"},
                            {ChartReference::Across::vertical, 2, "here"}};
        INFO("kind " << int(kind) << " log " << log << " points " << points);
        CHECK(save_chart(chart, (folder / "chart.svg").string()).drawn == static_cast<std::size_t>(2 * points));
        const std::string svg = read_file((folder / "chart.svg").string());
        CHECK(count_of(svg, ">limit<") == 1);
        CHECK(count_of(svg, "</svg>") == 1);
      }
  std::filesystem::remove_all(folder);
}

TEST_CASE("extreme numbers are drawn") {
  const auto folder = fresh_folder("extreme");
  for (const std::vector<double>& y :
       {std::vector<double>{-1.7e308, 1.7e308}, {0, 0}, {1e-300, 1e300}, {5e-324, 1e-320}, {1e15, 1e15 + 1}}) {
    for (bool log : {false, true}) {
      Chart chart = small_chart();
      chart.series = {{"y", {1, 2}, y}};
      chart.log_y = log;
      if (log && y[1] <= 0) continue;
      INFO(y[0] << " " << y[1] << " log " << log);
      CHECK(save_chart(chart, (folder / "chart.svg").string()).status == Status::solved);
    }
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("texts are texts, whatever they hold") {
  const auto folder = fresh_folder("texts");
  std::filesystem::create_directories(folder);
  const std::filesystem::path trap = folder / "trap";
  const std::string order = "touch " + trap.string();
  for (const std::string& hostile :
       {"`" + order + "`", "\"; system('" + order + "'); set title \"", "'; system \"" + order + "\"",
        "\\\"\n!" + order + "\n", "$(" + order + ")", std::string("EOD\nsystem('" + order + "')\n"),
        std::string("a_b^c {/Bold x} @y & <b>&amp; \x01 \x80\xff é"),
        std::string("%s %d %n \\140" + order + "\\140")}) {
    Chart chart = small_chart();
    chart.title = chart.x_label = chart.y_label = chart.series[0].name = hostile;
    chart.references = {{ChartReference::Across::horizontal, 0.5, hostile}};
    INFO(hostile);
    CHECK(save_chart(chart, (folder / "chart.svg").string()).status == Status::solved);
    chart.kind = ChartKind::bars;
    chart.series[0].x.clear();
    chart.categories = {hostile, hostile, hostile, hostile};
    CHECK(save_chart(chart, (folder / "chart.png").string()).status == Status::solved);
    CHECK_FALSE(std::filesystem::exists(trap));
  }
  Chart marked = small_chart();
  marked.title = "length_of_hose^2 {x}";
  save_chart(marked, (folder / "chart.svg").string());
  CHECK_THAT(read_file((folder / "chart.svg").string()), Contains("length_of_hose^2 {x}"));
  const std::string quoted = gnuplot_quoted("a\"b\\c`d\ne");
  CHECK(quoted == "\"a\\\"b\\\\c\\140d e\"");
  std::filesystem::remove_all(folder);
}

TEST_CASE("a reference line is drawn once each and keeps inside the axes") {
  Chart chart = small_chart();
  chart.references = {{ChartReference::Across::horizontal, 3, "too high"},
                      {ChartReference::Across::vertical, 20, "too far"}};
  const std::string script = chart_script(chart, "out", true).text;
  CHECK(count_of(script, "set arrow") == 2);
  double from = 0, to = 0;
  REQUIRE(std::sscanf(script.c_str() + script.find("set yrange"), "set yrange [%lf:%lf]", &from, &to) == 2);
  CHECK(to > 3);
  REQUIRE(std::sscanf(script.c_str() + script.find("set xrange"), "set xrange [%lf:%lf]", &from, &to) == 2);
  CHECK(to > 20);
}

TEST_CASE("what cannot be charted is refused with words") {
  CHECK_THAT(complaint([](Chart& c) { c.series.clear(); }), Contains("no series"));
  CHECK_THAT(complaint([](Chart& c) { c.series[0].x.pop_back(); }), Contains("series 'order 2': 3 x for 4 y"));
  CHECK_THAT(complaint([](Chart& c) { c.series[0] = {"none", {}, {}}; }), Contains("none of 0 points"));
  CHECK_THAT(complaint([](Chart& c) { c.series[0] = {"none", {1}, {NAN}}; }), Contains("none of 1 points is finite"));
  CHECK_THAT(complaint([](Chart& c) {
               c.series[0] = {"none", {1}, {-1}};
               c.log_y = true;
             }),
             Contains("positive on the log axes"));
  CHECK_THAT(complaint([](Chart& c) { c.series.assign(13, c.series[0]); }), Contains("13 series"));
  CHECK_THAT(complaint([](Chart& c) { c.width = 10; }), Contains("size 10 x 200"));
  CHECK_THAT(complaint([](Chart& c) { c.height = 100000; }), Contains("expected 64 ... 8192"));
  CHECK_THAT(complaint([](Chart& c) { c.bins = -1; }), Contains("-1 bins"));
  CHECK_THAT(complaint([](Chart& c) { c.kind = ChartKind::bars; }), Contains("take y only"));
  CHECK_THAT(complaint([](Chart& c) {
               c.kind = ChartKind::bars;
               c.series[0].x.clear();
               c.categories = {"one"};
             }),
             Contains("4 bars for 1 categories"));
  CHECK_THAT(complaint([](Chart& c) {
               c.references.push_back({ChartReference::Across::vertical, NAN, "x"});
             }),
             Contains("reference line 'x'"));
  CHECK_THROWS_WITH(save_chart(small_chart(), "chart.pdf"), Contains("'chart.pdf'") && Contains(".png or .svg"));
  CHECK_THROWS_WITH(save_chart(small_chart(), "/proc/nowhere/chart.svg"), Contains("/proc/nowhere/chart.svg"));
}

TEST_CASE("a missing gnuplot is named with its package") {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  CHECK_THAT(complaint([](Chart&) {}), Contains("gnuplot is missing (package gnuplot-nox)"));
  setenv("PATH", path.c_str(), 1);
  CHECK(complaint([](Chart&) {}) == "no complaint");
}

TEST_CASE("a gnuplot that fails or hangs does no harm") {
  const auto folder = fresh_folder("fake");
  std::filesystem::create_directories(folder);
  const std::string path = std::getenv("PATH");
  const auto install = [&](const std::string& body) {
    write_file((folder / "gnuplot").string(), "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
  };
  setenv("PATH", (folder.string() + ":" + path).c_str(), 1);
  install("echo no licence for you; exit 3");
  CHECK_THAT(complaint([](Chart&) {}), Contains("gnuplot failed") && Contains("no licence for you"));
  install("exec 0<&-; sleep 0.05; exit 1");  // closes the pipe before it is fed
  CHECK_THAT(complaint([](Chart& c) { c.series[0].x.assign(100000, 1), c.series[0].y.assign(100000, 1); }),
             Contains("gnuplot failed"));
  install("exec sleep 60");
  RunContext context;
  context.deadline = RunContext::Clock::now() + std::chrono::milliseconds(100);
  const ChartReport report = save_chart(small_chart(), (folder / "chart.svg").string(), context);
  CHECK(report.status == Status::timeout);
  CHECK_FALSE(std::filesystem::exists(folder / "chart.svg"));
  setenv("PATH", path.c_str(), 1);
  std::filesystem::remove_all(folder);
}

TEST_CASE("names beside the lines take the legend's place") {
  Chart chart = small_chart();
  chart.direct_labels = true;
  const std::string script = chart_script(chart, "out", true).text;
  CHECK_THAT(script, Contains("set key off") && Contains("set label 1001 \"order 2\" at first"));
  chart.direct_labels = false;
  CHECK(count_of(chart_script(chart, "out", true).text, "set label") == 0);
}

TEST_CASE("a sheet holds its charts side by side") {
  ChartSheet sheet;
  sheet.title = "Two and one";
  sheet.charts = {small_chart(), small_chart(), small_chart()};
  sheet.charts[1].log_y = true;
  sheet.charts[1].direct_labels = true;
  sheet.charts[2].series[0].y[1] = NAN;
  const ChartScript script = sheet_script(sheet, "out", false);
  CHECK(script.drawn == 11);
  CHECK(script.dropped == 1);
  CHECK_THAT(script.text, Contains("set multiplot layout 2,2 rowsfirst title \"Two and one\"") && Contains("unset multiplot"));
  CHECK(count_of(script.text, "\nplot ") == 3);
  CHECK(count_of(script.text, "\nreset\n") == 3);  // a logarithmic axis does not reach the next chart
  CHECK(count_of(script.text, "set terminal") == 1);
  sheet.columns = 3;
  CHECK_THAT(sheet_script(sheet, "out", true).text, Contains("layout 1,3"));
  const auto folder = fresh_folder("sheet");
  const ChartReport report = save_sheet(sheet, (folder / "sheet.png").string());
  CHECK(report.status == Status::solved);
  CHECK(report.drawn == 11);
  CHECK(read_file((folder / "sheet.png").string()).substr(0, 8) == "\x89PNG\r\n\x1a\n");
  save_sheet(sheet, (folder / "sheet.svg").string());
  CHECK_THAT(read_file((folder / "sheet.svg").string()), Contains("Two and one") && Contains("width=\"1600\""));
  std::filesystem::remove_all(folder);
}

TEST_CASE("sheets that cannot be drawn are refused with words") {
  ChartSheet sheet;
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.svg"), Contains("0 charts on a sheet, expected 1 to 40"));
  sheet.charts.assign(41, small_chart());
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.svg"), Contains("41 charts"));
  sheet.charts.resize(2);
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.pdf"), Contains("'sheet.pdf'") && Contains(".png or .svg"));
  sheet.columns = -1;
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.svg"), Contains("-1 columns"));
  sheet.columns = 0;
  sheet.width = 20;
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.svg"), Contains("size 20 x 1200"));
  sheet.width = 1000;
  sheet.charts[1].title = "The second";
  sheet.charts[1].series[0].y.assign(4, NAN);
  CHECK_THROWS_WITH(save_sheet(sheet, "sheet.svg"), Contains("'The second'") && Contains("none of 4 points is finite"));
}
