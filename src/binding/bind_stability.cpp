// method.stability: how measures answer to design variables, to first order.
#include <algorithm>
#include <cmath>

#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/lua_class.h"
#include "binding/method_options.h"
#include "binding/scene_classes.h"
#include "binding/variation_classes.h"

namespace tendril::lua {
namespace {

/// Names, or tolerances by name.
using Vary = std::variant<std::map<std::string, double>, std::vector<std::string>>;

Schema stability_schema() {
  return Schema{
             option<Vary>("vary", "", "Design variables: a list of names, or {[\"hose.length\"] = tolerance}; a name that others begin with "
                                      "means all of them; default: lengths, frames of holds and branch points, gravity"),
             option<std::vector<std::string>>("measure", "", "Names; default: bend radius, tension, length and clearance of every rod"),
         } +
         solve_schema() + timeout_schema();
}

stability::Options stability_options(const Options& o) {
  stability::Options options;
  if (o.has("vary")) {
    const Vary vary = o.get<Vary>("vary");
    if (const auto* names = std::get_if<std::vector<std::string>>(&vary))
      for (const std::string& name : *names) options.vary.push_back({name, 0});
    else
      for (const auto& [name, tolerance] : std::get<std::map<std::string, double>>(vary)) options.vary.push_back({name, tolerance});
  }
  if (o.has("measure")) options.measures = o.get<std::vector<std::string>>("measure");
  return options;
}

std::string entry_text(const stability::Result& r, int measure, int variable) {
  const double value = r.matrix(measure, variable);
  if (!std::isfinite(value)) return "unknown";
  const std::string unit = r.unit(measure, variable);
  return plain_number(value) + (unit == "1" || unit.empty() ? "" : " " + unit);
}

/// A row a variable: matrices of few measures and many variables read better so.
std::string stability_table(const stability::Result& r) {
  const bool tolerances = std::any_of(r.variables.begin(), r.variables.end(), [](const auto& v) { return v.tolerance > 0; });
  std::vector<std::string> head{"variable"};
  if (tolerances) head.push_back("tolerance");
  for (const auto& measure : r.measures) {
    head.push_back(measure.name);
    if (tolerances) head.push_back("within it");
  }
  std::vector<std::vector<std::string>> rows;
  for (int v = 0; v < static_cast<int>(r.variables.size()); ++v) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(r.variables[v].name);
    if (tolerances) row.push_back(r.variables[v].tolerance > 0 ? quantity(r.variables[v].tolerance, r.variables[v].unit) : "-");
    for (int m = 0; m < static_cast<int>(r.measures.size()); ++m) {
      row.push_back(entry_text(r, m, v));
      if (tolerances) row.push_back("+- " + quantity(std::abs(r.scaled(m, v)), r.measures[m].unit));
    }
  }
  return table_text(head, rows);
}

std::string describe_stability(const stability::Result& r) {
  Card card("stability");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.ok ? "" : r.message);
  card.row("time", r.seconds, "s");
  for (const auto& measure : r.measures) card.row(measure.name, quantity(measure.value, measure.unit), measure.message);
  return card.text() + "\n" + stability_table(r);
}

using Matrix = std::map<std::string, std::map<std::string, double>>;

Matrix by_names(const stability::Result& r, const Eigen::MatrixXd& of) {
  Matrix out;
  for (int m = 0; m < static_cast<int>(r.measures.size()); ++m)
    for (int v = 0; v < static_cast<int>(r.variables.size()); ++v) out[r.measures[m].name][r.variables[v].name] = of(m, v);
  return out;
}

template <class Columns>
std::vector<std::string> names_in(const Columns& columns) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  return names;
}

const std::string example = with_hose("local st = method.stability(s, {vary = {[\"hose.length\"] = 0.01, [\"hose.to.at.z\"] = 0.005},\n"
                                      "  measure = {\"hose.min_bend_radius\"}})\n");

}  // namespace

void bind_stability(lua_State* L) {
  Class<StabilityHandle>(L, "How measures answer to design variables: st.matrix[measure][variable], in SI units")
      .property("ok", "", "All derivatives exist", [](const StabilityHandle& s) { return s.result.ok; })
      .property("status", "", "How it ended", [](const StabilityHandle& s) { return name_of(s.result.status); })
      .property("message", "", "What there is to say about it", [](const StabilityHandle& s) { return s.result.message; })
      .property("seconds", "s", "Run time", [](const StabilityHandle& s) { return s.result.seconds; })
      .property("equilibrium", "", "That it is about", [](const StabilityHandle& s) { return s.equilibrium; })
      .property("measures", "", "Names", [](const StabilityHandle& s) { return names_in(s.result.measures); })
      .property("variables", "", "Names", [](const StabilityHandle& s) { return names_in(s.result.variables); })
      .property("matrix", "", "Derivatives by measure and variable", [](const StabilityHandle& s) { return by_names(s.result, s.result.matrix); })
      .property("within", "", "The same times the tolerances, in the measure's unit", [](const StabilityHandle& s) { return by_names(s.result, s.result.scaled); })
      .method("moves", {.takes = {"rod"}, .does = "How far each vertex of a rod moves, m: the most that one variable does within its tolerance; "
                                                  "without tolerances per unit of all variables.",
                        .example = example + "print(#st:moves(\"hose\"))  --> 41"},
              [](const StabilityHandle& s, const std::string& rod) {
                const auto [system, index] = place_of_rod(*s.equilibrium, rod);
                return s.result.colour(s.equilibrium->systems[system].rods[index]);
              })
      .tostring([](const StabilityHandle& s) { return describe_stability(s.result); });
}

void add_stability_to(Module& method) {
  method.function("stability",
                  {.takes = {"scene"}, .options = stability_schema(),
                   .does = "The exact first-order matrix: how measures answer to design variables. Print it for a table with units.",
                   .example = example + "print(st.ok, st.matrix[\"hose.min_bend_radius\"][\"hose.length\"] < 0)  --> true\ttrue"},
                  [](lua_State* L, const Scene& scene, const Options& o) {
                    const RunContext context = run_context(L, o);
                    auto equilibrium = std::make_shared<SceneEquilibrium>(scene.solve(solve_options(o), context));
                    stability::Result result = stability::run(*equilibrium, stability_options(o), context);
                    return StabilityHandle{equilibrium, std::move(result)};
                  });
}

}  // namespace tendril::lua
