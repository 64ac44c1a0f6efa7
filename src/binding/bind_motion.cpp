// motion: holds that follow paths, from equilibrium to equilibrium.
#include "binding/bind_motion.h"

#include <cmath>

#include "binding/bind_envelope.h"
#include "binding/bind_export.h"
#include "binding/bind_mesh.h"
#include "binding/card.h"
#include "binding/clearance_value.h"
#include "binding/examples.h"
#include "binding/lua_context.h"
#include "binding/open.h"
#include "binding/solve_options.h"
#include "method/dress_pack/scene_path_motion.h"

namespace tendril::lua {
namespace {

const std::string motion_example =
    "local f = assert(io.open(\"engine.csv\", \"w\"))\n"
    "f:write(\"t,x,y,z,rx,ry,rz\\n0,0,0,0,0,0,0\\n1,10,0,-4,0,0.05,0\\n\")\nf:close()\n"
    "local m = study.motion(\"engine.csv\", {unit = \"mm\"})\n";

/// A function of t = 0 ... 1, or frames that are passed evenly spaced in t.
using Path = std::variant<Function, std::vector<Frame>>;

Schema motion_options() {
  return Schema{
             option<std::map<std::string, Path>>(
                 "holds", "", "By \"rod.start\", \"rod.finish\", \"rod.0.25\" (an arc length in m) or a branch point's name: a "
                              "function of t = 0 ... 1 that returns a frame, or a list of frames passed evenly in t"),
             option<std::string>("robot", "", "Instead of holds: the robot that moves, with all rods of the scene attached to it"),
             option<std::vector<std::vector<double>>>("path", "rad or m", "Its joint values, passed evenly in t and straight between"),
             option<int>("steps", "", "Solutions that are kept, evenly spaced in t").at_least(1).at_most(1e6).preset(20),
             option<double>("largest_move", "", "Share of the length that a vertex may move in one step before it is halved")
                 .above(0).at_most(1).preset(0.02),
             option<double>("smallest_step", "", "Of t; a larger move over this is a snap-through").above(0).at_most(1).preset(1e-4),
         } +
         solve_schema() + timeout_schema();
}

/// Straight between the frames, turning evenly.
Frame between(const std::vector<Frame>& frames, double t) {
  if (frames.size() == 1) return frames.front();
  const double place = t * (frames.size() - 1);
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(place), frames.size() - 2);
  const double share = place - i;
  const Vec3 turn = log_rotation(frames[i].rotation.conjugate() * frames[i + 1].rotation);
  return {(1 - share) * frames[i].at + share * frames[i + 1].at, frames[i].rotation * exp_rotation(share * turn)};
}

MovingHold moving_hold(lua_State* L, const Scene& scene, const std::string& key, const Path& path) {
  MovingHold hold;
  const std::size_t dot = key.find('.');
  hold.name = key.substr(0, dot);
  if (dot != std::string::npos) {
    const PlacedRod& rod = scene.rod(hold.name);
    const std::string where = key.substr(dot + 1);
    char* end = nullptr;
    const double s = std::strtod(where.c_str(), &end);
    hold.at = !where.empty() && *end == '\0' ? s : rod.place(where);
  }
  if (const auto* frames = std::get_if<std::vector<Frame>>(&path)) {
    if (frames->empty()) throw UsageError("scene:motion: the list of frames for '" + key + "' is empty");
    hold.path = [list = *frames](double t) { return between(list, t); };
  } else {
    hold.path = [L, function = std::get<Function>(path)](double t) { return function.call<Frame>(L, "scene:motion", t); };
  }
  return hold;
}

SceneMotion robot_motion(lua_State* L, const Scene& scene, const Options& o) {
  if (o.has("holds")) throw UsageError("scene:motion: got 'holds' beside a robot's path; its attachments move, other holds stay");
  if (!o.has("robot") || !o.has("path"))
    throw UsageError(std::string("scene:motion: '") + (o.has("robot") ? "path" : "robot") + "' is missing; a robot and its path belong together");
  std::vector<dress_pack::JointVector> via;
  for (const std::vector<double>& q : o.get<std::vector<std::vector<double>>>("path"))
    via.push_back(Eigen::Map<const dress_pack::JointVector>(q.data(), static_cast<Eigen::Index>(q.size())));
  dress_pack::SimulationOptions options;
  options.steps = o.get<int>("steps");
  options.tolerance = solve_options(o).tolerance;
  return dress_pack::move_robot(scene, o.get<std::string>("robot"), dress_pack::JointPath(std::move(via)), options, run_context(L, o));
}

std::string describe_motion(const SceneMotion& motion) {
  Card card("motion");
  card.row("status", motion.ok() ? "solved" : name_of(motion.status), motion.ok() ? "" : motion.message);
  card.row("solutions", std::to_string(motion.equilibria.size()),
           motion.times.empty() ? "" : "to t = " + plain_number(motion.times.back()));
  card.row("time", motion.seconds, "s", std::to_string(motion.solves) + " solves");
  card.row("snap-throughs", motion.snaps.empty() ? "none" : std::to_string(motion.snaps.size()));
  for (const SceneSnap& s : motion.snaps)
    card.row("at t = " + plain_number(s.snap.t), s.rod, "moves " + quantity(s.snap.move, "m") + " at s = " + quantity(s.snap.s, "m"));
  return card.text();
}

/// The smallest gap at each kept time.
std::vector<ClearanceValue> clearances_of(const SceneMotion& m, const Options& o) {
  std::vector<ClearanceValue> all;
  for (const auto& equilibrium : m.equilibria) all.push_back(clearance_between(*equilibrium, o));
  return all;
}

void bind_sampled_motion(lua_State* L) {
  Class<SampledMotion>(L, "Frames of a body over time, read by study.motion")
      .property("times", "s", "Rising", [](const SampledMotion& m) { return m.times; })
      .property("frames", "", "Of the body, at those times", [](const SampledMotion& m) { return m.frames; })
      .method("at", {.takes = {"time"}, .does = "The body's frame at a time (s), evenly between the samples.",
                     .example = motion_example + "print(m:at(0.5).at)  --> vec(0.005, 0, -0.002)"},
              [](const SampledMotion& m, double time) { return m.at(time); })
      .method("carried", {.takes = {"place"}, .does = "The frames of a place that moves with the body and is given as it is at the first sample.",
                          .example = motion_example + "print(m:carried(frame{at = {0, 1, 0}, along = {0, 1, 0}})[1].at)  --> vec(0, 1, 0)"},
              [](const SampledMotion& m, const Frame& place) { return m.carried(place); })
      .tostring([](const SampledMotion& m) {
        return Card("sampled motion").row("samples", std::to_string(m.times.size())).row("from", m.times.front(), "s").row("to", m.times.back(), "s").text();
      });
}

}  // namespace

void add_motion_to(Class<Scene>& scene) {
  scene.method("motion",
               {.options = motion_options(),
                .does = "Moves holds along paths, or a robot and what is attached to it, quasi-statically: each equilibrium starts from the one before, steps adapt, and "
                        "a snap-through is reported with its place.",
                .example = with_hose("local m = s:motion{steps = 4, holds = {[\"hose.finish\"] = function(t)\n"
                                     "  return frame{at = {0.9, 0.1 * t, 0}, along = {1, 0, 0}} end}}\n"
                                     "print(m.ok, #m.equilibria)  --> true\t5")},
               [](lua_State* L, const Scene& s, const Options& o) {
                 if (o.has("robot") || o.has("path")) return std::make_shared<SceneMotion>(robot_motion(L, s, o));
                 if (!o.has("holds")) throw UsageError("scene:motion: nothing moves; give 'holds', or 'robot' and 'path'");
                 std::vector<MovingHold> holds;
                 for (const auto& [key, path] : o.get<std::map<std::string, Path>>("holds"))
                   holds.push_back(moving_hold(L, s, key, path));
                 MotionOptions motion;
                 motion.steps = o.get<int>("steps");
                 motion.largest_move = o.get<double>("largest_move");
                 motion.smallest_step = o.get<double>("smallest_step");
                 return std::make_shared<SceneMotion>(move_holds(s, holds, motion, solve_options(o), run_context(L, o)));
               });
}

void add_sampled_motion_to(Module& study) {
  study.function("motion",
                 {.takes = {"path"},
                  .options = {option<std::string>("unit", "", "Length unit of x, y, z").one_of({"mm", "cm", "m", "in"}).required()},
                  .does = "A rigid motion from a .csv: columns t (s), x, y, z, and qw, qx, qy, qz or rx, ry, rz (rad) where it turns.",
                  .example = motion_example + "print(#m.frames)  --> 2"},
                 [](const std::string& path, const Options& o) { return read_motion(path, metres_per(o.get<std::string>("unit"))); });
}

void bind_motion(lua_State* L, const std::shared_ptr<EnvelopeBuilder>& builder) {
  bind_sampled_motion(L);
  Class<SceneSnap>(L, "Rods that left their equilibrium and came to rest in another one")
      .property("t", "", "When", [](const SceneSnap& s) { return s.snap.t; })
      .property("rod", "", "Which moved farthest", [](const SceneSnap& s) { return s.rod; })
      .property("s", "m", "At this arc length", [](const SceneSnap& s) { return s.snap.s; })
      .property("move", "m", "By so much", [](const SceneSnap& s) { return s.snap.move; })
      .property("energy_drop", "J", "Energy set free", [](const SceneSnap& s) { return s.snap.energy_drop; })
      .tostring([](const SceneSnap& s) {
        return "snap-through of '" + s.rod + "' at t = " + plain_number(s.snap.t) + ": " + quantity(s.snap.move, "m");
      });
  Class<SceneMotion> motion(L, "A quasi-static motion");
  motion.property("ok", "", "It went to the end", [](const SceneMotion& m) { return m.ok(); })
      .property("status", "", "\"solved\", \"stalled\", \"cancelled\", \"timeout\"", [](const SceneMotion& m) { return name_of(m.status); })
      .property("message", "", "What there is to say about it", [](const SceneMotion& m) { return m.message; })
      .property("seconds", "s", "Run time", [](const SceneMotion& m) { return m.seconds; })
      .property("solves", "", "Equilibria that were computed", [](const SceneMotion& m) { return m.solves; })
      .property("times", "", "t of the equilibria", [](const SceneMotion& m) { return m.times; })
      .property("equilibria", "", "At those times", [](const SceneMotion& m) { return m.equilibria; })
      .property("snaps", "", "Snap-throughs, in time order", [](const SceneMotion& m) { return m.snaps; })
      .method("clearance", {.options = clearance_options(), .does = "The smallest gap at each of those times: a list.",
                            .example = with_hose("s:obstacle(\"floor\", scene.plane(), {pose = frame{at = {0, 0, -1}, along = {0, 0, 1}}})\n"
                                                 "local m = s:motion{steps = 2, holds = {[\"hose.finish\"] = function(t)\n"
                                                 "  return frame{at = {0.9 - 0.2 * t, 0, 0}, along = {1, 0, 0}} end}}\n"
                                                 "local gaps = m:clearance{from = \"hose\"}\nprint(gaps[3] < gaps[1])  --> true")},
              clearances_of)
      .tostring(describe_motion);
  add_save_to(motion);
  add_envelope_to(motion, builder);
}

}  // namespace tendril::lua
