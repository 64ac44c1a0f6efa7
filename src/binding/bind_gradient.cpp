// gradient: derivatives of a measure by parameters.
#include "binding/bind_gradient.h"

#include <algorithm>
#include <cmath>

#include "binding/card.h"
#include "binding/examples.h"
#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

using What = Measure::What;

const std::pair<const char*, What> whats[] = {
    {"position", What::position}, {"rotation", What::rotation}, {"tangent", What::tangent}, {"force", What::force},
    {"moment", What::moment}, {"tension", What::tension}, {"twist", What::twist}, {"bend_radius", What::bend_radius},
    {"clearance", What::gap}};

std::vector<std::string> names_of_whats() {
  std::vector<std::string> names;
  for (const auto& [name, what] : whats) names.push_back(name);
  return names;
}

const Schema& measure_options() {
  static const Schema schema{
      option<std::string>("rod", "", "Name of the rod").required(),
      option<std::string>("what", "", "Of the section at `at`: along `along` its position, rotation (rad, from here on), tangent, "
                                      "internal force, or moment (d1, d2, d3 axes); its tension, twist, bend_radius. Or the rod's clearance")
          .one_of(names_of_whats()).required(),
      option<std::variant<std::string, double>>("at", "m", "\"start\", \"finish\" or an arc length; not of a clearance"),
      option<Vec3>("along", "", "Direction in world axes; default {0, 0, 1}"),
      option<std::string>("to", "", "Obstacle of a clearance; default: the nearest of all"),
  };
  return schema;
}

double place_on(const SolvedRod& rod, const std::variant<std::string, double>& at) {
  if (const double* number = std::get_if<double>(&at)) return *number;
  const std::string& end = std::get<std::string>(at);
  if (end == "start") return 0;
  if (end == "finish") return rod.problem.rod.length;
  throw UsageError("equilibrium:gradient: unknown place '" + end + "', expected \"start\", \"finish\" or an arc length in m");
}

std::string describe_gradient(const SceneGradient& g) {
  std::string text = "gradient of " + g.measure + " (" + quantity(g.value, g.unit) + ")";
  if (!g.ok) text += ", NOT VALID: " + g.message;
  std::vector<std::vector<std::string>> rows;
  for (const SceneGradient::Entry& e : g.entries)
    rows.push_back({e.parameter, std::isfinite(e.derivative) ? plain_number(e.derivative) : "unknown",
                    SceneGradient::unit_of(g.unit, e.unit)});
  return text + "\n" + table_text({"by", "derivative", "unit"}, rows);
}

std::map<std::string, double> derivatives_of(const SceneGradient& g) {
  std::map<std::string, double> all;
  for (const SceneGradient::Entry& e : g.entries) all[e.parameter] = e.derivative;
  return all;
}

std::vector<std::string> names_of(const SceneGradient& g) {
  std::vector<std::string> names;
  for (const SceneGradient::Entry& e : g.entries) names.push_back(e.parameter);
  return names;
}

}  // namespace

SceneMeasure scene_measure(const SceneEquilibrium& eq, const MeasureTable& table) {
  const auto [system, index] = place_of_rod(eq, table.rod);
  const What what = std::find_if(std::begin(whats), std::end(whats), [&](const auto& w) { return table.what == w.first; })->second;
  if (what == What::gap) return clearance_measure(eq, table.rod, table.to.empty() ? -1 : eq.obstacle(table.to));
  const SolvedRod& rod = eq.rod(table.rod);
  SceneMeasure out{table.rod + ": " + table.what, system, {}};
  out.measure.what = what;
  out.measure.rod = index;
  out.measure.at = place_on(rod, table.at);
  out.measure.along = table.along;
  if (out.measure.at < 0 || out.measure.at > rod.problem.rod.length)
    throw UsageError("equilibrium:gradient: at = " + plain_number(out.measure.at) + " m lies outside '" + table.rod + "' (0 to " +
                     plain_number(rod.problem.rod.length) + " m)");
  out.name += " at " + quantity(out.measure.at, "m");
  return out;
}

const Kind& Value<MeasureTable>::kind() {
  static const Kind kind{"a table {rod =, what =, at =, along =}",
                         "{rod: string, what: string, at: number|string?, along: vec?, to: string?}",
                         [](lua_State* L, int index) { return lua_istable(L, index) ? std::string() : describe(L, index); }};
  return kind;
}

MeasureTable Value<MeasureTable>::read(lua_State* L, int index) {
  static const std::string who = "equilibrium:gradient: measure";
  const Options o(L, lua_absindex(L, index), measure_options(), who);
  MeasureTable table;
  table.rod = o.get<std::string>("rod");
  table.what = o.get<std::string>("what");
  if (!o.has("at") && table.what != "clearance") throw UsageError(who + ": 'at' is missing: where on the rod?");
  if (o.has("at")) table.at = o.get<std::variant<std::string, double>>("at");
  if (o.has("along")) table.along = o.get<Vec3>("along");
  table.to = o.maybe<std::string>("to").value_or("");
  return table;
}

SceneGradient gradient_of(lua_State* L, const std::shared_ptr<SceneEquilibrium>& eq, const MeasureArgument& measure,
                          const std::vector<std::string>& parameters) {
  const std::vector<SceneParameter> by = named_parameters(*eq, parameters);
  SceneSensitivity sensitivity(*eq);
  if (const Function* function = std::get_if<Function>(&measure)) {
    const auto call = [&](const SceneEquilibrium& at) {
      return function->call<double>(L, "equilibrium:gradient: measure", std::make_shared<SceneEquilibrium>(at));
    };
    return sensitivity.gradient(call, by, run_context(L));
  }
  const std::string* name = std::get_if<std::string>(&measure);
  return sensitivity.gradient(name ? named_measure(*eq, *name) : scene_measure(*eq, std::get<MeasureTable>(measure)), by, run_context(L));
}

void bind_gradient(lua_State* L) {
  Class<SceneGradient>(L, "Derivatives of a measure, by parameter: g[\"hose.length\"]")
      .property("ok", "", "The derivatives exist", [](const SceneGradient& g) { return g.ok; })
      .property("message", "", "Why they do not", [](const SceneGradient& g) { return g.message; })
      .property("measure", "", "Its name", [](const SceneGradient& g) { return g.measure; })
      .property("value", "", "Of the measure, in its SI unit", [](const SceneGradient& g) { return g.value; })
      .property("unit", "", "Of the measure", [](const SceneGradient& g) { return g.unit; })
      .property("parameters", "", "Names, in the order asked for", names_of)
      .property("derivatives", "", "By name, in SI units", derivatives_of)
      .members(names_of, [](const SceneGradient& g, const std::string& name) {
        std::optional<double> found;
        for (const SceneGradient::Entry& e : g.entries)
          if (e.parameter == name) found = e.derivative;
        return found;
      })
      .tostring(describe_gradient);
}

}  // namespace tendril::lua
