// method.dress_pack: a robot's path that spares its hoses.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/bind_program.h"
#include "binding/card.h"
#include "binding/dress_pack_chart.h"
#include "binding/dress_pack_classes.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using dress_pack::JointVector;
using dress_pack::PackMotion;
using dress_pack::PackStep;
using Numbers = std::vector<double>;

Schema dress_pack_schema() {
  const dress_pack::Options standard;
  return Schema{
             option<std::vector<Numbers>>("path", "rad or m", "Joint values of the via points; straight between them, all pieces take the same time").required(),
             option<std::string>("robot", "", "Its name in the scene; default: the only one"),
             option<double>("seconds", "s", "That the path takes: the joints' speeds are kept; default: they are not looked at").above(0),
             option<int>("via", "", "Via points of the optimised path, first and last among them; default: as many as given").at_least(2).at_most(200),
             option<double>("max_tension", "N", "Of the force between a hold and its rod; default: as little as can be").above(0),
             option<double>("max_twist", "rad/m", "Against the unstressed rod").above(0),
             option<double>("min_bend_radius", "m", "Of the rods").above(0),
             option<double>("clearance", "m", "Of the rods from obstacles and links; default: they may touch").at_least(0),
             option<double>("robot_clearance", "m", "Of the links from obstacles; default: not looked at").at_least(0),
             option<int>("steps", "", "Time steps of the search").at_least(1).at_most(1e5).preset(standard.steps),
             option<int>("checked_steps", "", "Time steps of the simulations before and after").at_least(1).at_most(1e5).preset(standard.checked_steps),
             option<bool>("optimise", "", "False: the given path is simulated, that is all").preset(standard.optimise),
             option<std::string>("formulation", "", "Unknowns of the search: \"reduced\", the via points alone; \"direct\", all states and stresses as well").one_of({"reduced", "direct"}).preset("reduced"),
             option<int>("starts", "", "Of the search: the given path and others that stray from it").at_least(1).at_most(10000).preset(standard.starts),
             option<double>("effort", "", "Weight of the path's length and unevenness against what the rods bear").at_least(0).preset(standard.weights.effort),
             option<Numbers>("weights", "", "Of the joints in the path's length; default: all 1"),
         } +
         method_schema();
}

dress_pack::Options dress_pack_options(const Options& o) {
  dress_pack::Options options;
  options.seconds = o.maybe<double>("seconds").value_or(0);
  options.via = o.maybe<int>("via").value_or(0);
  if (o.has("max_tension")) options.limits.max_tension = o.get<double>("max_tension");
  if (o.has("max_twist")) options.limits.max_twist = o.get<double>("max_twist");
  options.limits.min_bend_radius = o.maybe<double>("min_bend_radius").value_or(0);
  options.limits.clearance = o.maybe<double>("clearance").value_or(-1);
  options.limits.robot_clearance = o.maybe<double>("robot_clearance").value_or(-1);
  options.steps = o.get<int>("steps");
  options.checked_steps = o.get<int>("checked_steps");
  options.optimise = o.get<bool>("optimise");
  options.formulation = o.get<std::string>("formulation") == "direct" ? dress_pack::Formulation::direct : dress_pack::Formulation::reduced;
  options.starts = o.get<int>("starts");
  options.weights.effort = o.get<double>("effort");
  options.weights.joints = o.maybe<Numbers>("weights").value_or(Numbers());
  return options;
}

std::string robot_of(const Scene& scene, const Options& o) {
  if (o.has("robot")) return o.get<std::string>("robot");
  if (scene.robots().size() == 1) return scene.robots().front().name;
  throw UsageError(scene.robots().empty() ? "method.dress_pack: the scene has no robot; add one with scene:robot(name, robot, {...})"
                                          : "method.dress_pack: the scene has several robots; name one in 'robot'");
}

dress_pack::JointPath path_of(const std::vector<Numbers>& rows, const Robot& robot) {
  std::vector<JointVector> via;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (static_cast<int>(rows[k].size()) != robot.size())
      throw UsageError("method.dress_pack: 'path': point " + std::to_string(k + 1) + " has " + std::to_string(rows[k].size()) + " joint values, expected " +
                       std::to_string(robot.size()) + " for " + robot.name());
    via.push_back(Eigen::Map<const JointVector>(rows[k].data(), static_cast<int>(rows[k].size())));
  }
  return dress_pack::JointPath(std::move(via));
}

std::vector<Numbers> rows_of(const dress_pack::JointPath& path) {
  std::vector<Numbers> rows;
  for (const JointVector& q : path.via()) rows.emplace_back(q.data(), q.data() + q.size());
  return rows;
}

DressPackHandle dress_pack_of(lua_State* L, const std::shared_ptr<Scene>& scene, const Options& o) {
  auto pack = std::make_shared<const dress_pack::ScenePack>(dress_pack::pack_of(*scene, robot_of(*scene, o)));
  const dress_pack::JointPath path = path_of(o.get<std::vector<Numbers>>("path"), *pack->problem.robot);
  auto result = std::make_shared<const dress_pack::Result>(dress_pack::run(pack->problem, path, dress_pack_options(o), method_context(L, o)));
  return {std::move(result), std::move(pack), scene};
}

/// The state of the rods at the time step nearest to t.
std::shared_ptr<SceneEquilibrium> frame_at(const PackMotionHandle& h, double t) {
  const std::vector<PackStep>& steps = h.motion().steps;
  if (steps.empty()) throw UsageError("pack_motion:frame: there is no state: " + h.motion().message);
  if (!(t >= 0 && t <= 1)) throw UsageError("pack_motion:frame: got t = " + number_text(t) + ", expected 0 to 1");
  const auto near = std::min_element(steps.begin(), steps.end(), [t](const PackStep& a, const PackStep& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
  return dress_pack::scene_states(*h.of.scene, *h.of.pack, {*near}).front();
}

Numbers joints_at(const PackMotionHandle& h, double t) {
  if (!(t >= 0 && t <= 1)) throw UsageError("pack_motion:joints: got t = " + number_text(t) + ", expected 0 to 1");
  const JointVector q = h.path().at(t);
  return {q.data(), q.data() + q.size()};
}

std::shared_ptr<SceneMotion> motion_of(const PackMotionHandle& h, const Options& o) {
  const PackMotion& motion = h.motion();
  auto out = std::make_shared<SceneMotion>();
  out->status = motion.status;
  out->message = motion.message;
  out->seconds = motion.seconds;
  out->solves = motion.iterations;
  const int wanted = std::min<int>(o.get<int>("states"), static_cast<int>(motion.steps.size()));
  std::vector<PackStep> shown;
  for (int k = 0; k < wanted; ++k) shown.push_back(motion.steps[wanted == 1 ? 0 : k * (motion.steps.size() - 1) / (wanted - 1)]);
  for (const PackStep& step : shown) out->times.push_back(step.t);
  out->equilibria = dress_pack::scene_states(*h.of.scene, *h.of.pack, shown);
  for (const dress_pack::PackSnap& snap : motion.snaps)
    out->snaps.push_back({h.of.pack->problem.rod_name(snap.rod), {snap.t, snap.rod, 0, snap.move, snap.energy_drop}});
  return out;
}

template <class Read>
Numbers over_time(const PackMotionHandle& h, Read read) {
  Numbers out;
  for (const PackStep& step : h.motion().steps) out.push_back(read(step));
  return out;
}

double force_of(const PackStep& step) {
  double most = 0;
  for (const auto& end : step.ends) most = std::max(most, end.force.norm());
  return most;
}

const std::string example =
    "local bot = robot.load(\"builtin:six_axis\")\n"
    "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
    "local hose = rod.new{length = 1.6, section = rod.section{outer = 0.03, inner = 0.02, material = rubber}, segments = 16}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:robot(\"arm\", bot)\n"
    "s:rod(\"hose\", hose)\n"
    "s:attach(\"hose\", \"start\", \"arm\", \"link_2\", frame{at = {0.05, 0.2, 0.75}, along = {1, 0, 1}})\n"
    "s:attach(\"hose\", \"finish\", \"arm\", \"link_6\", frame{at = {0.05, 0, 0.15}, along = {1, 0, 0}})\n"
    "local r = method.dress_pack(s, {path = {{0, 0, 0, 0, 0, 0}, {0.5, 0.1, -0.3, 0.3, 0.2, 0.2}, {1, 0, 0, 0.7, 0, 0}}, via = 4, checked_steps = 20})\n";

void bind_pack_motion(lua_State* L) {
  Class<dress_pack::PackSnap>(L, "A rod of a dress pack that left its equilibrium and came to rest in another one")
      .property("t", "", "Just after this share of the path", [](const dress_pack::PackSnap& s) { return s.t; })
      .property("move", "m", "The farthest that a place on it moved", [](const dress_pack::PackSnap& s) { return s.move; })
      .property("energy_drop", "J", "Energy set free", [](const dress_pack::PackSnap& s) { return s.energy_drop; })
      .tostring([](const dress_pack::PackSnap& s) { return "snap-through at t = " + plain_number(s.t) + ": " + quantity(s.move, "m"); });
  Class<PackMotionHandle>(L, "A dress pack that follows its robot along a path, from equilibrium to equilibrium")
      .property("ok", "", "It came to the end of the path", [](const PackMotionHandle& h) { return h.motion().ok(); })
      .property("message", "", "What there is to say about it", [](const PackMotionHandle& h) { return h.motion().message; })
      .property("seconds", "s", "Run time", [](const PackMotionHandle& h) { return h.motion().seconds; })
      .property("max_tension", "N", "The largest force between a hold and its rod", [](const PackMotionHandle& h) { return h.motion().largest_end_force(); })
      .property("max_twist", "rad/m", "The largest change against the unstressed rods", [](const PackMotionHandle& h) { return h.motion().largest_twist(); })
      .property("min_bend_radius", "m", "The smallest", [](const PackMotionHandle& h) { return h.motion().smallest_bend_radius(); })
      .property("clearance", "m", "The smallest of the rods from obstacles and links; infinite: nothing is near", [](const PackMotionHandle& h) { return h.motion().smallest_clearance(); })
      .property("length", "rad or m", "Of the path, the joints together", [](const PackMotionHandle& h) { return h.path().length(); })
      .property("times", "", "Shares of the path", [](const PackMotionHandle& h) { return over_time(h, [](const PackStep& s) { return s.t; }); })
      .property("tensions", "N", "The largest force of a hold at those times", [](const PackMotionHandle& h) { return over_time(h, force_of); })
      .property("residual", "N", "The largest that was left unbalanced", [](const PackMotionHandle& h) {
        double most = 0;
        for (const PackStep& step : h.motion().steps) most = std::max(most, step.residual);
        return most;
      })
      .property("snaps", "", "Snap-throughs, in time order", [](const PackMotionHandle& h) { return h.motion().snaps; })
      .method("frame", {.takes = {"t"}, .does = "The equilibrium, with the robot where it is, at the time step nearest to t = 0 ... 1.",
                        .example = example + "print(r.after:frame(0.5):rod(\"hose\").length)  --> 1.6"},
              frame_at)
      .method("joints", {.takes = {"t"}, .does = "The robot's joint values at t = 0 ... 1.", .example = example + "print(r.after:joints(0)[1])  --> 0"},
              joints_at)
      .method("motion", {.options = {option<int>("states", "", "Evenly spaced, first and last among them").at_least(1).at_most(1e5).preset(40)},
                         .does = "Its states as a motion: for envelopes, gaps and pictures.", .example = example + "print(#r.after:motion{states = 5}.equilibria)  --> 5"},
              motion_of)
      .tostring([](const PackMotionHandle& h) {
        const PackMotion& m = h.motion();
        return Card(h.optimised ? "motion on the optimised path" : "motion on the given path")
            .row("status", m.ok() ? "solved" : name_of(m.status), m.message)
            .row("largest force", m.largest_end_force(), "N").row("largest twist", m.largest_twist() / units::deg, "deg/m")
            .row("min bend radius", m.smallest_bend_radius(), "m").row("min clearance", m.smallest_clearance(), "m").text();
      });
}

void bind_search(lua_State* L) {
  Class<dress_pack::ReducedIteration>(L, "One step of the search for a better path")
      .property("objective", "", "After it", [](const dress_pack::ReducedIteration& i) { return i.objective; })
      .property("step", "rad", "Its length, all via points together", [](const dress_pack::ReducedIteration& i) { return i.step; })
      .property("radius", "rad", "Of the trust region", [](const dress_pack::ReducedIteration& i) { return i.radius; })
      .property("accepted", "", "The path was changed", [](const dress_pack::ReducedIteration& i) { return i.accepted; })
      .tostring([](const dress_pack::ReducedIteration& i) { return "objective " + plain_number(i.objective) + (i.accepted ? "" : ", step refused"); });
  Class<dress_pack::Unmet>(L, "A limit that a motion does not keep: where it is worst")
      .property("what", "", "\"tension\", \"twist\", \"bend_radius\", \"clearance\" or \"robot_clearance\"", [](const dress_pack::Unmet& u) { return name_of(u.what); })
      .property("where", "", "The hold, rod or link", [](const dress_pack::Unmet& u) { return u.where; })
      .property("value", "N, rad/m or m", "What it is", [](const dress_pack::Unmet& u) { return u.value; })
      .property("demanded", "N, rad/m or m", "What was asked for", [](const dress_pack::Unmet& u) { return u.demanded; })
      .property("t", "", "When", [](const dress_pack::Unmet& u) { return u.t; })
      .property("from", "", "Not kept from this time", [](const dress_pack::Unmet& u) { return u.from; })
      .property("to", "", "to this", [](const dress_pack::Unmet& u) { return u.to; })
      .property("at_end", "", "Worst in the first or last configuration, which no via point changes", [](const dress_pack::Unmet& u) { return u.at_end; })
      .property("text", "", "In words", [](const dress_pack::Unmet& u) { return u.text; })
      .tostring([](const dress_pack::Unmet& u) { return u.text; });
}

std::string before_after_table(const dress_pack::Result& r) {
  const auto row = [&](const char* name, double before, double after, const char* unit) {
    return std::vector<std::string>{name, quantity(before, unit), quantity(after, unit)};
  };
  return table_text({"", "given path", "optimised path"},
                    {row("largest force of a hold", r.before.largest_end_force(), r.after.largest_end_force(), "N"),
                     row("largest twist", r.before.largest_twist() / units::deg, r.after.largest_twist() / units::deg, "deg/m"),
                     row("min bend radius", r.before.smallest_bend_radius(), r.after.smallest_bend_radius(), "m"),
                     row("min clearance", r.before.smallest_clearance(), r.after.smallest_clearance(), "m"),
                     row("length of the path", r.given.length(), r.path.length(), "rad"),
                     {"snap-throughs", std::to_string(r.before.snaps.size()), std::to_string(r.after.snaps.size())}});
}

std::string describe(const dress_pack::Result& r) {
  Card card("dress pack");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s", std::to_string(r.iterations) + " iterations");
  for (const dress_pack::Unmet& u : r.unmet) card.row("not kept", u.text);
  return card.text() + (r.before.steps.empty() || r.after.steps.empty() ? "" : "\n" + before_after_table(r));
}

std::string program_of(const DressPackHandle& h, const std::string& dialect, const Options& o) {
  return program_text(*h.pack->problem.robot, rows_of(h.result->path), dialect, o);
}

}  // namespace

void bind_dress_pack(lua_State* L) {
  bind_pack_motion(L);
  bind_search(L);
  Class<DressPackHandle>(L, "A robot's path for its hoses, before and after")
      .property("ok", "", "The path keeps all that is demanded", [](const DressPackHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const DressPackHandle& h) { return name_of(h.result->status); })
      .property("message", "", "What there is to say about it", [](const DressPackHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const DressPackHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const DressPackHandle& h) { return h.result->steps; })
      .property("path", "rad or m", "Joint values of its via points", [](const DressPackHandle& h) { return rows_of(h.result->path); })
      .property("given", "rad or m", "The path as it was, through as many via points", [](const DressPackHandle& h) { return rows_of(h.result->given); })
      .property("before", "", "The motion on the given path", [](const DressPackHandle& h) { return PackMotionHandle{h, false}; })
      .property("after", "", "The motion on the optimised path", [](const DressPackHandle& h) { return PackMotionHandle{h, true}; })
      .property("unmet", "", "Limits that the optimised path does not keep", [](const DressPackHandle& h) { return h.result->unmet; })
      .property("unmet_before", "", "Limits that the given path does not keep", [](const DressPackHandle& h) { return h.result->unmet_before; })
      .property("objective", "", "What the search made least", [](const DressPackHandle& h) { return h.result->objective; })
      .property("objective_before", "", "The same where its last round began", [](const DressPackHandle& h) { return h.result->objective_before; })
      .property("history", "", "Of the search, step by step", [](const DressPackHandle& h) { return h.result->history; })
      .method("frame", {.takes = {"t"}, .does = "The equilibrium on the optimised path at the time step nearest to t = 0 ... 1.",
                        .example = example + "print(r:frame(0).ok)  --> true"},
              [](const DressPackHandle& h, double t) { return frame_at({h, true}, t); })
      .method("program", {.takes = {"dialect"}, .options = program_form(),
                          .does = "The optimised path as the program of a robot controller, in text: \"rapid\", \"krl\", \"urscript\", \"ls\" or \"csv\".",
                          .example = example + "print(r:program(\"rapid\", {speed = 0.3}))"},
              program_of)
      .method("chart", {.options = {option<std::string>("title", "", "Above it; default: \"Dress pack\"")},
                        .does = "What the rods bear over time on the given path and on the optimised one.", .example = example + "print(r:chart())"},
              [](const DressPackHandle& h, const Options& o) { return dress_pack_chart(*h.result, o.maybe<std::string>("title").value_or("Dress pack")); })
      .tostring([](const DressPackHandle& h) { return describe(*h.result); });
}

void add_dress_pack_to(Module& method) {
  method.function("dress_pack",
                  {.takes = {"scene"}, .options = dress_pack_schema(),
                   .does = "Simulates the hoses on a robot along a path, and moves its via points so that the hoses bear as little as demanded.",
                   .example = example + "print(r.after.max_tension <= r.before.max_tension)  --> true"},
                  dress_pack_of);
}

}  // namespace tendril::lua
