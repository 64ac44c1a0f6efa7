// method.harness: a branched harness between several connections.
#include <limits>
#include <map>

#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/routing_options.h"
#include "binding/scene_classes.h"
#include "method/route/harness_routing.h"

namespace tendril::lua {

/// A routed harness and the scene it was routed in; its branches and junctions share it.
struct HarnessHandle {
  std::shared_ptr<const routing::HarnessResult> result;
  std::shared_ptr<Scene> scene;
};
struct HarnessBranchHandle {
  HarnessHandle harness;
  int index = 0;  ///< counted from 0
  const routing::HarnessBranch& branch() const { return harness.result->branches[index]; }
};

template <> inline constexpr const char* class_name<HarnessHandle> = "harness";
template <> inline constexpr const char* class_name<HarnessBranchHandle> = "harness_branch";
template <> inline constexpr const char* class_name<routing::HarnessClip> = "harness_clip";
template <> inline constexpr const char* class_name<routing::HarnessJunction> = "harness_junction";

namespace {

using routing::HarnessResult;

Schema harness_schema() {
  return Schema{
             option<std::vector<Frame>>("connections", "", "Two to nine places, each with the direction in which its branch leaves").required(),
             option<std::vector<std::string>>("names", "", "Of the connections; default \"1\", \"2\" ..."),
             option<std::vector<std::array<int, 2>>>("wires", "", "Pairs of connections, counted from 1; default: each one with the first"),
             option<double>("bundling", "", "0: the shortest wires ... 1: the shortest harness").at_least(0).at_most(1).preset(0.5),
             option<Section>("section", "", "Cross-section of every branch").required(),
             option<double>("min_bend_radius", "m", "Of the centre line").required().above(0),
             option<double>("min_straight", "m", "Least straight between two bends").at_least(0).preset(0),
             option<double>("end_straight", "m", "Least straight at both ends of every branch").at_least(0).preset(0),
             option<std::map<std::string, double>>("weights", "", "{length =, clearance =}: what a metre costs, and what it costs more next to obstacles"),
             option<double>("grid", "m", "Step of the search").above(0).at_most(1).preset(20 * units::mm),
             option<bool>("settle", "", "Find its equilibrium under gravity").preset(true),
             option<bool>("refine", "", "Where it settles: adjust lengths, directions at branch points and clips, so that it keeps at rest what its "
                                        "route keeps").preset(true),
             option<int>("clips", "", "That may be used where lengths and directions do not help, over the whole harness").at_least(0).at_most(1000).preset(0),
             option<double>("clip_reach", "m", "From the harness's surface to what it is clipped to, at most").at_least(0).preset(50 * units::mm),
             option<double>("max_stretch", "", "Of a refined branch at rest, as a share of its length: a harness is laid, not strung").above(0).at_most(1).preset(2e-3),
             option<int>("restarts", "", "From routes with bend radius and clearance in reserve, where refinement is not enough").at_least(0).at_most(20).preset(2),
         } +
         surroundings_schema() + method_schema();
}

routing::HarnessOptions harness_options(const Options& o) {
  routing::HarnessOptions options;
  options.connections = o.get<std::vector<Frame>>("connections");
  if (o.has("names")) options.names = o.get<std::vector<std::string>>("names");
  const int count = static_cast<int>(options.connections.size());
  if (o.has("wires"))
    for (std::array<int, 2> wire : o.get<std::vector<std::array<int, 2>>>("wires")) {
      for (int& end : wire) {
        if (end < 1 || end > count)
          throw UsageError("method.harness: 'wires': got connection " + std::to_string(end) + ", expected 1 to " + std::to_string(count));
        --end;
      }
      options.wires.push_back(wire);
    }
  options.bundling = o.get<double>("bundling");
  options.section = o.get<Section>("section");
  options.min_bend_radius = o.get<double>("min_bend_radius");
  options.min_straight = o.get<double>("min_straight");
  options.end_straight = o.get<double>("end_straight");
  options.free_ends = o.get<double>("free_ends");
  read_surroundings(o, options.space);
  if (o.has("weights")) {
    const CostWeights weights = cost_weights(o, o.get<std::map<std::string, double>>("weights"));
    if (!(weights.length > 0 && weights.clearance >= 0))
      throw UsageError("method.harness: 'weights': the weight of length must be above 0 and that of clearance at least 0");
    options.space.clearance_weight = weights.clearance / weights.length;
  }
  options.grid = o.get<double>("grid");
  options.equilibrium = o.get<bool>("settle");
  options.refine = o.get<bool>("refine");
  options.max_clips = o.get<int>("clips");
  options.clip_reach = o.get<double>("clip_reach");
  options.max_stretch = o.get<double>("max_stretch");
  options.restarts = o.get<int>("restarts");
  return options;
}

std::string end_name(const HarnessResult& r, const routing::HarnessEnd& end) {
  if (end.junction) return "junction " + std::to_string(end.number + 1);
  return r.options.names.empty() ? std::to_string(end.number + 1) : r.options.names[end.number];
}

std::string clips_table(const HarnessResult& r) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.design.clips.size(); ++i) {
    const routing::HarnessClip& clip = r.design.clips[i];
    rows.push_back({std::to_string(i + 1), r.branches[clip.branch].name, quantity(clip.at, "m"), clip.obstacle, quantity(clip.force, "N")});
  }
  return table_text({"clip", "branch", "at", "on", "force"}, rows);
}

std::string describe_harness(const HarnessHandle& h) {
  const HarnessResult& r = *h.result;
  Card card("harness");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  card.row("harness length", r.harness_length, "m").row("cable length", r.cable_length, "m");
  card.row("branches", std::to_string(r.branches.size())).row("junctions", std::to_string(r.junctions.size()));
  card.row("clips", std::to_string(r.design.clips.size()), r.options.max_clips > 0 ? "of " + std::to_string(r.options.max_clips) + " allowed" : "");
  card.row("cost", r.cost, "m", "by weights and wires");
  if (r.options.space.clearance_weight > 0 || r.options.space.preference > 0) card.row("preference", r.preference, "m", "integral along the route");
  if (r.restarts > 0) card.row("restarts", std::to_string(r.restarts));
  card.row("in collision", r.length_in_collision, "m", r.equilibrium ? "settled" : "as routed");
  std::vector<std::vector<std::string>> rows;
  for (const routing::HarnessBranch& b : r.branches)
    rows.push_back({b.name, end_name(r, b.from), end_name(r, b.to), std::to_string(b.wires.size()), quantity(b.length, "m"),
                    quantity(b.min_bend_radius, "m"), b.clearance_to.empty() ? "none near" : quantity(b.clearance.value, "m"),
                    r.equilibrium ? quantity(b.settled_bend_radius, "m") : "", r.equilibrium ? quantity(b.settled_clearance.value, "m") : ""});
  std::string text = card.text();
  if (!rows.empty())
    text += "\n" + table_text({"branch", "from", "to", "wires", "length", "bend radius", "clearance", "settled bend radius", "settled clearance"}, rows);
  if (!r.design.clips.empty()) text += "\n" + clips_table(r);
  for (const std::string& miss : r.misses) text += "\nnot kept: " + miss;
  for (const std::string& miss : r.settled_misses) text += "\nnot kept once settled: " + miss;
  return text;
}

std::vector<int> counted_from_one(std::vector<int> numbers) {
  for (int& n : numbers) ++n;
  return numbers;
}

ClearanceValue clearance_of_branch(const HarnessBranchHandle& h) {
  const routing::CurveGap& gap = h.branch().clearance;
  const double value = h.branch().clearance_to.empty() ? std::numeric_limits<double>::infinity() : gap.value;
  return {Clearance{value, gap.s, gap.at, gap.on, gap.obstacle}, h.branch().clearance_to, h.harness.result->options.space.clearance,
          value < h.harness.result->options.space.clearance - 1e-5};
}

const std::string example =
    "local mm = units.mm\n"
    "local pvc = rod.material{young = 30e6, poisson = 0.4, density = 1400}\n"
    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
    "local h = method.harness(s, {section = rod.section{outer = 8*mm, material = pvc}, min_bend_radius = 40*mm, bundling = 0.9,\n"
    "  connections = {frame{at = {0, 0, 0}, along = {1, 0, 0}}, frame{at = {0.6, 0.15, 0}, along = {-1, 0, 0}}, frame{at = {0.6, -0.15, 0}, along = {-1, 0, 0}}}})\n";

void bind_parts(lua_State* L) {
  Class<HarnessBranchHandle>(L, "One branch of a routed harness")
      .property("name", "", "Of its rod", [](const HarnessBranchHandle& h) { return h.branch().name; })
      .property("from", "", "Connection or junction", [](const HarnessBranchHandle& h) { return end_name(*h.harness.result, h.branch().from); })
      .property("to", "", "Connection or junction", [](const HarnessBranchHandle& h) { return end_name(*h.harness.result, h.branch().to); })
      .property("wires", "", "Numbers of the wires in it", [](const HarnessBranchHandle& h) { return counted_from_one(h.branch().wires); })
      .property("curve", "", "Its route", [](const HarnessBranchHandle& h) { return h.branch().points.curve(); })
      .property("length", "m", "Of its route", [](const HarnessBranchHandle& h) { return h.branch().length; })
      .property("rod_length", "m", "Of its rod, unstressed", [](const HarnessBranchHandle& h) { return h.harness.result->design.lengths[h.index]; })
      .property("min_bend_radius", "m", "Of its route", [](const HarnessBranchHandle& h) { return h.branch().min_bend_radius; })
      .property("clearance", "m", "Smallest gap of its route, certified", clearance_of_branch)
      .property("settled_bend_radius", "m", "In equilibrium", [](const HarnessBranchHandle& h) { return h.branch().settled_bend_radius; })
      .property("settled_clearance", "m", "In equilibrium", [](const HarnessBranchHandle& h) { return h.branch().settled_clearance.value; })
      .tostring([](const HarnessBranchHandle& h) {
        return h.branch().name + ": " + end_name(*h.harness.result, h.branch().from) + " to " + end_name(*h.harness.result, h.branch().to) + ", " +
               quantity(h.branch().length, "m");
      });
  Class<routing::HarnessClip>(L, "A clip that holds a branch of a harness on its route")
      .property("branch", "", "Number of the branch", [](const routing::HarnessClip& c) { return c.branch + 1; })
      .property("at", "m", "Arc length along the unstressed rod", [](const routing::HarnessClip& c) { return c.at; })
      .property("route_at", "m", "Arc length along the route", [](const routing::HarnessClip& c) { return c.route_at; })
      .property("frame", "", "Of the section that it holds", [](const routing::HarnessClip& c) { return c.frame; })
      .property("obstacle", "", "To which it is fastened", [](const routing::HarnessClip& c) { return c.obstacle; })
      .property("force", "N", "That it bears at rest", [](const routing::HarnessClip& c) { return c.force; });
  Class<routing::HarnessJunction>(L, "A branch point of a routed harness")
      .property("frame", "", "As routed; along the trunk", [](const routing::HarnessJunction& j) { return j.frame; })
      .property("settled", "", "In equilibrium", [](const routing::HarnessJunction& j) { return j.settled; })
      .property("branches", "", "Numbers of the branches, the trunk's two first",
                [](const routing::HarnessJunction& j) { return counted_from_one(j.branches); });
}

}  // namespace

void bind_harness(lua_State* L) {
  bind_parts(L);
  Class<HarnessHandle>(L, "A branched harness: as routed, and in equilibrium")
      .property("ok", "", "The route keeps all that is demanded, and came to rest; see settled_misses for what gravity takes away", [](const HarnessHandle& h) { return h.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"stalled\", \"cancelled\", \"timeout\"", [](const HarnessHandle& h) { return name_of(h.result->status); })
      .property("message", "", "What there is to say about it", [](const HarnessHandle& h) { return h.result->message; })
      .property("seconds", "s", "Run time", [](const HarnessHandle& h) { return h.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const HarnessHandle& h) { return h.result->steps; })
      .property("branches", "", "List of branches", [](const HarnessHandle& h) {
        std::vector<HarnessBranchHandle> all;
        for (std::size_t i = 0; i < h.result->branches.size(); ++i) all.push_back({h, static_cast<int>(i)});
        return all;
      })
      .property("junctions", "", "List of branch points", [](const HarnessHandle& h) { return h.result->junctions; })
      .property("misses", "", "What is not kept, in words", [](const HarnessHandle& h) { return h.result->misses; })
      .property("settled_misses", "", "What the route keeps, but the harness at rest does not, in words", [](const HarnessHandle& h) { return h.result->settled_misses; })
      .property("harness_length", "m", "Of all branches", [](const HarnessHandle& h) { return h.result->harness_length; })
      .property("cable_length", "m", "Over all wires", [](const HarnessHandle& h) { return h.result->cable_length; })
      .property("wire_lengths", "m", "By wire, from connection to connection along the route", [](const HarnessHandle& h) { return h.result->wire_lengths; })
      .property("clips", "", "List of clips, by branch", [](const HarnessHandle& h) { return h.result->design.clips; })
      .property("cost", "m", "Of the route: what a metre costs, by weights, preferences and wires, along all branches", [](const HarnessHandle& h) { return h.result->cost; })
      .property("preference", "m", "Integral along the route of what clearance weight and preferences make a metre cost more", [](const HarnessHandle& h) { return h.result->preference; })
      .property("restarts", "", "That refinement took", [](const HarnessHandle& h) { return h.result->restarts; })
      .property("length_in_collision", "m", "Settled, where it penetrates an obstacle", [](const HarnessHandle& h) { return h.result->length_in_collision; })
      .property("equilibrium", "", "Rods named as the branches; nil: none",
                [](const HarnessHandle& h) { return std::const_pointer_cast<SceneEquilibrium>(h.result->equilibrium); })
      .method("scene", {.does = "A new scene: the obstacles, and the harness as rods joined at its branch points and held by its clips.",
                        .example = example + "print(h:scene())"},
              [](const HarnessHandle& h) { return std::make_shared<Scene>(routing::scene_of(*h.scene, *h.result)); })
      .tostring(describe_harness);
}

void add_harness_to(Module& method) {
  method.function("harness",
                  {.takes = {"scene"}, .options = harness_schema(),
                   .does = "A branched harness between several connections: where it branches, how it runs, and how it settles under gravity.",
                   .example = example + "print(h.ok, #h.branches, #h.junctions)  --> true\t3\t1"},
                  [](lua_State* state, const std::shared_ptr<Scene>& scene, const Options& o) {
                    return HarnessHandle{std::make_shared<const HarnessResult>(routing::route_harness(*scene, harness_options(o), method_context(state, o))), scene};
                  });
}

}  // namespace tendril::lua
