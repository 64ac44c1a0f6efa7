// method.assembly: can it be installed, and how.
#include <algorithm>
#include <cmath>

#include "base/nearest_name.h"
#include "base/write_file.h"
#include "binding/assembly_chart.h"
#include "binding/assembly_classes.h"
#include "binding/bind_export.h"
#include "binding/bind_method.h"
#include "binding/bind_obstacle.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "method/assembly/assembly.h"
#include "method/assembly/manipulation_file.h"

namespace tendril::lua {
namespace {

const Schema& connector_options() {
  static const Schema schema{
      option<std::string>("name", "", "In messages").required(),
      option<std::string>("rod", "", "At whose end it is").required(),
      option<std::string>("at", "", "Which end").one_of({"start", "finish"}).preset("finish"),
      option<Vec3>("size", "m", "Edge lengths of a box; or"),
      option<ObstacleSource>("shape", "", "a solid, a mesh, mesh data or a file's name"),
      option<std::string>("unit", "", "Length unit of the file or data").one_of({"mm", "cm", "m", "in"}),
      option<Frame>("pose", "", "Where its own axes lie, seen from the rod's end; default: they are the section's, its middle on the rod's end"),
  };
  return schema;
}

}  // namespace

template <>
struct Value<assembly::Connector> {
  static const Kind& kind() {
    static const Kind kind{"a table {name =, rod =, at =, size = or shape =}", "{name: string, rod: string, at: string?, size: vec?, shape: any?, unit: string?, pose: frame?}",
                           [](lua_State* L, int index) { return lua_istable(L, index) ? std::string() : describe(L, index); }};
    return kind;
  }
  static assembly::Connector read(lua_State* L, int index) {
    static const std::string who = "method.assembly: connectors";
    const Options o(L, lua_absindex(L, index), connector_options(), who);
    assembly::Connector connector{o.get<std::string>("name"), o.get<std::string>("rod"), o.get<std::string>("at") == "start", {}};
    if (o.has("size") == o.has("shape")) throw UsageError(who + ": '" + connector.name + "' needs either 'size' or 'shape'");
    if (o.has("size")) {
      const Solid box = Box{o.get<Vec3>("size")};
      check(box, who.c_str());
      connector.body.shape = box;
    } else {
      connector.body.shape = make_shape(L, connector.name, o.get<ObstacleSource>("shape"), o);
    }
    if (const Frame* pose = o.find<Frame>("pose")) connector.body.pose = *pose;
    connector.body.name = connector.name;
    return connector;
  }
};

namespace {

using Exit = std::variant<Frame, Vec3>;

Schema assembly_schema() {
  const assembly::Options standard;
  return Schema{
             option<std::vector<std::string>>("rods", "", "Names; default: all of the scene, which must hang together"),
             option<std::vector<assembly::Connector>>("connectors", "", "List of {name =, rod =, at = \"start\" or \"finish\", size = or shape =}: "
                                                                        "rigid bodies at the ends of rods, which collide too"),
             option<Exit>("exit", "m", "Where the handle must get to; default: anywhere with room"),
             option<std::string>("grip", "", "Rod or branch point to pull it out by; default: chosen"),
             option<double>("grip_at", "m", "Arc length of the handle on that rod; default: its middle").at_least(0),
             option<double>("max_strain", "", "Of the outermost fibre, all the way").above(0).preset(standard.max_strain),
             option<double>("min_bend_radius", "m", "All the way").at_least(0).preset(standard.min_bend_radius),
             option<double>("deviation", "", "How near the last state must be to the routed one, in radii of the thickest rod").above(0).at_most(10).preset(standard.deviation),
             option<int>("attempts", "", "Handles, paths, grips that are tried, at most").at_least(1).at_most(10000).preset(standard.attempts),
             option<std::shared_ptr<SceneEquilibrium>>("routed", "", "An equilibrium of the scene: which one is the routed configuration; default: the one that s:solve finds"),
             option<bool>("optimise", "", "Make what was found shorter, smoother, with more clearance and fewer grips").preset(standard.optimise),
             option<double>("optimise_seconds", "s", "For that, at most").at_least(0).preset(standard.optimise_seconds),
             option<int>("replays", "", "Of what was proven, by hands that stray by a quarter of the thickest radius: is it fragile?").at_least(0).at_most(10000).preset(standard.replays),
         } +
         solve_schema() + method_schema();
}

assembly::Options assembly_options(const Options& o) {
  assembly::Options options;
  if (o.has("rods")) options.rods = o.get<std::vector<std::string>>("rods");
  if (o.has("connectors")) options.connectors = o.get<std::vector<assembly::Connector>>("connectors");
  if (o.has("exit")) {
    const Exit exit = o.get<Exit>("exit");
    const Frame* frame = std::get_if<Frame>(&exit);
    options.exit = frame ? frame->at : std::get<Vec3>(exit);
  }
  options.grip = o.maybe<std::string>("grip").value_or("");
  options.grip_at = o.maybe<double>("grip_at").value_or(-1);
  options.max_strain = o.get<double>("max_strain");
  options.min_bend_radius = o.get<double>("min_bend_radius");
  options.deviation = o.get<double>("deviation");
  options.attempts = o.get<int>("attempts");
  if (o.has("routed")) options.routed = o.get<std::shared_ptr<SceneEquilibrium>>("routed");
  options.optimise = o.get<bool>("optimise");
  options.optimise_seconds = o.get<double>("optimise_seconds");
  options.replays = o.get<int>("replays");
  options.solve = solve_options(o);
  return options;
}

/// Far away where nothing was near.
double clearance_of(const assembly::Proof& proof) { return proof.clearance_to.empty() ? INFINITY : proof.clearance; }

/// Of a proven manipulation; 0: there is none.
int most_hands(const assembly::Result& r) { return r.manipulation.grips.empty() ? 0 : r.manipulation.hands(0); }

std::string describe_assembly(const AssemblyHandle& h) {
  const assembly::Result& r = *h.result;
  Card card("assembly");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s", std::to_string(r.attempts.size()) + " attempts");
  if (r.manipulation.grips.empty()) return card.text();
  card.row("hands", std::to_string(most_hands(r)), "at the same time, at most").row("duration", r.duration, "s", std::to_string(r.proof.steps) + " steps played");
  card.row("deviation", r.proof.deviation, "m", "from the routed configuration");
  card.row("largest strain", plain_number(100 * r.proof.strain) + " %", "'" + r.proof.strain_of + "' at t = " + plain_number(r.proof.strain_at_time));
  card.row("min bend radius", r.proof.bend_radius, "m", "'" + r.proof.bend_radius_of + "' at t = " + plain_number(r.proof.bend_radius_at_time));
  if (r.robustness.replays > 0) card.row("unsteady hands", std::to_string(r.robustness.arrived) + " of " + std::to_string(r.robustness.replays) + " replays arrived");
  if (r.proof.clearance_to.empty()) card.row("min clearance", "none near");
  else card.row("min clearance", r.proof.clearance, "m", "to '" + r.proof.clearance_to + "' at t = " + plain_number(r.proof.clearance_at_time));
  return card.text();
}

int hands_at(const AssemblyHandle& h, double t) {
  if (h.result->manipulation.grips.empty()) throw UsageError("assembly:hands_at: no manipulation was proven: " + h.result->message);
  if (!(t >= 0 && t <= 1)) throw UsageError("assembly:hands_at: got t = " + plain_number(t) + ", expected 0 to 1");
  return h.result->manipulation.hands(t);
}

/// The state nearest in time.
std::shared_ptr<SceneEquilibrium> frame_at(const AssemblyHandle& h, double t) {
  const std::vector<assembly::KeyFrame>& play = h.result->play;
  if (play.empty()) throw UsageError("assembly:frame: no attempt began: " + h.result->message);
  if (t < 0 || t > 1) throw UsageError("assembly:frame: got t = " + plain_number(t) + ", expected 0 to 1");
  const auto nearest = std::min_element(play.begin(), play.end(), [t](const auto& a, const auto& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
  return std::const_pointer_cast<SceneEquilibrium>(nearest->equilibrium);
}

/// What was played, at the manipulation's pace.
SavedFile save_assembly_animation(const AssemblyHandle& h, const std::string& path, const Options& o) {
  std::vector<double> times;
  std::vector<std::shared_ptr<const SceneEquilibrium>> states;
  for (const assembly::KeyFrame& key : h.result->play) {
    times.push_back(h.result->duration * key.t);
    states.push_back(key.equilibrium);
  }
  std::vector<CarriedBody> carried;
  for (const assembly::Connector& connector : h.connectors)
    carried.push_back({connector.name, connector.rod, connector.at_start ? 0 : h.scene->rod(connector.rod).rod().length, connector.body});
  return save_animation("assembly:save", path, times, states, carried, o);
}

SavedFile save_assembly(const AssemblyHandle& h, const std::string& path, const Options& o) {
  if (path.ends_with(".glb")) return save_assembly_animation(h, path, o);
  if (h.result->manipulation.grips.empty()) throw UsageError("assembly:save: no manipulation was proven: " + h.result->message);
  if (path.ends_with(".csv")) write_file(path, assembly::manipulation_csv(h.result->manipulation, h.result->duration));
  else if (path.ends_with(".json")) write_file(path, assembly::manipulation_json(h.result->manipulation, h.result->duration));
  else throw UsageError("assembly:save: got '" + path + "', expected a file name that ends in .csv, .json or .glb");
  return {path, Status::solved, 0};
}

Frame pose_at(const GripPathHandle& p, double t) {
  if (t < 0 || t > 1) throw UsageError("grip_path: got t = " + plain_number(t) + ", expected 0 to 1");
  return p.result->manipulation.pose(p.index, t);
}

const std::string example =
    "local mm = units.mm\n"
    "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
    "local hose = rod.new{length = 0.5, section = rod.section{outer = 16*mm, inner = 10*mm, material = rubber}, segments = 20}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:obstacle(\"post\", scene.cylinder{radius = 30*mm, length = 0.4}, {pose = frame{at = {0, 0.06, 0}, along = {0, 0, 1}}})\n"
    "s:rod(\"hose\", hose, {from = frame{at = {-0.22, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.22, 0, 0}, along = {1, 0, 0}}})\n"
    "local a = method.assembly(s, {optimise = false})\n";

void bind_paths(lua_State* L) {
  Class<GripPathHandle>(L, "Where a grip is over the common time: path(t) is its frame at t = 0 ... 1")
      .property("name", "", "\"hose.start\", or a branch point's name", [](const GripPathHandle& p) { return p.grip().name; })
      .property("rod", "", "Name of the rod that is gripped; nil: a branch point",
                [](const GripPathHandle& p) -> std::optional<std::string> {
                  if (p.grip().branch >= 0) return std::nullopt;
                  return p.result->play.front().equilibrium->rods[p.grip().rod].name;
                })
      .property("s", "m", "Arc length of the grip on its rod; nil: a branch point",
                [](const GripPathHandle& p) { return p.grip().branch >= 0 ? std::nullopt : std::optional<double>(p.grip().at); })
      .property("connection", "", "It is held in the routed configuration; else it lets go at the end", [](const GripPathHandle& p) { return p.grip().connection; })
      .property("times", "", "Rising from 0 to 1", [](const GripPathHandle& p) { return p.result->manipulation.times; })
      .property("frames", "", "At those times", [](const GripPathHandle& p) { return p.result->manipulation.poses[p.index]; })
      .method("at", {.takes = {"t"}, .does = "Its frame at t = 0 ... 1; path(t) says the same.", .example = example + "print((a.paths[\"hose.start\"]:at(1).at - vec(-0.22, 0, 0)):length() < 1e-9)  --> true"},
              pose_at)
      .operation("__call", pose_at)
      .tostring([](const GripPathHandle& p) {
        return "path of '" + p.grip().name + "', " + std::to_string(p.result->manipulation.times.size()) + " times";
      });
  Class<GripPathsHandle>(L, "The paths of all grips, by name or number: #paths, paths[i]")
      .members(
          [](const GripPathsHandle& h) {
            std::vector<std::string> names;
            for (const assembly::Grip& grip : h.result->manipulation.grips) names.push_back(grip.name);
            return names;
          },
          [](const GripPathsHandle& h, const std::string& name) -> std::optional<GripPathHandle> {
            const auto& grips = h.result->manipulation.grips;
            for (std::size_t g = 0; g < grips.size(); ++g)
              if (grips[g].name == name) return GripPathHandle{h.result, static_cast<int>(g)};
            return std::nullopt;
          })
      .list([](const GripPathsHandle& h) { return h.result->manipulation.grips.size(); },
            [](const GripPathsHandle& h, std::size_t i) { return GripPathHandle{h.result, static_cast<int>(i)}; })
      .tostring([](const GripPathsHandle& h) {
        std::vector<std::vector<std::string>> rows;
        for (const assembly::Grip& grip : h.result->manipulation.grips) rows.push_back({grip.name, grip.connection ? "stays" : "lets go at the end"});
        return table_text({"grip", "in the end"}, rows);
      });
}

void bind_attempt(lua_State* L) {
  using assembly::Attempt;
  Class<Attempt>(L, "One try to install a system: a handle pulled out, and what was traced played forward")
      .property("handle", "", "Rod and share of its length, or branch point, that it was pulled by", [](const Attempt& a) { return a.handle; })
      .property("gravity", "", "It acted while the system was pulled out", [](const Attempt& a) { return a.gravity; })
      .property("smoothed", "", "The traces were", [](const Attempt& a) { return a.smoothed; })
      .property("grips", "", "That moved it in; 0: it did not come out", [](const Attempt& a) { return a.grips; })
      .property("outcome", "", "\"proven\", or what stopped it", [](const Attempt& a) { return a.outcome; })
      .property("seconds", "s", "Run time", [](const Attempt& a) { return a.seconds; })
      .tostring([](const Attempt& a) {
        return "'" + a.handle + "'" + (a.gravity ? ", with gravity" : "") + (a.smoothed ? "" : ", as traced") + ", " + std::to_string(a.grips) +
               " grips: " + a.outcome + ", " + quantity(a.seconds, "s");
      });
}

void bind_worst(lua_State* L) {
  Class<AssemblyWorstHandle>(L, "The worst of all states on the way in")
      .property("strain", "", "Of the outermost fibre", [](const AssemblyWorstHandle& w) { return w.result->proof.strain; })
      .property("bend_radius", "m", "The smallest", [](const AssemblyWorstHandle& w) { return w.result->proof.bend_radius; })
      .property("clearance", "m", "The smallest; negative: so deep in contact", [](const AssemblyWorstHandle& w) { return clearance_of(w.result->proof); })
      .property("when", "", "{strain =, bend_radius =, clearance =}: t = 0 ... 1 of each",
                [](const AssemblyWorstHandle& w) {
                  const assembly::Proof& proof = w.result->proof;
                  return std::map<std::string, double>{{"strain", proof.strain_at_time}, {"bend_radius", proof.bend_radius_at_time}, {"clearance", proof.clearance_at_time}};
                })
      .property("where", "", "{strain =, bend_radius =, clearance =}: names of rods and of the nearest obstacle", [](const AssemblyWorstHandle& w) {
        const assembly::Proof& proof = w.result->proof;
        return std::map<std::string, std::string>{{"strain", proof.strain_of}, {"bend_radius", proof.bend_radius_of}, {"clearance", proof.clearance_to}};
      });
  Class<AssemblyProofHandle>(L, "How the manipulation was played forward")
      .property("ok", "", "Proven", [](const AssemblyProofHandle& p) { return p.result->proof.ok; })
      .property("message", "", "What went wrong, where", [](const AssemblyProofHandle& p) { return p.result->proof.message; })
      .property("deviation", "m", "Of the last state from the routed configuration, at most", [](const AssemblyProofHandle& p) { return p.result->proof.deviation; })
      .property("steps", "", "Equilibria on the way", [](const AssemblyProofHandle& p) { return p.result->proof.steps; });
}

}  // namespace

void bind_assembly(lua_State* L) {
  bind_paths(L);
  bind_attempt(L);
  bind_worst(L);
  Class<AssemblyHandle>(L, "A manipulation that installs a system of rods, or why none was found")
      .property("ok", "", "Found, and proven by playing it forward", [](const AssemblyHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const AssemblyHandle& h) { return name_of(h.result->status); })
      .property("message", "", "How it ends, or what stopped the best attempt, and where", [](const AssemblyHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const AssemblyHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const AssemblyHandle& h) { return h.result->steps; })
      .property("attempts", "", "List of what was tried, in order", [](const AssemblyHandle& h) { return h.result->attempts; })
      .property("hands", "", "Grips to be held at the same time, at most", [](const AssemblyHandle& h) { return most_hands(*h.result); })
      .property("duration", "s", "Of the common time: t = 1", [](const AssemblyHandle& h) { return h.result->duration; })
      .property("paths", "", "Where each grip is: paths[\"hose.start\"](t), t = 0 ... 1 from outside to the routed configuration", [](const AssemblyHandle& h) { return GripPathsHandle{h.result}; })
      .property("handle_path", "m", "Of the handle, outwards, as it was searched", [](const AssemblyHandle& h) { return h.result->handle_path; })
      .property("worst", "", "Strain, bend radius and clearance on the way, when and where", [](const AssemblyHandle& h) { return AssemblyWorstHandle{h.result}; })
      .property("stopped_at", "m", "Where the best attempt was stopped; nil: one was proven", [](const AssemblyHandle& h) { return h.result->stopped_at; })
      .property("replays", "", "{of =, arrived =}: replays by hands that stray by a quarter of the thickest radius; where some do not arrive it is fragile",
                [](const AssemblyHandle& h) { return std::map<std::string, int>{{"of", h.result->robustness.replays}, {"arrived", h.result->robustness.arrived}}; })
      .property("proof", "", "How the forward play went", [](const AssemblyHandle& h) { return AssemblyProofHandle{h.result}; })
      .method("frame", {.takes = {"t"}, .does = "The equilibrium that was played nearest to t = 0 ... 1; at 1 the connections alone hold it. Where none was proven: of the attempt that came furthest.",
                        .example = example + "print(a:frame(1):rod(\"hose\").min_bend_radius > 0.05)  --> true"},
              frame_at)
      .method("hands_at", {.takes = {"t"}, .does = "Grips to be held at t = 0 ... 1: one that is a connection and at rest until the end is plugged in and needs no hand.",
                           .example = example + "print(a:hands_at(0) >= a:hands_at(0.9))  --> true"},
              hands_at)
      .method("save", {.takes = {"path"}, .options = animation_options(),
                        .does = "Writes the paths of all grips into a .csv or .json (s, mm, quaternions), or what was played as an animated .glb.",
                        .example = example + "a:save(\"paths.csv\")\na:save(\"paths.json\")\na:save(\"way_in.glb\")"},
              save_assembly)
      .method("chart", {.options = {option<std::string>("title", "", "Above it; default: \"Installation\"")},
                        .does = "Strain, bend radius, clearance and hands over time, one below the other.", .example = example + "print(a:chart())"},
              [](const AssemblyHandle& h, const Options& o) { return assembly_chart(*h.result, o.maybe<std::string>("title").value_or("Installation")); })
      .tostring(describe_assembly);
}

void add_assembly_to(Module& method) {
  method.function("assembly",
                  {.takes = {"scene"}, .options = assembly_schema(),
                   .does = "A manipulation that brings a system of rods to its routed configuration, proven by playing it forward under gravity and in contact.",
                   .example = example + "print(a.ok, a.status)  --> true\tsolved"},
                  [](lua_State* state, const std::shared_ptr<Scene>& scene, const Options& o) {
                    const assembly::Options options = assembly_options(o);
                    return AssemblyHandle{std::make_shared<const assembly::Result>(assembly::run(*scene, options, method_context(state, o))), scene, options.connectors};
                  });
}

}  // namespace tendril::lua
