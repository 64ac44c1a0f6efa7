// study: charts, and what a result costs.
#include "base/error.h"
#include "base/installation.h"
#include "base/number_text.h"
#include "binding/accuracy_chart.h"
#include "binding/bind_motion.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "binding/solve_options.h"

namespace tendril::lua {

/// A list of numbers that may hold NaN and infinities: a chart leaves those out.
struct Numbers {
  std::vector<double> values;
};

template <>
struct Value<Numbers> {
  static const Kind& kind() {
    static const Kind kind{"a list of numbers", "number[]", [](lua_State* L, int index) {
      if (!lua_istable(L, index)) return describe(L, index);
      const lua_Integer size = luaL_len(L, index);
      for (lua_Integer i = 1; i <= size; ++i) {
        const bool number = lua_geti(L, index, i) == LUA_TNUMBER;
        const std::string got = number ? "" : "entry " + std::to_string(i) + " = " + describe(L, -1);
        lua_pop(L, 1);
        if (!got.empty()) return got;
      }
      return std::string();
    }};
    return kind;
  }
  static Numbers read(lua_State* L, int index) {
    index = lua_absindex(L, index);
    Numbers numbers;
    const lua_Integer size = luaL_len(L, index);
    for (lua_Integer i = 1; i <= size; ++i) {
      lua_geti(L, index, i);
      numbers.values.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    }
    return numbers;
  }
};

namespace {

std::string wrong_table(lua_State* L, int index) { return lua_istable(L, index) ? std::string() : describe(L, index); }

const Schema& series_options() {
  static const Schema schema{
      option<std::string>("name", "", "In the legend"),
      option<Numbers>("x", "", "Abscissae; not for bars and histograms"),
      option<Numbers>("y", "", "Ordinates; the samples of a histogram").required(),
  };
  return schema;
}

const Schema& reference_options() {
  static const Schema schema{
      option<double>("at", "", "Where on its axis").required(),
      option<std::string>("across", "", "Which way the line runs").one_of({"horizontal", "vertical"}).preset("horizontal"),
      option<std::string>("label", "", "Beside it"),
  };
  return schema;
}

}  // namespace

template <>
struct Value<ChartSeries> {
  static const Kind& kind() {
    static const Kind kind{"a table {name =, x =, y =}", "{name: string, x: number[], y: number[]}", &wrong_table};
    return kind;
  }
  static ChartSeries read(lua_State* L, int index) {
    static const std::string who = "study.chart: series";
    const Options o(L, lua_absindex(L, index), series_options(), who);
    ChartSeries series;
    series.name = o.maybe<std::string>("name").value_or("");
    if (o.has("x")) series.x = o.get<Numbers>("x").values;
    series.y = o.get<Numbers>("y").values;
    return series;
  }
};

template <>
struct Value<ChartReference> {
  static const Kind& kind() {
    static const Kind kind{"a table {at =, across =, label =}", "{at: number, across: string?, label: string?}", &wrong_table};
    return kind;
  }
  static ChartReference read(lua_State* L, int index) {
    static const std::string who = "study.chart: references";
    const Options o(L, lua_absindex(L, index), reference_options(), who);
    ChartReference reference;
    reference.at = o.get<double>("at");
    reference.label = o.maybe<std::string>("label").value_or("");
    if (o.get<std::string>("across") == "vertical") reference.across = ChartReference::Across::vertical;
    return reference;
  }
};

namespace {

const std::vector<std::string> chart_kinds{"lines", "scatter", "bars", "histogram"};  // in the order of ChartKind

Schema chart_options() {
  return {
      option<std::string>("kind", "", "What it draws").one_of(chart_kinds).preset("lines"),
      option<std::vector<ChartSeries>>("series", "", "List of {name =, x =, y =}").required(),
      option<std::string>("title", "", "Above it"),
      option<std::string>("x_label", "", "Below it, with the unit: \"length [m]\""),
      option<std::string>("y_label", "", "Beside it, with the unit"),
      option<bool>("log_x", "", "Logarithmic").preset(false),
      option<bool>("log_y", "", "Logarithmic").preset(false),
      option<bool>("markers", "", "Mark the points of lines").preset(true),
      option<bool>("direct_labels", "", "Names beside the lines, no legend").preset(false),
      option<std::vector<std::string>>("categories", "", "Names below the bars"),
      option<std::vector<ChartReference>>("references", "", "Dashed lines: list of {at =, across = \"horizontal\"|\"vertical\", label =}"),
      option<int>("bins", "", "Of a histogram; 0: chosen from the data").at_least(0).at_most(10000).preset(0),
      option<std::array<int, 2>>("size", "pixels", "{width, height}; default {1200, 800}"),
  };
}

Chart make_chart(const Options& o) {
  Chart chart;
  const std::string kind = o.get<std::string>("kind");
  for (std::size_t i = 0; i < chart_kinds.size(); ++i)
    if (chart_kinds[i] == kind) chart.kind = static_cast<ChartKind>(i);
  chart.series = o.get<std::vector<ChartSeries>>("series");
  chart.title = o.maybe<std::string>("title").value_or("");
  chart.x_label = o.maybe<std::string>("x_label").value_or("");
  chart.y_label = o.maybe<std::string>("y_label").value_or("");
  chart.log_x = o.get<bool>("log_x");
  chart.log_y = o.get<bool>("log_y");
  chart.markers = o.get<bool>("markers");
  chart.direct_labels = o.get<bool>("direct_labels");
  chart.bins = o.get<int>("bins");
  if (o.has("categories")) chart.categories = o.get<std::vector<std::string>>("categories");
  if (o.has("references")) chart.references = o.get<std::vector<ChartReference>>("references");
  if (const auto size = o.maybe<std::array<int, 2>>("size")) {
    chart.width = (*size)[0];
    chart.height = (*size)[1];
  }
  check_chart(chart);
  return chart;
}

Schema sheet_options() {
  return Schema{option<std::string>("title", "", "Above all of them"),
                option<int>("columns", "", "Charts in a row; 0: as many as rows").at_least(0).at_most(40).preset(0),
                option<std::array<int, 2>>("size", "pixels", "{width, height} of the whole; default {1600, 1200}")}
      .with_list(Value<Chart>::kind(), "charts", "Charts, row by row");
}

ChartSheet make_sheet(const Options& o) {
  ChartSheet sheet;
  sheet.title = o.maybe<std::string>("title").value_or("");
  sheet.charts = o.list<Chart>();
  sheet.columns = o.get<int>("columns");
  if (const auto size = o.maybe<std::array<int, 2>>("size")) {
    sheet.width = (*size)[0];
    sheet.height = (*size)[1];
  }
  check_sheet(sheet);
  return sheet;
}

Schema accuracy_options() {
  return Schema{
             option<std::vector<int>>("segments", "", "Numbers of segments of every rod; default {10, 20, 40, 80, 160, 320}"),
             option<bool>("extrapolate", "", "Richardson: each row solves with half its segments too").preset(false),
             option<Function>("exact", "", "function(s, rod): the exact centre line where it is known, at an arc length in m of "
                                           "the rod with this name; default: a fine solution is the reference"),
             option<double>("repeat", "s", "For how long each solve is repeated; at least three times")
                 .at_least(0).at_most(3600).preset(0.05)} +
         solve_schema() + timeout_schema();
}

Accuracy make_accuracy(lua_State* L, const Scene& scene, const Options& o) {
  AccuracyOptions options;
  if (o.has("segments")) options.segments = o.get<std::vector<int>>("segments");
  options.solve = solve_options(o);
  options.extrapolate = o.get<bool>("extrapolate");
  options.seconds_each = o.get<double>("repeat");
  if (o.has("exact"))
    options.exact = [L, &scene, exact = o.get<Function>("exact")](std::size_t rod, double s) {
      const Vec3 place = exact.call<Vec3>(L, "study.accuracy: exact", s, scene.rods()[rod]->name());
      if (!all_finite(place)) throw UsageError("study.accuracy: 'exact' returned a place that is not finite at s = " + number_text(s) + " m");
      return place;
    };
  return study_accuracy(scene, options, run_context(L, o));
}

void bind_accuracy(lua_State* L) {
  Class<AccuracyRow>(L, "One number of segments in an accuracy study")
      .property("segments", "", "Of every rod", [](const AccuracyRow& r) { return r.segments; })
      .property("seconds", "s", "Median of repeated cold solves", [](const AccuracyRow& r) { return r.seconds; })
      .property("fastest", "s", "The shortest of them", [](const AccuracyRow& r) { return r.fastest; })
      .property("error", "m", "Against the reference", [](const AccuracyRow& r) { return r.error; })
      .property("order", "", "Observed against the row before; NaN in the first", [](const AccuracyRow& r) { return r.order; })
      .property("estimate", "m", "The solver's own estimate; NaN unless asked for and valid", [](const AccuracyRow& r) { return r.estimate; })
      .property("iterations", "", "Newton steps", [](const AccuracyRow& r) { return r.iterations; })
      .property("status", "", "How the solve ended", [](const AccuracyRow& r) { return name_of(r.status); })
      .tostring([](const AccuracyRow& r) {
        return std::to_string(r.segments) + " segments: " + quantity(r.error, "m") + " in " + quantity(r.seconds, "s");
      });
  Class<Accuracy>(L, "Error against run time")
      .property("ok", "", "The study is complete", [](const Accuracy& a) { return a.status == Status::solved; })
      .property("status", "", "How it ended", [](const Accuracy& a) { return name_of(a.status); })
      .property("message", "", "Why it is not complete", [](const Accuracy& a) { return a.message; })
      .property("rows", "", "One for each number of segments", [](const Accuracy& a) { return a.rows; })
      .property("element", "", "Which element", [](const Accuracy& a) { return a.element(); })
      .property("reference_segments", "", "Of the reference solution; 0: exact", [](const Accuracy& a) { return a.reference_segments; })
      .property("reference_uncertainty", "m", "What is not known of the reference", [](const Accuracy& a) { return a.reference_uncertainty; })
      .method("chart",
              {.options = {option<std::vector<Accuracy>>("with", "", "Other accuracy studies to draw beside this one"),
                           option<std::string>("title", "", "Above it")},
               .does = "Error against run time, both logarithmic.",
                         .example = with_hose("study.accuracy(s, {segments = {10, 20, 40}}):chart{}:save(\"accuracy.svg\")")},
              [](const Accuracy& a, const Options& o) {
                std::vector<Accuracy> all = o.maybe<std::vector<Accuracy>>("with").value_or(std::vector<Accuracy>());
                all.insert(all.begin(), a);
                return accuracy_chart(all, o.maybe<std::string>("title").value_or("Error against run time"));
              })
      .tostring(accuracy_table);
}

}  // namespace

void bind_study(lua_State* L) {
  Class<Chart>(L, "A chart to be")
      .method("save", {.takes = {"path"}, .options = timeout_schema(), .does = "Draws it into a .png or .svg; a missing folder is created.",
                         .example = "study.chart{series = {{name = \"sag\", x = {1, 2, 3}, y = {1, 4, 9}}}}:save(\"sag.svg\")"},
              [](lua_State* state, const Chart& chart, const std::string& path, const Options& o) {
                const ChartReport report = save_chart(chart, path, run_context(state, o));
                return SavedFile{path, report.status, report.seconds};
              })
      .tostring([](const Chart& chart) {
        return Card("chart").row("kind", chart_kinds[static_cast<std::size_t>(chart.kind)])
            .row("series", std::to_string(chart.series.size())).text();
      });
  Class<ChartSheet>(L, "Charts side by side")
      .method("save", {.takes = {"path"}, .options = timeout_schema(), .does = "Draws them into one .png or .svg; a missing folder is created.",
                       .example = "local c = study.chart{series = {{name = \"sag\", x = {1, 2, 3}, y = {1, 4, 9}}}}\n"
                                  "study.sheet{c, c}:save(\"sheet.svg\")"},
              [](lua_State* state, const ChartSheet& sheet, const std::string& path, const Options& o) {
                const ChartReport report = save_sheet(sheet, path, run_context(state, o));
                return SavedFile{path, report.status, report.seconds};
              })
      .tostring([](const ChartSheet& sheet) {
        return Card("sheet of charts").row("charts", std::to_string(sheet.charts.size())).text();
      });
  bind_accuracy(L);
  Module study(L, "study", "Charts, motions from files, and what a result costs");
  add_sampled_motion_to(study);
  study.function("chart",
                {.options = chart_options(), .does = "A chart of lines, points, bars or a histogram; draw it with :save(path).",
                 .example = "local c = study.chart{title = \"Sag\", x_label = \"length [m]\", y_label = \"sag [mm]\",\n"
                            "  series = {{name = \"hose\", x = {1.0, 1.1, 1.2}, y = {12, 95, 160}}}}\n"
                            "print(c)"},
                make_chart)
      .function("sheet",
                {.options = sheet_options(), .does = "Charts side by side in one picture; draw it with :save(path).",
                 .example = "local c = study.chart{series = {{name = \"sag\", x = {1, 2, 3}, y = {1, 4, 9}}}}\n"
                            "print(study.sheet{c, c, c, title = \"Sags\"})"},
                make_sheet)
      .function("accuracy",
                {.takes = {"scene"}, .options = accuracy_options(),
                 .does = "Solves a scene with more and more segments: error, order and time of each.",
                         .example = with_hose("print(study.accuracy(s, {segments = {10, 20, 40}}))")},
                make_accuracy)
      .function("assets",
                {.does = "The folder of the models that come with the program: engine_bay.ply, engine_bay_light.ply, six_axis.",
                 .example = "local bay = study.assets() .. \"/engine_bay_light.ply\"\nassert(bay:sub(1, 1) == \"/\")"},
                [] {
                  const std::string folder = part_folder(Part::assets);
                  if (folder.empty()) throw UsageError("study.assets: there is no folder " + part_places(Part::assets, "") +
                                                       "; build the models or set TENDRIL_ASSETS to their folder");
                  return folder;
                });
}

}  // namespace tendril::lua
