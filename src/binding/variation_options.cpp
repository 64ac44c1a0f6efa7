#include "binding/variation_options.h"

#include <algorithm>

#include "base/error.h"
#include "binding/method_options.h"
#include "binding/solve_options.h"

namespace tendril::lua {

/// How one variable varies; its name is the key that it stands under.
struct VaryTable {
  variation::Variable variable;
};

/// Variables that depend on each other: {"hose.length", "tee.length", correlation = 0.8}.
struct TogetherTable {
  variation::Group group;
};

namespace {

using Spread = variation::Spread;
using SpreadOption = std::variant<std::string, Function>;
using Correlation = std::variant<double, std::vector<std::vector<double>>>;
using MeasureEntry = std::variant<std::string, Function, MeasureTable>;

const std::vector<std::string> spreads{"normal", "uniform", "triangular"};  // in the order of Spread
const std::vector<std::string> samplings{"random", "sobol", "latin"};       // in the order of Sampling

const Schema& vary_options() {
  static const Schema schema{
      option<double>("tolerance", "", "Of a number, to both sides, in its SI unit; or a share of it, see relative").at_least(0),
      option<bool>("relative", "", "tolerance and sigma are shares of the nominal value").preset(false),
      option<double>("ball", "m", "Radius within which a frame may be").at_least(0),
      option<Vec3>("box", "m", "Half sides along x, y and z within which a frame may be"),
      option<double>("cone", "rad", "Half angle about the section normal, or about gravity").at_least(0),
      option<double>("twist", "rad", "About the section normal, to both sides").at_least(0),
      option<SpreadOption>("spread", "", "\"normal\" (the tolerance is three standard deviations), \"uniform\", \"triangular\", or a "
                                         "function that gives the deviation below which a share 0 ... 1 of all outcomes lies"),
      option<double>("sigma", "", "Standard deviation, instead of a third of the tolerance").at_least(0),
      option<std::vector<double>>("values", "", "The number itself in every outcome, one after the other"),
      option<std::vector<Frame>>("frames", "", "The frame itself in every outcome: a motion"),
  };
  return schema;
}

const Schema& together_options() {
  static const Schema schema =
      Schema{option<Correlation>("correlation", "", "Between any two of them, or a symmetric matrix").required()}.with_list(
          Value<std::string>::kind(), "variables", "Names as in vary");
  return schema;
}

std::string wrong_table(lua_State* L, int index) { return lua_istable(L, index) ? std::string() : describe(L, index); }

void read_spread(lua_State* L, const Options& o, variation::Variable& out) {
  const SpreadOption spread = o.get<SpreadOption>("spread");
  if (const Function* function = std::get_if<Function>(&spread)) {
    out.spread = Spread::function;
    // The study may ask again when the call that made it has returned, from another coroutine.
    Context* const here = &context(L);
    out.inverse = [here, function = *function](double share) {
      return function.call<double>(here->running.load(), "method.variation: spread", share);
    };
    return;
  }
  const std::string& name = std::get<std::string>(spread);
  const auto found = std::find(spreads.begin(), spreads.end(), name);
  if (found == spreads.end())
    throw UsageError("method.variation: spread = \"" + name + "\", expected \"normal\", \"uniform\", \"triangular\" or a function");
  out.spread = static_cast<Spread>(found - spreads.begin());
}

Eigen::MatrixXd matrix_of(const Correlation& correlation) {
  if (const double* one = std::get_if<double>(&correlation)) return Eigen::MatrixXd::Constant(1, 1, *one);
  const auto& rows = std::get<std::vector<std::vector<double>>>(correlation);
  Eigen::MatrixXd matrix(rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != rows.size())
      throw UsageError("method.variation: together: row " + std::to_string(i + 1) + " of the correlation has " +
                       std::to_string(rows[i].size()) + " numbers, expected " + std::to_string(rows.size()));
    for (std::size_t j = 0; j < rows.size(); ++j) matrix(i, j) = rows[i][j];
  }
  return matrix;
}

}  // namespace

template <>
struct Value<VaryTable> {
  static const Kind& kind() {
    static const Kind kind{"a tolerance or a table {tolerance =, ...}",
                           "number|{tolerance: number?, relative: boolean?, ball: number?, box: vec?, cone: number?, twist: number?, "
                           "spread: string|function?, sigma: number?, values: number[]?, frames: frame[]?}",
                           [](lua_State* L, int index) {
                             return lua_isnumber(L, index) ? Value<double>::kind().wrong(L, index) : wrong_table(L, index);
                           }};
    return kind;
  }
  static VaryTable read(lua_State* L, int index) {
    VaryTable out;
    variation::Variable& v = out.variable;
    if (lua_isnumber(L, index)) {
      v.tolerance = lua_tonumber(L, index);
      return out;
    }
    static const std::string who = "method.variation: vary";
    const Options o(L, lua_absindex(L, index), vary_options(), who);
    v.tolerance = o.maybe<double>("tolerance");
    v.relative = o.get<bool>("relative");
    v.ball = o.maybe<double>("ball");
    v.box = o.maybe<Vec3>("box");
    v.cone = o.maybe<double>("cone");
    v.twist = o.maybe<double>("twist");
    v.sigma = o.maybe<double>("sigma");
    if (o.has("spread")) read_spread(L, o, v);
    if (o.has("values")) v.numbers = o.get<std::vector<double>>("values");
    if (o.has("frames")) v.frames = o.get<std::vector<Frame>>("frames");
    return out;
  }
};

template <>
struct Value<TogetherTable> {
  static const Kind& kind() {
    static const Kind kind{"a table {name, name, ..., correlation =}", "{[integer]: string, correlation: number|number[][]}", &wrong_table};
    return kind;
  }
  static TogetherTable read(lua_State* L, int index) {
    static const std::string who = "method.variation: together";
    const Options o(L, lua_absindex(L, index), together_options(), who);
    return {{o.list<std::string>(), matrix_of(o.get<Correlation>("correlation"))}};
  }
};

/// {"hose.clearance", gap = function(eq) ... end}: measures by their own names, and under given ones.
struct MeasureList {
  std::vector<std::pair<std::string, MeasureEntry>> entries;
};

template <>
struct Value<MeasureList> {
  static const Kind& kind() {
    static const Kind kind{"a table of measures: names in a list, or {name = a measure's name, a function or a table}",
                           "table<integer|string, string|function|{rod: string, what: string, at: number|string?, along: vec?, to: string?}>",
                           &wrong};
    return kind;
  }
  static std::string wrong(lua_State* L, int index) {
    if (!lua_istable(L, index)) return describe(L, index);
    index = lua_absindex(L, index);
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
      const bool listed = lua_isinteger(L, -2), named = lua_type(L, -2) == LUA_TSTRING;
      const std::string key = describe(L, -2), got = (listed ? Value<std::string>::kind() : Value<MeasureEntry>::kind()).wrong(L, -1);
      if ((listed || named) && got.empty()) continue;
      lua_pop(L, 2);
      return listed || named ? "a table whose entry " + key + " is " + got : "a table with the key " + key;
    }
    return {};
  }
  static MeasureList read(lua_State* L, int index) {
    index = lua_absindex(L, index);
    MeasureList out;
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, index)); ++i) {
      lua_rawgeti(L, index, i);
      const std::string name = Value<std::string>::read(L, -1);
      out.entries.emplace_back(name, name);
      lua_pop(L, 1);
    }
    std::map<std::string, MeasureEntry> named;  // Lua's own order differs from run to run
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
      if (lua_type(L, -2) == LUA_TSTRING) named.emplace(Value<std::string>::read(L, -2), Value<MeasureEntry>::read(L, -1));
    out.entries.insert(out.entries.end(), named.begin(), named.end());
    return out;
  }
};

namespace {

variation::MeasureRequest request_of(lua_State* L, const SceneEquilibrium* nominal, const std::string& name, const MeasureEntry& entry) {
  variation::MeasureRequest request;
  request.name = name;
  if (const Function* function = std::get_if<Function>(&entry)) {
    Context* const here = &context(L);
    request.function = [here, function = *function, who = "method.variation: measure '" + name + "'"](const SceneEquilibrium& eq) {
      return function.call<double>(here->running.load(), who.c_str(), std::make_shared<SceneEquilibrium>(eq));
    };
  } else if (const auto* table = std::get_if<MeasureTable>(&entry)) {
    if (table->what == "clearance") {
      request.rod = table->rod;
      request.to = table->to;
    } else {
      request.built_in = scene_measure(*nominal, *table);
      request.built_in->name = name;
    }
  } else if (const std::string& wanted = std::get<std::string>(entry); !variation::rod_of_contact_length(wanted).empty()) {
    request.rod = variation::rod_of_contact_length(wanted);
    request.contact_length = true;
  } else if (wanted != name) {
    request.built_in = named_measure(*nominal, wanted);
    request.built_in->name = name;
  }
  return request;
}

}  // namespace

Schema variation_schema() {
  return Schema{
             option<std::map<std::string, VaryTable>>(
                 "vary", "", "Which numbers vary, by name (\"hose.length\", \"hose.from\", \"hose.section.EI\", \"gravity\", \"tee\"), and how")
                 .required(),
             option<std::vector<TogetherTable>>("together", "", "Variables that depend on each other: {{\"a.length\", \"b.length\", correlation = 0.8}}"),
             option<MeasureList>("measure", "", "What is measured on every outcome: names as in eq.measures or \"hose.contact_length\"; default: bend radius, tension, length and "
                                                "clearance of every rod"),
             option<int>("outcomes", "", "How many").at_least(1).at_most(1e8).preset(1000),
             option<std::string>("sampling", "", "How outcomes fill the space of the variables").one_of(samplings).preset("random"),
             option<int>("replicates", "", "Of Sobol' points and Latin hypercubes: independent sets, which give the intervals")
                 .at_least(2).at_most(1024).preset(8),
             option<int>("effects", "", "For so many outcomes each variable is drawn anew: total effects of the contributors").at_least(0).at_most(1e7).preset(0),
             option<std::string>("store", "", "File (SQLite) that keeps the outcomes as they come: a study that was stopped goes on there"),
             option<bool>("uniform", "", "Every variable uniform over its tolerance: for envelopes").preset(false),
         } +
         solve_schema() + method_schema();
}

variation::Options variation_options(lua_State* L, const Scene& scene, const Options& o) {
  variation::Options options;
  for (auto& [name, table] : o.get<std::map<std::string, VaryTable>>("vary")) {
    options.vary.push_back(table.variable);
    options.vary.back().name = name;
  }
  if (o.has("together"))
    for (const TogetherTable& table : o.get<std::vector<TogetherTable>>("together")) options.groups.push_back(table.group);
  options.outcomes = o.get<int>("outcomes");
  const std::string sampling = o.get<std::string>("sampling");
  options.sampling = static_cast<variation::Sampling>(std::find(samplings.begin(), samplings.end(), sampling) - samplings.begin());
  options.replicates = o.get<int>("replicates");
  options.effects = o.get<int>("effects");
  options.uniform = o.get<bool>("uniform");
  options.solve = solve_options(o);
  if (!o.has("measure")) return options;
  const MeasureList list = o.get<MeasureList>("measure");
  // Measures that are no function and have a name of their own are looked up in the scene as it stands solved.
  std::optional<SceneEquilibrium> nominal;
  for (const auto& [name, entry] : list.entries) {
    const std::string* text = std::get_if<std::string>(&entry);
    const bool lookup = std::holds_alternative<MeasureTable>(entry) ||
                        (text && *text != name && variation::rod_of_contact_length(*text).empty());
    if (lookup && !nominal) nominal = scene.solve(options.solve, run_context(L));
    options.measures.push_back(request_of(L, nominal ? &*nominal : nullptr, name, entry));
  }
  return options;
}

}  // namespace tendril::lua
