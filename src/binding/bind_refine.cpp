// method.refine: the adjustable parameters of a design, so that its equilibrium keeps what is demanded at the least cost.
#include <algorithm>

#include "base/nearest_name.h"
#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/method_options.h"
#include "binding/route_classes.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using routing::Adjust;
using routing::RefinementResult;
using routing::Unmet;

const std::vector<std::pair<std::string, bool Adjust::*>>& adjustable() {
  static const std::vector<std::pair<std::string, bool Adjust::*>> all{
      {"length", &Adjust::length},       {"from.turn", &Adjust::from_turn}, {"to.turn", &Adjust::to_turn},
      {"from.tilt", &Adjust::from_tilt}, {"to.tilt", &Adjust::to_tilt},     {"clips", &Adjust::clips}};
  return all;
}

Adjust adjust_of(const Options& o) {
  Adjust adjust;
  if (!o.has("adjust")) return adjust;
  adjust.length = false;
  std::vector<std::string> names;
  for (const auto& [name, member] : adjustable()) names.push_back(name);
  for (const std::string& wanted : o.get<std::vector<std::string>>("adjust")) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) throw UsageError(o.who() + ": 'adjust': unknown " + unknown_name(wanted, "parameters", names));
    adjust.*adjustable()[found - names.begin()].second = true;
  }
  return adjust;
}

Schema refine_schema() {
  return Schema{
             option<Rod>("rod", "", "The design to refine").required(),
             option<Frame>("from", "", "Where its start is held").required(),
             option<Frame>("to", "", "Where its finish is held").required(),
             option<Curve>("route", "", "Roughly where it runs: the first guess, which decides the passage"),
             option<double>("min_bend_radius", "m", "Of the centre line in equilibrium").at_least(0).preset(0),
             option<double>("clearance", "m", "Least gap to every obstacle; an obstacle's own larger one stands").at_least(0).preset(0),
             option<double>("free_ends", "m", "Length at both ends within which no gap is asked for").at_least(0).preset(0),
             option<double>("length_weight", "", "What a metre of the object costs").above(0).preset(1),
             option<double>("clearance_weight", "", "What a metre next to an obstacle costs more").at_least(0).preset(0),
             option<double>("range", "m", "Gap from which on that counts no more").above(0).preset(0.1),
             option<double>("min_length", "m", "Least length").at_least(0),
             option<double>("max_length", "m", "Largest length").above(0),
             option<int>("clips", "", "That may be added where no adjustment helps, at most").at_least(0).at_most(50).preset(0),
         } +
         refinement_schema() + method_schema();
}

RefinedHandle refine(lua_State* L, const Scene& scene, const Options& o) {
  routing::Design design;
  design.rod = o.get<Rod>("rod");
  design.from = o.get<Frame>("from");
  design.to = o.get<Frame>("to");
  if (const Curve* route = o.find<Curve>("route")) design.route = *route;
  routing::RefinementOptions options = refinement_options(o);
  options.min_bend_radius = o.get<double>("min_bend_radius");
  options.clearance = o.get<double>("clearance");
  options.free_ends = o.get<double>("free_ends");
  options.length_weight = o.get<double>("length_weight");
  options.clearance_weight = o.get<double>("clearance_weight");
  options.range = o.get<double>("range");
  options.min_length = o.maybe<double>("min_length");
  options.max_length = o.maybe<double>("max_length");
  options.most_clips = o.get<int>("clips");
  return {std::make_shared<const RefinementResult>(routing::refine(scene, design, options, method_context(L, o)))};
}

std::string describe(const RefinementResult& r) {
  Card card("refined design");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message);
  card.row("length", r.design.rod.length, "m").row("settled length", r.settled_length, "m").row("objective", r.objective, "m");
  card.row("min bend radius", r.min_bend_radius, "m", "at s = " + quantity(r.min_bend_radius_at, "m"));
  if (!r.clearance_to.empty())
    card.row("clearance", r.clearance.value, "m", "to '" + r.clearance_to + "' at s = " + quantity(r.clearance.s, "m"));
  if (!r.design.clips.empty()) card.row("clips", std::to_string(r.design.clips.size()));
  for (const routing::Adjusted& a : r.adjusted) card.row(a.name, quantity(a.after, a.unit), "was " + quantity(a.before, a.unit));
  for (const Unmet& u : r.unmet) card.row("not kept", u.text);
  card.row("equilibria", std::to_string(r.evaluations)).row("time", r.seconds, "s");
  return card.text();
}

std::optional<ClearanceValue> clearance_in(const RefinementResult& r) {
  if (!r.equilibrium || r.equilibrium->rods.empty()) return std::nullopt;
  ClearanceValue value{r.clearance, r.clearance_to, 0, false};
  for (const Unmet& u : r.unmet)
    if (u.what == Unmet::What::clearance) value.too_close = true;
  return value;
}

const std::string example =
    "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:obstacle(\"floor\", scene.box{size = {4, 4, 0.1}}, {pose = frame{at = {0, 0, -0.25}, along = {0, 0, 1}}})\n"
    "local hose = rod.new{length = 0.6, section = rod.section{outer = 0.02, inner = 0.012, material = rubber}}\n"
    "local r = method.refine(s, {rod = hose, min_bend_radius = 0.06, clearance = 0.02,\n"
    "                            from = frame{at = {0, 0, 0}, along = {0, 0, -1}, up = {0, 1, 0}},\n"
    "                            to = frame{at = {0.3, 0, 0}, along = {0, 0, 1}, up = {0, 1, 0}}})\n";

}  // namespace

Schema refinement_schema() {
  return {
      option<std::vector<std::string>>("adjust", "", "What may be adjusted: \"length\", \"from.turn\", \"to.turn\", \"from.tilt\", \"to.tilt\", "
                                                     "\"clips\"; default: the length"),
      option<std::string>("solver", "", "By exact gradients, or without any as in the paper").one_of({"gradient", "gradient_free"}).preset("gradient"),
      option<double>("max_tension", "N", "In equilibrium").above(0),
      option<double>("max_strain", "", "In equilibrium").above(0),
      option<double>("max_turn", "rad", "Of a connection about its tangent, either way").above(0).preset(3.0),
      option<double>("max_tilt", "rad", "Of a connection about each axis normal to it, either way").above(0).preset(0.25),
      option<double>("clip_reach", "m", "How near an obstacle must be to fasten a clip to it").above(0).preset(0.05),
  };
}

routing::RefinementOptions refinement_options(const Options& o) {
  routing::RefinementOptions options;
  options.adjust = adjust_of(o);
  options.solver = o.get<std::string>("solver") == "gradient" ? routing::RefinementSolver::gradient : routing::RefinementSolver::gradient_free;
  if (o.has("max_tension")) options.max_tension = o.get<double>("max_tension");
  if (o.has("max_strain")) options.max_strain = o.get<double>("max_strain");
  options.max_turn = o.get<double>("max_turn");
  options.max_tilt = o.get<double>("max_tilt");
  options.clip_reach = o.get<double>("clip_reach");
  return options;
}

void bind_refine(lua_State* L) {
  Class<routing::Adjusted>(L, "One parameter before and after refinement")
      .property("name", "", "\"length\", \"from.turn\" ...", [](const routing::Adjusted& a) { return a.name; })
      .property("unit", "", "m or rad", [](const routing::Adjusted& a) { return a.unit; })
      .property("before", "", "Value given", [](const routing::Adjusted& a) { return a.before; })
      .property("after", "", "Value found", [](const routing::Adjusted& a) { return a.after; })
      .tostring([](const routing::Adjusted& a) { return a.name + ": " + quantity(a.before, a.unit) + " -> " + quantity(a.after, a.unit); });
  Class<Unmet>(L, "A demand that is not kept in equilibrium")
      .property("value", "", "What it is", [](const Unmet& u) { return u.value; })
      .property("demanded", "", "What was demanded", [](const Unmet& u) { return u.demanded; })
      .property("s", "m", "Arc length where", [](const Unmet& u) { return u.s; })
      .property("at", "m", "Place on the centre line", [](const Unmet& u) { return u.at; })
      .property("text", "", "In words", [](const Unmet& u) { return u.text; })
      .tostring([](const Unmet& u) { return u.text; });
  Class<RefinedHandle>(L, "A refined design and its equilibrium")
      .property("ok", "", "All that is demanded is kept, in a stable equilibrium", [](const RefinedHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const RefinedHandle& h) { return name_of(h.result->status); })
      .property("message", "", "What there is to say about it", [](const RefinedHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const RefinedHandle& h) { return h.result->seconds; })
      .property("evaluations", "", "Equilibria that were looked at", [](const RefinedHandle& h) { return h.result->evaluations; })
      .property("rod", "", "The refined design", [](const RefinedHandle& h) { return h.result->design.rod; })
      .property("from", "", "Frame of its start", [](const RefinedHandle& h) { return h.result->design.from; })
      .property("to", "", "Frame of its finish", [](const RefinedHandle& h) { return h.result->design.to; })
      .property("equilibrium", "", "Of this rod alone, called \"route\"; nil: there was none",
                [](const RefinedHandle& h) { return std::const_pointer_cast<SceneEquilibrium>(h.result->equilibrium); })
      .property("objective", "m", "What it costs", [](const RefinedHandle& h) { return h.result->objective; })
      .property("settled_length", "m", "Of the centre line in equilibrium", [](const RefinedHandle& h) { return h.result->settled_length; })
      .property("min_bend_radius", "m", "In equilibrium", [](const RefinedHandle& h) { return h.result->min_bend_radius; })
      .property("min_bend_radius_at", "m", "Arc length where", [](const RefinedHandle& h) { return h.result->min_bend_radius_at; })
      .property("clearance", "m", "Smallest gap outside the free ends, with .at, .on, .s", [](const RefinedHandle& h) { return clearance_in(*h.result); })
      .property("adjusted", "", "Each parameter before and after", [](const RefinedHandle& h) { return h.result->adjusted; })
      .property("unmet", "", "Demands that are not kept, the worst first", [](const RefinedHandle& h) { return h.result->unmet; })
      .tostring([](const RefinedHandle& h) { return describe(*h.result); });
}

void add_refine_to(Module& method) {
  method.function("refine",
                  {.takes = {"scene"}, .options = refine_schema(),
                   .does = "Adjusts a design (length, turning of its connections, clips), so that its equilibrium keeps what is demanded at the least cost.",
                   .example = example + "print(r.ok, r.rod.length < 0.6)  --> true\ttrue"},
                  refine);
}

}  // namespace tendril::lua
