// method.route_all: several flexible objects, one after the other.
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/route_classes.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// One entry of the list: read together with what is given for all.
struct ObjectTable {};

template <>
struct Value<ObjectTable> {
  static const Kind& kind() {
    static const Kind kind{"a table {name =, from =, to =, ...}", "table",
                           [](lua_State* L, int index) { return lua_istable(L, index) ? std::string() : describe(L, index); }};
    return kind;
  }
};

namespace {

Schema object_schema() {
  return route_schema() +
         Schema{
             option<std::string>("name", "", "Of the object, and of its rod in scene()").required(),
             option<double>("apart", "m", "Least gap to the objects before it; its clearance where that is more").at_least(0).preset(0),
             option<std::string>("earlier", "", "How it likes to run beside the objects before it; counts with 'preference'")
                 .one_of({"neutral", "near", "avoid"}).preset("neutral"),
         };
}

/// Leaves a table on the stack: what is given for all, and over it what this object says itself.
void push_object(lua_State* L, int all, lua_Integer number, const Schema& schema) {
  lua_newtable(L);
  const int merged = lua_absindex(L, -1);
  const auto copy = [&](int from, bool everything) {
    for (lua_pushnil(L); lua_next(L, from); lua_pop(L, 1)) {
      if (lua_type(L, -2) != LUA_TSTRING || (!everything && !schema.find(lua_tostring(L, -2)))) continue;
      lua_pushvalue(L, -2);
      lua_pushvalue(L, -2);
      lua_rawset(L, merged);
    }
  };
  copy(all, false);  // but what concerns the whole computation
  lua_geti(L, all, number);
  copy(lua_absindex(L, -1), true);
  lua_pop(L, 1);
}

std::vector<route::ObjectToRoute> objects_of(lua_State* L, const Options& o) {
  static const Schema schema = object_schema();
  std::vector<route::ObjectToRoute> objects;
  const lua_Integer count = o.index() ? luaL_len(L, o.index()) : 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    push_object(L, o.index(), i, schema);
    const std::string who = o.who() + ": object " + std::to_string(i);
    const Options own(L, lua_absindex(L, -1), schema, who);
    route::ObjectToRoute object{own.get<std::string>("name"), route_options(own)};
    object.apart = own.get<double>("apart");
    const std::string earlier = own.get<std::string>("earlier");
    object.earlier = earlier == "near" ? Preference::near : earlier == "avoid" ? Preference::avoid : Preference::neutral;
    objects.push_back(std::move(object));
    lua_pop(L, 1);
  }
  return objects;
}

RoutesHandle routes_of(const RoutedObjectHandle& h) {
  return {std::shared_ptr<const route::Result>(h.result, &h.object().result)};
}

std::string describe_objects(const RoutedObjectsHandle& h) {
  Card card("routed objects");
  card.row("status", h.result->ok ? "solved" : name_of(h.result->status), h.result->message).row("time", h.result->seconds, "s");
  std::vector<std::vector<std::string>> rows;
  for (const route::RoutedObject& object : h.result->objects) {
    if (object.result.routes.empty()) {
      rows.push_back({object.name, "", "", "", "", object.result.message});
      continue;
    }
    const route::Route& route = object.result.routes[object.chosen];
    rows.push_back({object.name, quantity(route.length(), "m"),
                    route.refined.equilibrium ? quantity(route.refined.min_bend_radius, "m") : "", quantity(route.clearance(), "m"),
                    std::to_string(route.design.clips.size()), route.ok ? "kept" : object.result.message});
  }
  if (rows.empty()) return card.text();
  return card.text() + "\n" + table_text({"object", "length", "min bend radius", "clearance", "clips", "demands"}, rows);
}

const std::string example =
    "local mm = units.mm\n"
    "local cable = rod.section{outer = 10*mm, material = rod.material{young = 20e6, poisson = 0.4, density = 1200}}\n"
    "local s = scene.new{}\n"
    "local set = method.route_all(s, {section = cable, min_bend_radius = 40*mm, clearance = 3*mm, preformed = true, end_straight = 10*mm,\n"
    "  {name = \"feed\", from = frame{at = {-0.2, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.2, 0, 0}, along = {1, 0, 0}}},\n"
    "  {name = \"return\", from = frame{at = {0, -0.2, 0}, along = {0, 1, 0}}, to = frame{at = {0, 0.2, 0}, along = {0, 1, 0}}}})\n";

void bind_object(lua_State* L) {
  Class<RoutedObjectHandle>(L, "One of several objects that were routed in order")
      .property("name", "", "As given", [](const RoutedObjectHandle& h) { return h.object().name; })
      .property("ok", "", "Keeps all that is demanded", [](const RoutedObjectHandle& h) { return h.object().result.ok; })
      .property("routes", "", "Its alternatives, as method.route gives them", routes_of)
      .property("route", "", "The one that the objects after it keep clear of; nil: none was found",
                [](const RoutedObjectHandle& h) -> std::optional<RouteHandle> {
                  if (h.object().result.routes.empty()) return std::nullopt;
                  return RouteHandle{routes_of(h).result, h.object().chosen};
                })
      .tostring([](const RoutedObjectHandle& h) { return h.object().name + ": " + h.object().result.message; });
}

}  // namespace

void bind_route_all(lua_State* L) {
  bind_object(L);
  Class<RoutedObjectsHandle>(L, "Several objects, routed in order: #objects, objects[i]")
      .property("ok", "", "Each of them keeps all that is demanded", [](const RoutedObjectsHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"cancelled\", \"timeout\"", [](const RoutedObjectsHandle& h) { return name_of(h.result->status); })
      .property("message", "", "How many, or which one found no way, and why", [](const RoutedObjectsHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const RoutedObjectsHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each object", [](const RoutedObjectsHandle& h) { return h.result->steps; })
      .method("scene", {.does = "A new scene: the obstacles, and every object as a rod, held at its ends and clips.", .example = example + "print(set:scene())"},
              [](const RoutedObjectsHandle& h) { return std::make_shared<Scene>(route::scene_of(*h.scene, *h.result)); })
      .list([](const RoutedObjectsHandle& h) { return h.result->objects.size(); },
            [](const RoutedObjectsHandle& h, std::size_t i) { return RoutedObjectHandle{h.result, static_cast<int>(i)}; })
      .tostring(describe_objects);
}

void add_route_all_to(Module& method) {
  method.function("route_all",
                  {.takes = {"scene"},
                   .options = (object_schema() + method_schema()).all_optional().with_list(Value<ObjectTable>::kind(), "objects", "In order; named options beside them are for all of them"),
                   .does = "Several flexible objects in order, each an obstacle for those that follow; options of method.route for all or for each.",
                   .example = example + "print(set.ok, #set, set[2].route.length > 0.4)  --> true\t2\ttrue"},
                  [](lua_State* state, const std::shared_ptr<Scene>& scene, const Options& o) {
                    return RoutedObjectsHandle{std::make_shared<const route::ObjectsResult>(
                                                   route::run_in_order(*scene, objects_of(state, o), method_context(state, o))),
                                               scene};
                  });
}

}  // namespace tendril::lua
