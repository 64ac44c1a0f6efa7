// method.dress_pack_design: where and how hoses are best fastened to a robot, for motions that stay as they are.
#include <cmath>

#include "base/error.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/pack_motion.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

std::string robot_of(const Scene& scene, const Options& o, const char* who) {
  if (o.has("robot")) return o.get<std::string>("robot");
  if (scene.robots().size() == 1) return scene.robots().front().name;
  throw UsageError(std::string(who) + (scene.robots().empty() ? ": the scene has no robot; add one with scene:robot(name, robot, {...})"
                                                              : ": the scene has several robots; name one in 'robot'"));
}

dress_pack::JointPath path_of(const std::vector<std::vector<double>>& rows, const Robot& robot, const std::string& who) {
  std::vector<dress_pack::JointVector> via;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (static_cast<int>(rows[k].size()) != robot.size())
      throw UsageError(who + ": point " + std::to_string(k + 1) + " has " + std::to_string(rows[k].size()) + " joint values, expected " +
                       std::to_string(robot.size()) + " for " + robot.name());
    via.push_back(Eigen::Map<const dress_pack::JointVector>(rows[k].data(), static_cast<int>(rows[k].size())));
  }
  return dress_pack::JointPath(std::move(via));
}

Schema pack_limit_options() {
  return {
      option<double>("max_tension", "N", "Of the force between a hold and its rod; default: as little as can be").above(0),
      option<double>("max_twist", "rad/m", "Against the unstressed rod").above(0),
      option<double>("min_bend_radius", "m", "Of the rods").above(0),
  };
}

dress_pack::Limits pack_limits(const Options& o) {
  dress_pack::Limits limits;
  if (o.has("max_tension")) limits.max_tension = o.get<double>("max_tension");
  if (o.has("max_twist")) limits.max_twist = o.get<double>("max_twist");
  limits.min_bend_radius = o.maybe<double>("min_bend_radius").value_or(0);
  return limits;
}

namespace {

using Rows = std::vector<std::vector<double>>;
using Bounds = std::array<double, 2>;

Schema design_schema() {
  return Schema{
             option<std::map<std::string, Bounds>>("adjust", "m or rad", "By name {lowest, highest}: \"hose.length\", \"hose.start.x\" .y .z (in the link's axes), "
                                                                          "\"hose.start.rx\" .ry .rz (turned about the section's own axes), \"hose.0.4.at\" (a clip's "
                                                                          "arc length)").required(),
             option<std::vector<Rows>>("motions", "rad or m", "The paths that it is adjusted for, each a list of joint values").required(),
             option<std::vector<double>>("weights", "", "Of the motions; default: all 1"),
             option<std::string>("robot", "", "Its name in the scene; default: the only one"),
             option<int>("steps", "", "Time steps of each motion").at_least(1).at_most(1e5).preset(40),
             option<double>("length_weight", "1/m", "Of the rods' length against what they bear").at_least(0).preset(0),
         } +
         pack_limit_options() + method_schema();
}

PackDesignHandle design(lua_State* L, const std::shared_ptr<Scene>& scene, const Options& o) {
  const std::string who = "method.dress_pack_design";
  PackDesignHandle out;
  out.scene = scene;
  out.given = std::make_shared<const dress_pack::ScenePack>(dress_pack::pack_of(*scene, robot_of(*scene, o, who.c_str())));
  const dress_pack::PackProblem& pack = out.given->problem;
  const std::vector<Rows> motions = o.get<std::vector<Rows>>("motions");
  const std::vector<double> weights = o.maybe<std::vector<double>>("weights").value_or(std::vector<double>(motions.size(), 1.0));
  if (weights.size() != motions.size())
    throw UsageError(who + ": " + std::to_string(weights.size()) + " weights for " + std::to_string(motions.size()) + " motions");
  std::vector<dress_pack::PackTask> tasks;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    out.paths.push_back(path_of(motions[k], *pack.robot, who + ": motion " + std::to_string(k + 1)));
    tasks.push_back({out.paths.back(), weights[k]});
  }
  std::vector<dress_pack::PackParameter> parameters;
  for (const auto& [name, bounds] : o.get<std::map<std::string, Bounds>>("adjust")) {
    parameters.push_back(dress_pack::pack_parameter(pack, name, bounds[0], bounds[1]));
    out.names.push_back(name);
    out.before.push_back(parameters.back().start);
  }
  dress_pack::ParameterOptions options;
  options.steps = o.get<int>("steps");
  options.length_weight = o.get<double>("length_weight");
  double weight = 0;
  for (const RodProblem& rod : pack.rods) weight += rod.rod.mass() * rod.gravity.norm();
  options.demands = dress_pack::demands_of(pack_limits(o), weight, 0);
  out.result = std::make_shared<const dress_pack::ParameterResult>(dress_pack::optimise_parameters(pack, parameters, tasks, options, method_context(L, o)));
  auto found = std::make_shared<dress_pack::ScenePack>(*out.given);
  if (!out.result->pack.rods.empty()) found->problem = out.result->pack;
  out.found = std::move(found);
  return out;
}

std::vector<PackMotionHandle> motions_of(const PackDesignHandle& h, bool after) {
  std::vector<PackMotionHandle> list;
  const std::vector<dress_pack::PackMotion>& motions = after ? h.result->after : h.result->before;
  for (std::size_t k = 0; k < motions.size(); ++k)
    list.push_back({std::shared_ptr<const dress_pack::PackMotion>(h.result, &motions[k]), h.paths[k], after ? h.found : h.given, h.scene,
                    after ? "motion of the adjusted pack" : "motion of the given pack"});
  return list;
}

std::map<std::string, double> values_of(const PackDesignHandle& h) {
  std::map<std::string, double> values;
  for (std::size_t k = 0; k < h.names.size() && k < h.result->values.size(); ++k) values[h.names[k]] = h.result->values[k];
  return values;
}

std::string describe_design(const PackDesignHandle& h) {
  const dress_pack::ParameterResult& r = *h.result;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < h.names.size() && k < r.values.size(); ++k) {
    const bool angle = h.names[k].find(".r") != std::string::npos && h.names[k].back() >= 'x';
    rows.push_back({h.names[k], quantity(h.before[k], angle ? "rad" : "m"), quantity(r.values[k], angle ? "rad" : "m")});
  }
  for (std::size_t k = 0; k < r.before.size() && k < r.after.size(); ++k)
    rows.push_back({"largest force, motion " + std::to_string(k + 1), quantity(r.before[k].largest_end_force(), "N"), quantity(r.after[k].largest_end_force(), "N")});
  return Card("dress pack design").row("status", r.ok() ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s", std::to_string(r.iterations) + " iterations").text() +
         "\n" + table_text({"", "given", "adjusted"}, rows);
}

const std::string example =
    std::string(pack_scene_example) +
    "local d = method.dress_pack_design(s, {adjust = {[\"hose.length\"] = {1.5, 1.8}}, steps = 10,\n"
    "                                       motions = {{{0, 0, 0, 0, 0, 0}, {0.5, 0.1, -0.3, 0.3, 0.2, 0.2}}}})\n";

}  // namespace

void bind_pack_design(lua_State* L) {
  Class<PackDesignHandle>(L, "Numbers of a dress pack, adjusted for motions that stay as they are")
      .property("ok", "", "The search came to its end", [](const PackDesignHandle& h) { return h.result->ok(); })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const PackDesignHandle& h) { return name_of(h.result->status); })
      .property("message", "", "What there is to say about it", [](const PackDesignHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const PackDesignHandle& h) { return h.result->seconds; })
      .property("values", "m or rad", "By name, the best that were found", values_of)
      .property("objective", "", "What the search made least", [](const PackDesignHandle& h) { return h.result->objective; })
      .property("objective_before", "", "The same of the given pack", [](const PackDesignHandle& h) { return h.result->objective_before; })
      .property("history", "", "The objective, step by step", [](const PackDesignHandle& h) { return h.result->history; })
      .property("before", "", "The motions of the given pack, without contact", [](const PackDesignHandle& h) { return motions_of(h, false); })
      .property("after", "", "The motions of the adjusted one", [](const PackDesignHandle& h) { return motions_of(h, true); })
      .tostring(describe_design);
}

void add_pack_design_to(Module& method) {
  method.function("dress_pack_design",
                  {.takes = {"scene"}, .options = design_schema(),
                   .does = "Adjusts numbers of a dress pack (a hose's length, places and angles of its attachments, a clip's place along it) so that it bears as "
                           "little as demanded in the motions given. Contact and clearance are not looked at.",
                   .example = example + "print(d.ok, d.objective <= d.objective_before)  --> true\ttrue"},
                  design);
}

}  // namespace tendril::lua
