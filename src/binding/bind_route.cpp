// method.route: a flexible object from connection to connection, in equilibrium under gravity.
#include <map>

#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/route_classes.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using OneOrMany = std::variant<std::map<std::string, double>, std::vector<std::map<std::string, double>>>;

Schema route_schema() {
  return routing_schema() +
         Schema{
             option<bool>("preformed", "", "The route becomes the unstressed shape; else the object is straight without load").preset(false),
             option<OneOrMany>("weights", "", "{length =, clearance =}: what a metre costs, and what it costs more next to obstacles; a list "
                                              "gives an alternative for each"),
             option<double>("grid", "m", "Step of the search").above(0).at_most(1).preset(20 * units::mm),
             option<int>("segments", "", "Elements of the rod; default by the bend radius").at_least(1),
             option<bool>("refine", "", "Adjust the design in equilibrium under gravity; else only the nominal route").preset(true),
             option<int>("restarts", "", "From routes with bend radius and clearance in reserve, where refinement fails").at_least(0).at_most(20).preset(3),
             option<int>("clips", "", "That may be added where restarts do not help, at most").at_least(0).at_most(50).preset(0),
             option<double>("min_length", "m", "Least length").at_least(0).preset(0),
             option<double>("max_length", "m", "Largest length").above(0),
         } +
         refinement_schema() + method_schema();
}

route::Weights weights_of(const Options& o, const std::map<std::string, double>& given) {
  route::Weights weights;
  for (const auto& [name, value] : given) {
    if (name == "length") weights.length = value;
    else if (name == "clearance") weights.clearance = value;
    else throw UsageError(o.who() + ": 'weights': unknown name '" + name + "', expected 'length' and 'clearance'");
  }
  return weights;
}

route::Options route_options(const Options& o) {
  route::Options options;
  options.from = o.get<Frame>("from");
  options.to = o.get<Frame>("to");
  if (const auto section = routed_section(o)) options.section = *section;
  else throw UsageError(o.who() + ": 'section' is missing: gravity bends the object by what it is made of");
  options.preformed = o.get<bool>("preformed");
  options.space = space_demands(o);
  options.curve = pcc_demands(o);
  options.curve.min_length = o.get<double>("min_length");
  if (o.has("max_length")) options.curve.max_length = o.get<double>("max_length");
  if (o.has("weights")) {
    const OneOrMany weights = o.get<OneOrMany>("weights");
    options.weights.clear();
    if (const auto* one = std::get_if<0>(&weights)) options.weights.push_back(weights_of(o, *one));
    else
      for (const auto& each : std::get<1>(weights)) options.weights.push_back(weights_of(o, each));
  }
  options.grid = o.get<double>("grid");
  options.segments = o.maybe<int>("segments").value_or(0);
  options.refine = o.get<bool>("refine");
  options.restarts = o.get<int>("restarts");
  options.max_clips = o.get<int>("clips");
  options.refinement = refinement_options(o);
  return options;
}

std::string weights_text(const route::Weights& w) { return plain_number(w.length) + " : " + plain_number(w.clearance); }

std::string describe_routes(const route::Result& r) {
  Card card("routes");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  if (r.routes.empty()) return card.text();
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.routes.size(); ++i) {
    const route::Route& route = r.routes[i];
    const routing::RefinementResult& refined = route.refined;
    const bool settled = refined.equilibrium != nullptr;
    rows.push_back({std::to_string(i + 1), weights_text(route.weights), quantity(route.nominal_length, "m"), quantity(route.design.rod.length, "m"),
                    settled ? quantity(refined.min_bend_radius, "m") : "", settled && !refined.clearance_to.empty() ? quantity(refined.clearance.value, "m") : "",
                    std::to_string(route.design.clips.size()), route.ok ? "kept" : refined.unmet.empty() ? refined.message : refined.unmet.front().text});
  }
  return card.text() + "\n" +
         table_text({"route", "length : clearance", "nominal", "length", "min bend radius", "clearance", "clips", "demands"}, rows);
}

std::string describe_route(const RouteHandle& h) {
  const route::Route& route = h.route();
  Card card("route " + std::to_string(h.index + 1));
  card.row("weights", weights_text(route.weights), route.restarts ? "after " + std::to_string(route.restarts) + " restarts" : "");
  card.row("nominal length", route.nominal_length, "m", std::to_string(route.nominal.bends()) + " bends");
  card.row("length", route.design.rod.length, "m").row("objective", route.objective, "m");
  return card.text();
}

RefinedHandle refined(const RouteHandle& h) { return {std::shared_ptr<const routing::RefinementResult>(h.result, &h.route().refined)}; }

const std::string example =
    "local mm = units.mm\n"
    "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:obstacle(\"post\", scene.cylinder{radius = 40*mm, length = 1}, {clearance = 5*mm})\n"
    "local routes = method.route(s, {from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},\n"
    "  section = rod.section{outer = 20*mm, inner = 12*mm, material = rubber}, min_bend_radius = 50*mm,\n"
    "  preformed = true, end_straight = 20*mm})\n";

void bind_one_route(lua_State* L) {
  Class<RouteHandle>(L, "One design of a flexible object: nominal, and refined in equilibrium")
      .property("ok", "", "Keeps all that is demanded", [](const RouteHandle& h) { return h.route().ok; })
      .property("rod", "", "As a design for scene:rod", [](const RouteHandle& h) { return h.route().design.rod; })
      .property("from", "", "Frame of its start", [](const RouteHandle& h) { return h.route().design.from; })
      .property("to", "", "Frame of its finish", [](const RouteHandle& h) { return h.route().design.to; })
      .property("nominal", "", "The nominal route", [](const RouteHandle& h) { return h.route().nominal.curve(); })
      .property("nominal_length", "m", "Of the nominal route", [](const RouteHandle& h) { return h.route().nominal_length; })
      .property("length", "m", "Of the rod, unstressed", [](const RouteHandle& h) { return h.route().design.rod.length; })
      .property("objective", "m", "What it costs", [](const RouteHandle& h) { return h.route().objective; })
      .property("weights", "", "It was routed with", [](const RouteHandle& h) {
        return std::map<std::string, double>{{"length", h.route().weights.length}, {"clearance", h.route().weights.clearance}};
      })
      .property("restarts", "", "That it took", [](const RouteHandle& h) { return h.route().restarts; })
      .property("refined", "", "Its refinement", refined)
      .property("equilibrium", "", "Settled; nil: none was asked for, or found",
                [](const RouteHandle& h) { return std::const_pointer_cast<SceneEquilibrium>(h.route().refined.equilibrium); })
      .property("min_bend_radius", "m", "In equilibrium", [](const RouteHandle& h) { return h.route().refined.min_bend_radius; })
      .tostring(describe_route);
}

}  // namespace

void bind_route(lua_State* L) {
  bind_one_route(L);
  Class<RoutesHandle>(L, "Routes, those that keep all first: #routes, routes[i]")
      .property("ok", "", "At least one route keeps all that is demanded", [](const RoutesHandle& r) { return r.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"cancelled\", \"timeout\"", [](const RoutesHandle& r) { return name_of(r.result->status); })
      .property("message", "", "How many, or what stood in the way", [](const RoutesHandle& r) { return r.result->message; })
      .property("seconds", "s", "Run time", [](const RoutesHandle& r) { return r.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const RoutesHandle& r) { return r.result->steps; })
      .list([](const RoutesHandle& r) { return r.result->routes.size(); },
            [](const RoutesHandle& r, std::size_t i) { return RouteHandle{r.result, static_cast<int>(i)}; })
      .tostring([](const RoutesHandle& r) { return describe_routes(*r.result); });
}

void add_route_to(Module& method) {
  method.function("route",
                  {.takes = {"scene"}, .options = route_schema(),
                   .does = "A flexible object from one frame to another: a reference design of least cost that keeps what is demanded in equilibrium.",
                   .example = example + "print(routes.ok, #routes)  --> true\t1"},
                  [](lua_State* state, const Scene& scene, const Options& o) {
                    return RoutesHandle{std::make_shared<const route::Result>(route::run(scene, route_options(o), method_context(state, o)))};
                  });
}

}  // namespace tendril::lua
