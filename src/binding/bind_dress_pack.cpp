// method.dress_pack: a robot's path that spares its hoses.
#include "base/error.h"
#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/bind_program.h"
#include "binding/card.h"
#include "binding/dress_pack_chart.h"
#include "binding/dress_pack_classes.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/pack_motion.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using dress_pack::JointVector;
using dress_pack::PackMotion;
using Numbers = std::vector<double>;

Schema dress_pack_schema() {
  const dress_pack::Options standard;
  return Schema{
             option<std::vector<Numbers>>("path", "rad or m", "Joint values of the via points; straight between them, all pieces take the same time").required(),
             option<std::string>("robot", "", "Its name in the scene; default: the only one"),
             option<double>("seconds", "s", "That the path takes: the joints' speeds are kept; default: they are not looked at").above(0),
             option<int>("via", "", "Via points of the optimised path, first and last among them; default: as many as given").at_least(2).at_most(200),
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
         pack_limit_options() + method_schema();
}

dress_pack::Options dress_pack_options(const Options& o) {
  dress_pack::Options options;
  options.seconds = o.maybe<double>("seconds").value_or(0);
  options.via = o.maybe<int>("via").value_or(0);
  options.limits = pack_limits(o);
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

std::vector<Numbers> rows_of(const dress_pack::JointPath& path) {
  std::vector<Numbers> rows;
  for (const JointVector& q : path.via()) rows.emplace_back(q.data(), q.data() + q.size());
  return rows;
}

DressPackHandle dress_pack_of(lua_State* L, const std::shared_ptr<Scene>& scene, const Options& o) {
  auto pack = std::make_shared<const dress_pack::ScenePack>(dress_pack::pack_of(*scene, robot_of(*scene, o, "method.dress_pack")));
  const dress_pack::JointPath path = path_of(o.get<std::vector<Numbers>>("path"), *pack->problem.robot, "method.dress_pack: 'path'");
  auto result = std::make_shared<const dress_pack::Result>(dress_pack::run(pack->problem, path, dress_pack_options(o), method_context(L, o)));
  return {std::move(result), std::move(pack), scene};
}

const std::string example =
    std::string(pack_scene_example) +
    "local r = method.dress_pack(s, {path = {{0, 0, 0, 0, 0, 0}, {0.5, 0.1, -0.3, 0.3, 0.2, 0.2}, {1, 0, 0, 0.7, 0, 0}}, via = 4, checked_steps = 20})\n";

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

PackMotionHandle motion_of(const DressPackHandle& h, bool optimised) {
  const dress_pack::Result& r = *h.result;
  return {std::shared_ptr<const PackMotion>(h.result, optimised ? &r.after : &r.before), optimised ? r.path : r.given, h.pack, h.scene,
          optimised ? "motion on the optimised path" : "motion on the given path"};
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
  bind_search(L);
  Class<DressPackHandle>(L, "A robot's path for its hoses, before and after")
      .property("ok", "", "The path keeps all that is demanded", [](const DressPackHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const DressPackHandle& h) { return name_of(h.result->status); })
      .property("message", "", "What there is to say about it", [](const DressPackHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const DressPackHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const DressPackHandle& h) { return h.result->steps; })
      .property("path", "rad or m", "Joint values of its via points", [](const DressPackHandle& h) { return rows_of(h.result->path); })
      .property("given", "rad or m", "The path as it was, through as many via points", [](const DressPackHandle& h) { return rows_of(h.result->given); })
      .property("before", "", "The motion on the given path", [](const DressPackHandle& h) { return motion_of(h, false); })
      .property("after", "", "The motion on the optimised path", [](const DressPackHandle& h) { return motion_of(h, true); })
      .property("unmet", "", "Limits that the optimised path does not keep", [](const DressPackHandle& h) { return h.result->unmet; })
      .property("unmet_before", "", "Limits that the given path does not keep", [](const DressPackHandle& h) { return h.result->unmet_before; })
      .property("objective", "", "What the search made least", [](const DressPackHandle& h) { return h.result->objective; })
      .property("objective_before", "", "The same where its last round began", [](const DressPackHandle& h) { return h.result->objective_before; })
      .property("history", "", "Of the search, step by step", [](const DressPackHandle& h) { return h.result->history; })
      .method("frame", {.takes = {"t"}, .does = "The equilibrium on the optimised path at the time step nearest to t = 0 ... 1.",
                        .example = example + "print(r:frame(0).ok)  --> true"},
              [](const DressPackHandle& h, double t) { return frame_at(motion_of(h, true), t); })
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
