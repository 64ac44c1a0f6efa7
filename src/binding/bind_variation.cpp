// method.variation: many outcomes of a design, and what they say.
#include <algorithm>
#include <cmath>

#include "base/write_file.h"
#include "binding/bind_envelope.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/method_options.h"
#include "binding/number_like.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "binding/variation_chart.h"
#include "binding/variation_classes.h"
#include "binding/variation_options.h"

namespace tendril::lua {
namespace {

const std::string study_example = with_hose("local v = method.variation(s, {vary = {[\"hose.length\"] = 0.02, [\"hose.to\"] = {ball = 0.005}},\n"
                                            "  measure = {\"hose.min_bend_radius\"}, outcomes = 200})\n");
const std::string measure_example = study_example + "local m = v[\"hose.min_bend_radius\"]\n";

using variation::Estimate;
using variation::OutcomeStatus;

const std::pair<const char*, double> quantiles[] = {{"q001", 0.001}, {"q01", 0.01}, {"q05", 0.05}, {"q50", 0.5},
                                                    {"q95", 0.95},   {"q99", 0.99}, {"q999", 0.999}};

const std::string& unit_of(const MeasuredHandle& m) { return m.result->outcomes.measures()[m.measure].unit; }
const std::string& name_of(const MeasuredHandle& m) { return m.result->outcomes.measures()[m.measure].name; }

EstimateValue with_unit(const MeasuredHandle& m, const Estimate& estimate) { return {estimate, unit_of(m)}; }

std::string plus_minus(const Estimate& e, const std::string& unit) {
  const std::string half = std::isfinite(e.half_width()) ? quantity(e.half_width(), unit) : "unknown";
  return quantity(e.value, unit) + " +- " + half;
}

std::string describe_estimate(const EstimateValue& e) {
  if (e.estimate.kind == variation::IntervalKind::none) return quantity(e.estimate.value, e.unit);
  return quantity(e.estimate.value, e.unit) + " (95 %: " + quantity(e.estimate.low, e.unit) + " ... " + quantity(e.estimate.high, e.unit) +
         ", " + variation::name_of(e.estimate.kind) + ")";
}

variation::Contributions contributions_of(lua_State* L, const MeasuredHandle& m) {
  return m.result->study->contributions(m.result->outcomes, m.measure, run_context(L));
}

/// Numbers from 1, as a script counts.
std::vector<int> counted_from_one(std::vector<int> list) {
  for (int& k : list) ++k;
  return list;
}

std::vector<std::string> measure_names(const VariationHandle& v) {
  std::vector<std::string> names;
  for (const variation::Column& c : v.result->outcomes.measures()) names.push_back(c.name);
  return names;
}

std::vector<std::string> variable_names(const VariationHandle& v) {
  std::vector<std::string> names;
  for (const variation::Column& c : v.result->outcomes.variables()) names.push_back(c.name);
  return names;
}

std::map<std::string, double> by_name(const std::vector<variation::Column>& columns, std::span<const double> values) {
  std::map<std::string, double> out;
  for (std::size_t k = 0; k < columns.size() && k < values.size(); ++k) out[columns[k].name] = values[k];
  return out;
}

std::string share_text(double share) {
  return std::isfinite(share) ? plain_number(std::round(1000 * share) / 10) + " %" : "unknown";
}

std::string contributors_text(const variation::Contributions& c) {
  std::vector<std::vector<std::string>> rows;
  for (const variation::Contributor& one : c.all)
    rows.push_back({one.name, share_text(one.linear), share_text(one.regression), share_text(one.first.value), share_text(one.total.value)});
  std::string text = table_text({"contributor", "linear", "regression", "first order", "total"}, rows);
  if (!c.message.empty()) text += "\n" + c.message;
  return text;
}

std::string table_of_measures(const variation::Result& r) {
  std::vector<std::vector<std::string>> rows;
  for (int k = 0; k < static_cast<int>(r.outcomes.measures().size()); ++k) {
    const variation::Sample sample = r.study->sample(r.outcomes, k);
    const std::string& unit = r.outcomes.measures()[k].unit;
    rows.push_back({r.outcomes.measures()[k].name, quantity(r.outcomes.measures()[k].nominal, unit), plus_minus(sample.mean(), unit),
                    plus_minus(sample.deviation(), unit), quantity(sample.min(), unit), quantity(sample.quantile(0.05).value, unit),
                    quantity(sample.quantile(0.95).value, unit), quantity(sample.max(), unit)});
  }
  return table_text({"measure", "nominal", "mean", "deviation", "min", "5 %", "95 %", "max"}, rows);
}

std::string describe_result(const variation::Result& r) {
  const variation::Options& options = r.study->options();
  Card card("variation");
  card.row("status", r.ok ? "solved" : tendril::name_of(r.status), r.message);
  card.row("sampling", variation::name_of(options.sampling), "seed " + std::to_string(r.study->seed()));
  card.row("variables", std::to_string(r.outcomes.variables().size()));
  card.row("time", r.seconds, "s");
  return card.text() + "\n" + table_of_measures(r);
}

/// The card, and which variables are to blame for each measure.
std::string report(lua_State* L, const variation::Result& r) {
  std::string text = describe_result(r);
  for (int k = 0; k < static_cast<int>(r.outcomes.measures().size()); ++k)
    text += "\n\n" + r.outcomes.measures()[k].name + ": shares of the variance\n" +
            contributors_text(r.study->contributions(r.outcomes, k, run_context(L)));
  return text;
}

std::optional<MeasuredHandle> measured(const VariationHandle& v, const std::string& name) {
  const std::vector<std::string> names = measure_names(v);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  const int k = static_cast<int>(found - names.begin());
  return MeasuredHandle{v.result, k, std::make_shared<variation::Sample>(v.result->study->sample(v.result->outcomes, k))};
}

std::shared_ptr<SceneEquilibrium> equilibrium_of(lua_State* L, const VariationHandle& v, int outcome) {
  const variation::Result& r = *v.result;
  if (outcome < 1 || outcome > r.outcomes.size())
    throw UsageError("variation:equilibrium: got outcome " + std::to_string(outcome) + ", expected 1 to " + std::to_string(r.outcomes.size()));
  return std::make_shared<SceneEquilibrium>(r.study->equilibrium(outcome - 1, run_context(L)));
}

SavedFile save_outcomes(const VariationHandle& v, const std::string& path) {
  if (path.size() < 4 || path.substr(path.size() - 4) != ".csv")
    throw UsageError("variation:save: got '" + path + "', expected a file name that ends in .csv");
  write_file(path, v.result->outcomes.csv());
  return SavedFile{path, Status::solved, 0};
}

void bind_measured(lua_State* L) {
  Class<MeasuredHandle> bound(L, "One measure over all outcomes");
  bound.property("name", "", "Of the measure", [](const MeasuredHandle& m) { return name_of(m); })
      .property("unit", "", "SI", [](const MeasuredHandle& m) { return unit_of(m); })
      .property("nominal", "", "Of the nominal design", [](const MeasuredHandle& m) { return m.result->outcomes.measures()[m.measure].nominal; })
      .property("count", "", "Outcomes that have it", [](const MeasuredHandle& m) { return m.sample->size(); })
      .property("missing", "", "Outcomes that failed", [](const MeasuredHandle& m) { return m.sample->missing(); })
      .property("mean", "", "With its 95 % interval", [](const MeasuredHandle& m) { return with_unit(m, m.sample->mean()); })
      .property("deviation", "", "Standard deviation", [](const MeasuredHandle& m) { return with_unit(m, m.sample->deviation()); })
      .property("min", "", "Smallest value", [](const MeasuredHandle& m) { return m.sample->min(); })
      .property("max", "", "Largest value", [](const MeasuredHandle& m) { return m.sample->max(); })
      .property("values", "", "Of all outcomes that have it, in order",
                [](const MeasuredHandle& m) { return m.result->outcomes.column(m.measure); })
      .property("interval", "", "95 % intervals {low, high} by name: mean, deviation and the quantiles",
                [](const MeasuredHandle& m) {
                  std::map<std::string, std::vector<double>> all;
                  const auto add = [&](const char* name, const Estimate& e) { all[name] = {e.low, e.high}; };
                  add("mean", m.sample->mean());
                  add("deviation", m.sample->deviation());
                  for (const auto& [name, share] : quantiles) add(name, m.sample->quantile(share));
                  return all;
                })
      .property("contributors", "", "Which variables are to blame for the variance, largest first; effects = n adds total effects",
                [](const MeasuredHandle& m) { return m.result->study->contributions(m.result->outcomes, m.measure).all; });
  for (const auto& [name, share] : quantiles)
    bound.property(name, "", "Quantile: this share of the outcomes lies below", [share = share](const MeasuredHandle& m) { return with_unit(m, m.sample->quantile(share)); });
  bound.method("quantile", {.takes = {"share"}, .does = "The value below which this share (0 ... 1) of the outcomes lies.",
                            .example = measure_example + "print(m:quantile(0.25) < m:quantile(0.75))  --> true"},
               [](const MeasuredHandle& m, double share) { return with_unit(m, m.sample->quantile(share)); })
      .method("below", {.takes = {"limit"}, .does = "The share of all outcomes below a limit; its interval counts failed ones either way.",
                         .example = measure_example + "print(m:below(m.max + 1).value)  --> 1.0"},
              [](const MeasuredHandle& m, double limit) { return EstimateValue{m.sample->share_below(limit), ""}; })
      .method("above", {.takes = {"limit"}, .does = "The share of all outcomes above a limit.",
                         .example = measure_example + "print(m:above(m.max).value)  --> 0.0"},
              [](const MeasuredHandle& m, double limit) { return EstimateValue{m.sample->share_above(limit), ""}; })
      .method("blame", {.does = "The contributors as a table of text.", .example = measure_example + "print(m:blame())"},
              [](lua_State* state, const MeasuredHandle& m) { return contributors_text(contributions_of(state, m)); })
      .method("histogram", {.options = {option<std::string>("title", "", "Above it"), option<double>("limit", "", "A line at this value")},
                            .does = "A chart of how often which values occur.",
                            .example = measure_example + "m:histogram{limit = 0.05}:save(\"histogram.svg\")"},
              [](const MeasuredHandle& m, const Options& o) {
                return histogram_of(*m.result, m.measure, o.maybe<std::string>("title").value_or(""), o.maybe<double>("limit"));
              })
      .method("scatter", {.takes = {"variable"}, .does = "A chart of the measure over a variable or another measure, a point an outcome.",
                          .example = measure_example + "m:scatter(\"hose.length\"):save(\"scatter.svg\")"},
              [](const MeasuredHandle& m, const std::string& over) { return scatter_of(*m.result, m.measure, over); })
      .tostring([](const MeasuredHandle& m) {
        Card card(name_of(m));
        card.row("nominal", quantity(m.result->outcomes.measures()[m.measure].nominal, unit_of(m)));
        card.row("mean", describe_estimate(with_unit(m, m.sample->mean())));
        card.row("deviation", describe_estimate(with_unit(m, m.sample->deviation())));
        for (const auto& [name, share] : quantiles) card.row(name, describe_estimate(with_unit(m, m.sample->quantile(share))));
        card.row("min, max", quantity(m.sample->min(), unit_of(m)), quantity(m.sample->max(), unit_of(m)));
        return card.text();
      });
}

void bind_parts(lua_State* L) {
  Class<EstimateValue> estimate(L, "An estimate that computes as a number, with its 95 % interval");
  estimate.property("value", "", "The estimate", [](const EstimateValue& e) { return e.estimate.value; })
      .property("low", "", "Lower end of the interval", [](const EstimateValue& e) { return e.estimate.low; })
      .property("high", "", "Upper end", [](const EstimateValue& e) { return e.estimate.high; })
      .property("kind", "", "How the interval was made", [](const EstimateValue& e) { return variation::name_of(e.estimate.kind); })
      .property("unit", "", "SI", [](const EstimateValue& e) { return e.unit; })
      .tostring(describe_estimate);
  compute_as_number(estimate);
  Class<variation::Contributor>(L, "What a variable contributes to a measure's variance, as shares of it")
      .property("name", "", "Of the variable, or of variables that depend on each other", [](const variation::Contributor& c) { return c.name; })
      .property("linear", "", "By the exact gradient at the nominal design", [](const variation::Contributor& c) { return c.linear; })
      .property("regression", "", "By linear regression over the outcomes", [](const variation::Contributor& c) { return c.regression; })
      .property("first", "", "By itself (effects = n)", [](const variation::Contributor& c) { return EstimateValue{c.first, ""}; })
      .property("total", "", "With all its interactions (effects = n)", [](const variation::Contributor& c) { return EstimateValue{c.total, ""}; })
      .tostring([](const variation::Contributor& c) { return c.name + ": " + share_text(std::isfinite(c.total.value) ? c.total.value : c.regression); });
  Class<OutcomeHandle>(L, "One outcome")
      .property("status", "", "\"solved\", \"jumped\", \"failed\" or \"unsolved\"",
                [](const OutcomeHandle& h) { return variation::name_of(h.result->outcomes.status(h.outcome)); })
      .property("message", "", "Why it is not solved", [](const OutcomeHandle& h) { return h.result->outcomes.message(h.outcome); })
      .property("variables", "", "By name", [](const OutcomeHandle& h) { return by_name(h.result->outcomes.variables(), h.result->outcomes.variables_of(h.outcome)); })
      .property("measures", "", "By name; NaN where it failed", [](const OutcomeHandle& h) { return by_name(h.result->outcomes.measures(), h.result->outcomes.measures_of(h.outcome)); });
  Class<OutcomesHandle>(L, "The outcomes of a study, in order")
      .list([](const OutcomesHandle& h) { return h.result->outcomes.size(); },
            [](const OutcomesHandle& h, std::size_t i) { return OutcomeHandle{h.result, static_cast<int>(i)}; });
}

}  // namespace

void bind_variation(lua_State* L, const std::shared_ptr<EnvelopeBuilder>& builder) {
  bind_parts(L);
  bind_measured(L);
  Class<VariationHandle> bound(L, "Many outcomes of a design: v[\"hose.min_bend_radius\"].mean, or v.gap of a measure called gap");
  bound.property("ok", "", "Every outcome has its measures", [](const VariationHandle& v) { return v.result->ok; })
      .property("status", "", "\"solved\", \"cancelled\", \"timeout\"", [](const VariationHandle& v) { return tendril::name_of(v.result->status); })
      .property("message", "", "How many, how many failed or jumped, and which", [](const VariationHandle& v) { return v.result->message; })
      .property("seconds", "s", "Run time", [](const VariationHandle& v) { return v.result->seconds; })
      .property("nominal", "", "The nominal equilibrium",
                [](const VariationHandle& v) { return std::make_shared<SceneEquilibrium>(v.result->study->nominal()); })
      .property("measures", "", "Names", measure_names)
      .property("variables", "", "Names of their components", variable_names)
      .property("outcomes", "", "#v.outcomes, v.outcomes[k].variables, .measures, .status, .message",
                [](const VariationHandle& v) { return OutcomesHandle{v.result}; })
      .property("failed", "", "Numbers of the outcomes without an equilibrium",
                [](const VariationHandle& v) { return counted_from_one(v.result->outcomes.all(OutcomeStatus::failed)); })
      .property("jumped", "", "Numbers of the outcomes in another equilibrium than the nominal one's continuation",
                [](const VariationHandle& v) { return counted_from_one(v.result->outcomes.all(OutcomeStatus::jumped)); })
      .method("measure", {.takes = {"name"}, .does = "The measure of this name, also where a property hides it.",
                           .example = study_example + "print(v:measure(\"hose.min_bend_radius\").count)  --> 200"},
              [](const VariationHandle& v, const std::string& name) {
                return MeasuredHandle{*measured(v, v.result->outcomes.measures()[v.result->study->measure(name)].name)};
              })
      .method("column", {.takes = {"name"}, .does = "All values of a variable's component or a measure, in order; NaN where there is none.",
                          .example = study_example + "print(#v:column(\"hose.length\"))  --> 200"},
              [](const VariationHandle& v, const std::string& name) { return column_of(*v.result, name); })
      .method("equilibrium", {.takes = {"outcome"}, .does = "One outcome (counted from 1) again, as an equilibrium of the scene.",
                              .example = study_example + "print(v:equilibrium(7).ok)  --> true"},
              equilibrium_of)
      .method("report", {.does = "The card with the contributors of every measure, as text.", .example = study_example + "print(v:report())"},
              [](lua_State* state, const VariationHandle& v) { return report(state, *v.result); })
      .method("save", {.takes = {"path"}, .does = "Writes the outcomes into a .csv: status, variables, measures, message.",
                       .example = study_example + "v:save(\"outcomes.csv\")"},
              save_outcomes)
      .members(measure_names, measured)
      .tostring([](const VariationHandle& v) { return describe_result(*v.result); });
  add_envelope_to(bound, builder);
}

void add_variation_to(Module& method) {
  method.function("variation",
                  {.takes = {"scene"}, .options = variation_schema(),
                   .does = "Many outcomes of a design whose numbers vary: statistics with confidence intervals, contributors, failures and jumps.",
                   .example = study_example + "print(v.ok, v[\"hose.min_bend_radius\"].count)  --> true\t200"},
                  [](lua_State* state, const Scene& scene, const Options& o) {
                    return VariationHandle{std::make_shared<const variation::Result>(
                        variation::run(scene, variation_options(state, scene, o), {}, method_context(state, o),
                                       o.maybe<std::string>("store").value_or("")))};
                  });
}

}  // namespace tendril::lua
