// scene: the world. Obstacles, rods in their places, loads, and the solve.
#include "binding/bind_branch.h"
#include "binding/bind_export.h"
#include "binding/bind_import.h"
#include "binding/bind_motion.h"
#include "binding/bind_obstacle.h"
#include "binding/bind_placed_robot.h"
#include "binding/bind_scene_file.h"
#include "binding/examples.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/scene_cards.h"
#include "binding/scene_classes.h"
#include "binding/solve_options.h"
#include "scene/scene_modes.h"

namespace tendril::lua {
namespace {

using Where = std::variant<std::string, double>;

double place_of(const PlacedRod& rod, const Where& where) {
  if (const std::string* end = std::get_if<std::string>(&where)) return rod.place(*end);
  return std::get<double>(where);
}

Schema scene_options() {
  return {option<Vec3>("gravity", "m/s^2", "Acceleration in world axes; default or zero: the term is left out")};
}

Schema rod_options() {
  return {
      option<Frame>("from", "", "Where the start is held, fully; default: free"),
      option<Frame>("to", "", "Where the finish is held, fully; default: free"),
  };
}

Schema hold_options() {
  return {
      option<bool>("position", "", "The place is held").preset(true),
      option<bool>("orientation", "", "The orientation is held").preset(true),
      option<double>("turns", "", "Extra full turns about the tangent relative to the start").preset(0),
  };
}

Schema clip_options() {
  return {
      option<std::string>("kind", "", "What it holds: everything, the position only, or everything but sliding along d3")
          .one_of({"fixed", "swivel", "slide"}).preset("fixed"),
      option<double>("turns", "", "Extra full turns about the tangent relative to the start").preset(0),
  };
}

Schema load_options() {
  return {
      option<Vec3>("force", "N", "Dead force, world axes"),
      option<Vec3>("moment", "N m", "Dead moment, world axes"),
  };
}

void bind_placed_rod(lua_State* L) {
  Class<PlacedRodHandle>(L, "A rod in a scene: hold it, load it")
      .property("name", "", "Its name in the scene", [](const PlacedRodHandle& p) { return p.name; })
      .property("design", "", "What it is", [](const PlacedRodHandle& p) { return p.rod().rod(); })
      .method("hold",
              {.takes = {"where", "frame"}, .options = hold_options(),
               .does = "Holds the section at \"start\", \"finish\" or an arc length in m. At a place that is held already the "
                       "two holds must agree in what both fix; then the new one stands.",
               .example = "local s = scene.new{}\n"
                          "local m = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
                          "local p = s:rod(\"hose\", rod.new{length = 1, section = rod.section{outer = 0.02, material = m}},\n"
                          "  {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})\n"
                          "p:hold(\"finish\", frame{at = {0.9, 0, 0}, along = {1, 0, 0}}, {orientation = false})"},
              [](std::shared_ptr<PlacedRodHandle> p, const Where& where, const Frame& frame, const Options& o) {
                Hold hold;
                hold.at = place_of(p->rod(), where);
                hold.frame = frame;
                hold.position = o.get<bool>("position");
                hold.orientation = o.get<bool>("orientation");
                hold.turns = o.get<double>("turns");
                p->rod().hold(hold);
                return p;
              })
      .method("clip",
              {.takes = {"where", "frame"}, .options = clip_options(),
               .does = "A clip at \"start\", \"finish\" or an arc length in m. Through a slide clip the rod slips without friction "
                       "along d3: the arc length is where the search begins, and the equilibrium tells where it settles.",
               .example = with_hose("p:clip(0.5, frame{at = {0.45, 0, -0.1}, along = {1, 0, 0}}, {kind = \"slide\"})\n"
                                    "print(s:solve{}:rod(\"hose\").supports[3].s)")},
              [](std::shared_ptr<PlacedRodHandle> p, const Where& where, const Frame& frame, const Options& o) {
                Hold hold;
                hold.at = place_of(p->rod(), where);
                hold.frame = frame;
                hold.orientation = o.get<std::string>("kind") != "swivel";
                hold.slide = o.get<std::string>("kind") == "slide";
                hold.turns = o.get<double>("turns");
                p->rod().hold(hold);
                return p;
              })
      .method("release", {.takes = {"where"}, .does = "Removes the hold at a place.",
                         .example = with_hose("p:release(\"finish\")")},
              [](std::shared_ptr<PlacedRodHandle> p, const Where& where) {
                p->rod().release(place_of(p->rod(), where));
                return p;
              })
      .method("load",
              {.takes = {"where"}, .options = load_options(),
               .does = "Adds a dead load (constant in world axes) at \"start\", \"finish\" or an arc length in m.",
                         .example = with_hose("p:load(0.5, {force = {0, 0, -2}})")},
              [](std::shared_ptr<PlacedRodHandle> p, const Where& where, const Options& o) {
                if (!o.has("force") && !o.has("moment"))
                  throw UsageError("placed_rod:load: give 'force', 'moment' or both");
                PointLoad load;
                load.at = place_of(p->rod(), where);
                load.force = o.maybe<Vec3>("force").value_or(Vec3::Zero());
                load.moment = o.maybe<Vec3>("moment").value_or(Vec3::Zero());
                p->rod().load(load);
                return p;
              })
      .method("unload", {.does = "Removes all its loads.",
                         .example = with_hose("p:load(0.5, {force = {0, 0, -2}}):unload()")},
              [](std::shared_ptr<PlacedRodHandle> p) {
                p->rod().unload();
                return p;
              })
      .tostring([](const PlacedRodHandle& p) { return describe_placed(p.rod()); });
}

SceneEquilibrium solved(lua_State* L, const Scene& scene, const Options& o) {
  const SceneEquilibrium* from = o.find<SceneEquilibrium>("from");
  SceneEquilibrium found = scene.solve(solve_options(o), run_context(L, o), from);
  if (o.get<bool>("modes")) find_modes(found, solve_options(o), run_context(L, o));
  return found;
}

std::vector<std::string> rod_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& rod : scene.rods()) names.push_back(rod->name());
  return names;
}

std::vector<std::string> obstacle_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const PlacedObstacle& obstacle : scene.obstacles()) names.push_back(obstacle.name);
  return names;
}

void bind_scene_class(lua_State* L) {
  Class<Scene> world(L, "The world: gravity, obstacles, robots, rods and branch points");
  add_branch_to(world);
  add_robots_to(world);
  add_motion_to(world);
  add_export_to(world);
  add_scene_file_to(world);
  world.property("gravity", "m/s^2", "Acceleration", [](const Scene& s) { return s.gravity(); })
      .property("rods", "", "Names of the rods", rod_names)
      .property("obstacles", "", "Names of the obstacles", obstacle_names)
      .method("obstacle",
              {.takes = {"name", "shape"}, .options = obstacle_options(),
               .does = "Adds something solid: a mesh file, {points =, triangles =}, or scene.box, .cylinder, .sphere, .plane.",
               .example = "local s = scene.new{}\n"
                          "s:obstacle(\"floor\", scene.plane{}, {clearance = 5 * units.mm})\n"
                          "s:obstacle(\"sheet\", {points = {{0,0,0}, {1,0,0}, {0,1,0}}, triangles = {{1,2,3}}})"},
              [](lua_State* L, std::shared_ptr<Scene> s, const std::string& name, const ObstacleSource& shape, const Options& o) {
                s->add(make_obstacle(L, name, shape, o));
                return s;
              })
      .method("rod", {.takes = {"name", "design"}, .options = rod_options(), .does = "Places a rod; ends not given stay free.",
                         .example = with_hose("print(p)")},
              [](std::shared_ptr<Scene> s, const std::string& name, const Rod& design, const Options& o) {
                s->add(PlacedRod(name, design, o.maybe<Frame>("from"), o.maybe<Frame>("to")));
                return PlacedRodHandle{s, name};
              })
      .method("placed", {.takes = {"name"}, .does = "The placed rod of this name.",
                         .example = with_hose("print(s:placed(\"hose\").name)  --> hose")},
              [](std::shared_ptr<Scene> s, const std::string& name) {
                s->rod(name);
                return PlacedRodHandle{s, name};
              })
      .method("remove", {.takes = {"name"}, .does = "Removes a rod, a branch point, an obstacle, or a robot that carries no rod.",
                         .example = with_hose("s:remove(\"hose\")")},
              [](std::shared_ptr<Scene> s, const std::string& name) {
                s->remove(name);
                return s;
              })
      .method("solve",
              {.options = solve_schema() +
                          Schema{option<SceneEquilibrium>("from", "", "Start from this equilibrium of a similar scene"),
                                 option<bool>("modes", "", "Also the softest eigenmodes, and other stable equilibria for the same "
                                                           "holds").preset(false)} +
                          timeout_schema(),
               .does = "Static equilibrium of every rod. Look at .ok: what does not converge is a result, not an error.",
                         .example = with_hose("local eq = s:solve{}\nprint(eq.ok, eq.status)  --> true solved")},
              [](lua_State* L, const Scene& s, const Options& o) { return solved(L, s, o); })
      .method("explain",
              {.options = solve_schema(), .does = "Which terms, contacts and solvers this scene uses, and what was left out.",
                         .example = with_hose("print(s:explain())")},
              [](const Scene& s, const Options& o) { return explain(s, solve_options(o)); })
      .tostring(describe_scene);
}

void bind_explanation(lua_State* L) {
  Class<ExplainedItem>(L, "One part of the model, used or left out")
      .property("subject", "", "A rod's name, or 'scene'", [](const ExplainedItem& i) { return i.subject; })
      .property("name", "", "What it is", [](const ExplainedItem& i) { return i.name; })
      .property("used", "", "False: left out", [](const ExplainedItem& i) { return i.used; })
      .property("why", "", "The reason", [](const ExplainedItem& i) { return i.why; })
      .tostring([](const ExplainedItem& i) { return i.subject + ": " + (i.used ? "" : "no ") + i.name + ", " + i.why; });
  Class<Explanation>(L, "What a solve does and what it leaves out")
      .list([](const Explanation& e) { return e.items.size(); }, [](const Explanation& e, std::size_t i) { return e.items[i]; })
      .method("uses", {.takes = {"name"}, .does = "True when some rod or the scene uses this: \"gravity\", \"contact\" ...",
                         .example = with_hose("print(s:explain():uses(\"gravity\"))  --> true")},
              [](const Explanation& e, const std::string& name) { return e.uses(name); })
      .tostring([](const Explanation& e) { return e.text(); });
}

}  // namespace

void bind_scene(lua_State* L) {
  bind_placed_rod(L);
  bind_explanation(L);
  bind_scene_class(L);
  Module scene(L, "scene", "The world that rods live in");
  scene.function("new", {.options = scene_options(), .does = "An empty world.",
                         .example = "local s = scene.new{gravity = {0, 0, -9.81}}\nprint(s)"},
                 [](const Options& o) { return std::make_shared<Scene>(o.maybe<Vec3>("gravity").value_or(Vec3::Zero())); });
  bind_mesh(L, scene);
  add_import(L, scene);
  add_solids(L, scene);
  add_scene_file_to(scene);
}

}  // namespace tendril::lua
