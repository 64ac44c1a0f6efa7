// scene:export, equilibrium:save, motion:save.
#include "binding/bind_export.h"

#include <algorithm>
#include <cctype>
#include <chrono>

#include "base/number_text.h"
#include "base/write_file.h"
#include "binding/bind_mesh.h"
#include "binding/examples.h"

namespace tendril::lua {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool ends_in(const std::string& path, const std::string& suffix) {
  if (path.size() < suffix.size()) return false;
  return std::equal(suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

Schema surface_options() {
  return {
      option<bool>("rods", "", "Rods as tubes").preset(true),
      option<bool>("obstacles", "", "Obstacles").preset(true),
      option<bool>("robots", "", "The robots' links").preset(true),
      option<double>("tolerance", "m", "Of the tubes' facets from the round, bent rods; default: 2 % of each rod's radius").above(0),
  };
}

Schema unit_schema() {
  return {option<std::string>("unit", "", "Length unit of the file; default \"m\". A .glb is always in m").one_of({"mm", "cm", "m", "in"})};
}

SurfaceOptions read_options(const Options& o) {
  SurfaceOptions options;
  options.rods = o.get<bool>("rods");
  options.obstacles = o.get<bool>("obstacles");
  options.robots = o.get<bool>("robots");
  options.tolerance = o.maybe<double>("tolerance").value_or(0);
  return options;
}

double unit_of(const Options& o) { return metres_per(o.maybe<std::string>("unit").value_or("m")); }

SavedFile export_scene(const Scene& scene, const std::string& path, const Options& o) {
  const auto start = std::chrono::steady_clock::now();
  const SurfaceOptions options = read_options(o);
  const SceneEquilibrium* equilibrium = o.find<SceneEquilibrium>("equilibrium");
  if (!equilibrium && options.rods && !scene.rods().empty())
    throw UsageError("scene:export: rods have no shape without an equilibrium; give {equilibrium = s:solve()}, or {rods = false} for "
                     "the surroundings alone");
  if (equilibrium)
    for (const auto& rod : scene.rods())
      if (std::none_of(equilibrium->rods.begin(), equilibrium->rods.end(), [&](const SolvedRod& r) { return r.name == rod->name(); }))
        throw UsageError("scene:export: the equilibrium lacks rod '" + rod->name() + "'; it is of another scene, or was solved before that was added");
  save_surfaces(path, equilibrium ? surfaces_of(*equilibrium, options) : surfaces_of(scene, options), unit_of(o));
  return {path, Status::solved, seconds_since(start)};
}

SavedFile save_equilibrium(const SceneEquilibrium& equilibrium, const std::string& path, const Options& o) {
  const auto start = std::chrono::steady_clock::now();
  if (ends_in(path, ".csv")) {
    if (o.has("unit")) throw UsageError("equilibrium:save: a .csv is always in SI units; leave 'unit' out");
    write_file(path, rods_csv(equilibrium));
  } else {
    save_surfaces(path, surfaces_of(equilibrium, read_options(o)), unit_of(o));
  }
  return {path, Status::solved, seconds_since(start)};
}

SavedFile save_motion(const SceneMotion& motion, const std::string& path, const Options& o) {
  std::vector<double> times;
  for (const double t : motion.times) times.push_back(o.get<double>("seconds") * t);
  return save_animation("motion:save", path, times, {motion.equilibria.begin(), motion.equilibria.end()}, {}, o);
}

}  // namespace

Schema animation_options() { return surface_options(); }

SavedFile save_animation(const std::string& who, const std::string& path, const std::vector<double>& times,
                         const std::vector<std::shared_ptr<const SceneEquilibrium>>& states, const std::vector<CarriedBody>& carried,
                         const Options& o) {
  const auto start = std::chrono::steady_clock::now();
  if (!ends_in(path, ".glb")) throw UsageError(who + ": got '" + path + "', expected a file name that ends in .glb");
  std::vector<double> shown;
  std::vector<std::shared_ptr<const SceneEquilibrium>> shown_states;
  for (std::size_t i = 0; i < std::min(times.size(), states.size()); ++i) {
    if (!shown.empty() && !(static_cast<float>(times[i]) > static_cast<float>(shown.back()))) continue;
    shown.push_back(times[i]);
    shown_states.push_back(states[i]);
  }
  if (shown.size() < 2) throw UsageError(who + ": there are " + std::to_string(shown.size()) + " states; an animation needs at least 2");
  std::vector<MovingPart> parts = moving_surfaces_of(shown_states, read_options(o));
  for (MovingPart& part : moving_bodies_of(carried, shown_states)) parts.push_back(std::move(part));
  write_file(path, glb_of(parts, shown));
  return {path, Status::solved, seconds_since(start)};
}

void add_export_to(Class<Scene>& scene) {
  scene.method("export",
               {.takes = {"path"},
                .options = Schema{option<SceneEquilibrium>("equilibrium", "", "Where the rods are; the surroundings are then those it was solved in")} +
                           surface_options() + unit_schema(),
                .does = "Writes rods, obstacles and links as .glb (a named part each, in colours), .obj (a group each), .stl or .ply (one mesh).",
                .example = with_equilibrium("s:export(\"scene.glb\", {equilibrium = eq})\ns:export(\"scene.obj\", {equilibrium = eq, unit = \"mm\"})")},
               export_scene);
}

void add_save_to(Class<SceneEquilibrium>& equilibrium) {
  equilibrium.method("save",
                     {.takes = {"path"}, .options = surface_options() + unit_schema(),
                      .does = "Writes the rods as .csv (a line a vertex: rod, s, place, tangent, bend radius, tension), or all that was solved as .glb, "
                              ".obj, .stl or .ply, as s:export does.",
                      .example = with_equilibrium("eq:save(\"rods.csv\")\neq:save(\"hose.stl\", {obstacles = false, unit = \"mm\"})")},
                     save_equilibrium);
}

void add_save_to(Class<SceneMotion>& motion) {
  motion.method("save",
                {.takes = {"path"},
                 .options = Schema{option<double>("seconds", "s", "How long it plays").above(0).at_most(1e6).preset(5)} + animation_options(),
                 .does = "Writes it as an animated .glb: rods bend, robots' links and other bodies move, between its solutions evenly.",
                 .example = with_hose("local m = s:motion{steps = 4, holds = {[\"hose.finish\"] = function(t)\n"
                                      "  return frame{at = {0.9, 0.1 * t, 0}, along = {1, 0, 0}} end}}\n"
                                      "m:save(\"motion.glb\", {seconds = 2})")},
                save_motion);
}

}  // namespace tendril::lua
