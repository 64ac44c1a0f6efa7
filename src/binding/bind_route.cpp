// method.route: a flexible object from connection to connection, in equilibrium under gravity.
#include <cmath>
#include <limits>
#include <map>

#include "base/units.h"
#include "binding/bind_mesh.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/clearance_value.h"
#include "binding/route_chart.h"
#include "binding/route_classes.h"
#include "binding/scene_classes.h"
#include "method/route/pareto_front.h"

namespace tendril::lua {
namespace {

using OneOrMany = std::variant<std::map<std::string, double>, std::vector<std::map<std::string, double>>>;

route::Weights weights_of(const Options& o, const std::map<std::string, double>& given) {
  const CostWeights weights = cost_weights(o, given);
  return {weights.length, weights.clearance};
}

}  // namespace

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
             option<int>("clips", "", "That may be added where a restart does not help, at most; as few as hold it along its route").at_least(0).at_most(50).preset(0),
             option<double>("min_length", "m", "Least length").at_least(0).preset(0),
             option<double>("max_length", "m", "Largest length").above(0),
         } +
         refinement_schema();
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

namespace {

std::string weights_text(const route::Weights& w) { return plain_number(w.length) + " : " + plain_number(w.clearance); }

/// In equilibrium, else of the nominal route; m.
double bend_radius_of(const route::Route& route) {
  return route.refined.equilibrium ? route.refined.min_bend_radius : route.nominal.curve().min_bend_radius();
}

std::string describe_routes(const route::Result& r) {
  Card card("routes");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  if (r.routes.empty()) return card.text();
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.routes.size(); ++i) {
    const route::Route& route = r.routes[i];
    const routing::RefinementResult& refined = route.refined;
    rows.push_back({std::to_string(i + 1), weights_text(route.weights), quantity(route.nominal_length, "m"), quantity(route.design.rod.length, "m"),
                    quantity(bend_radius_of(route), "m"), std::isfinite(route.clearance()) ? quantity(route.clearance(), "m") : "none near",
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

/// In equilibrium where there is one, else nominal.
ClearanceValue clearance_of_route(const RouteHandle& h) {
  const route::Route& route = h.route();
  if (route.refined.equilibrium && !route.refined.equilibrium->rods.empty()) {
    const SceneEquilibrium& eq = *route.refined.equilibrium;
    return clearance_value(eq, eq.rods.front(), route.refined.clearance);
  }
  const routing::CurveGap& gap = route.nominal_clearance.gap;
  const bool near = !route.nominal_clearance.to.empty();
  return {{near ? gap.value : std::numeric_limits<double>::infinity(), gap.s, gap.at, gap.on, gap.obstacle}, route.nominal_clearance.to,
          near ? h.result->space->surroundings().clearance(gap.obstacle) : 0, false};
}

/// Arc length and frame of each clip.
std::vector<Frame> clips_of(const RouteHandle& h) {
  std::vector<Frame> frames;
  for (const Hold& clip : h.route().design.clips) frames.push_back(clip.frame);
  return frames;
}

std::vector<double> clip_places_of(const RouteHandle& h) {
  std::vector<double> places;
  for (const Hold& clip : h.route().design.clips) places.push_back(clip.at);
  return places;
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
      .property("min_bend_radius", "m", "In equilibrium, else of the nominal route", [](const RouteHandle& h) { return bend_radius_of(h.route()); })
      .property("clearance", "m", "Smallest gap outside the free ends, with .at, .on, .s; in equilibrium, else of the nominal route", clearance_of_route)
      .property("preference", "m", "What clearance and preferences add to the length in its objective", [](const RouteHandle& h) {
        return h.route().objective - (h.route().refined.equilibrium ? h.route().length() : h.route().nominal_length);
      })
      .property("mesh", "", "Its surface in equilibrium, else of the nominal route: to save, or to place as an obstacle for the next object",
                [](const RouteHandle& h) {
                  return make_mesh_value(route::surface_of(h.route(), 2 * h.result->options.space.radius));
                })
      .property("clips", "", "Frames of the clips that hold it, from start to finish", clips_of)
      .property("clip_places", "m", "Arc lengths of the clips", clip_places_of)
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
      .property("front", "", "Those that no other one beats in both length and clearance, by rising length", [](const RoutesHandle& r) {
        std::vector<RouteHandle> front;
        for (const int i : route::pareto_front(r.result->routes)) front.push_back({r.result, i});
        return front;
      })
      .method("chart", {.options = {option<std::string>("title", "", "Above it; default: \"Routes: length against clearance\"")},
                        .does = "Clearance over length of all alternatives, with the line of those that no other one beats in both.",
                        .example = example + "print(routes:chart())"},
              [](const RoutesHandle& r, const Options& o) {
                return front_chart(*r.result, o.maybe<std::string>("title").value_or("Routes: length against clearance"));
              })
      .list([](const RoutesHandle& r) { return r.result->routes.size(); },
            [](const RoutesHandle& r, std::size_t i) { return RouteHandle{r.result, static_cast<int>(i)}; })
      .tostring([](const RoutesHandle& r) { return describe_routes(*r.result); });
}

void add_route_to(Module& method) {
  method.function("route",
                  {.takes = {"scene"}, .options = route_schema() + method_schema(),
                   .does = "A flexible object from one frame to another: a reference design of least cost that keeps what is demanded in equilibrium.",
                   .example = example + "print(routes.ok, #routes)  --> true\t1"},
                  [](lua_State* state, const Scene& scene, const Options& o) {
                    return RoutesHandle{std::make_shared<const route::Result>(route::run(scene, route_options(o), method_context(state, o)))};
                  });
}

}  // namespace tendril::lua
