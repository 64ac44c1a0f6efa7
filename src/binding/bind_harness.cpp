// method.harness: a branched harness between several connections.
#include <limits>

#include "base/units.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
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
template <> inline constexpr const char* class_name<routing::HarnessJunction> = "harness_junction";

namespace {

using routing::HarnessResult;
using BoxOfCorners = std::array<Vec3, 2>;

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
             option<double>("clearance", "m", "Least gap to every obstacle; an obstacle's own larger one stands").at_least(0).preset(0),
             option<double>("free_ends", "m", "Length from the connections within which no gap is asked for").at_least(0).preset(0),
             option<BoxOfCorners>("keep_in", "m", "{corner, corner}: the whole harness stays within this box"),
             option<double>("grid", "m", "Step of the search").above(0).at_most(1).preset(20 * units::mm),
             option<bool>("settle", "", "Find its equilibrium under gravity").preset(true),
         } +
         method_schema();
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
  options.space.clearance = o.get<double>("clearance");
  options.free_ends = o.get<double>("free_ends");
  if (const auto box = o.maybe<BoxOfCorners>("keep_in"))
    options.space.keep_in = Eigen::AlignedBox3d((*box)[0].cwiseMin((*box)[1]), (*box)[0].cwiseMax((*box)[1]));
  options.grid = o.get<double>("grid");
  options.equilibrium = o.get<bool>("settle");
  return options;
}

std::string end_name(const HarnessResult& r, const routing::HarnessEnd& end) {
  if (end.junction) return "junction " + std::to_string(end.number + 1);
  return r.options.names.empty() ? std::to_string(end.number + 1) : r.options.names[end.number];
}

/// What the harness keeps as routed and no longer once gravity has settled it, in words.
std::vector<std::string> settled_misses(const HarnessResult& r) {
  std::vector<std::string> misses;
  if (!r.equilibrium) return misses;
  for (const routing::HarnessBranch& b : r.branches) {
    if (b.settled_bend_radius < r.options.min_bend_radius * (1 - 1e-6))
      misses.push_back(b.name + ": bend radius " + quantity(b.settled_bend_radius, "m") + ", " + quantity(r.options.min_bend_radius, "m") + " demanded");
    if (b.settled_clearance.value < r.options.space.clearance - 1e-5)
      misses.push_back(b.name + ": gap " + quantity(b.settled_clearance.value, "m") + ", " + quantity(r.options.space.clearance, "m") + " demanded");
  }
  return misses;
}

std::string describe_harness(const HarnessHandle& h) {
  const HarnessResult& r = *h.result;
  Card card("harness");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  card.row("harness length", r.harness_length, "m").row("cable length", r.cable_length, "m");
  card.row("branches", std::to_string(r.branches.size())).row("junctions", std::to_string(r.junctions.size()));
  card.row("in collision", r.length_in_collision, "m", r.equilibrium ? "settled" : "as routed");
  std::vector<std::vector<std::string>> rows;
  for (const routing::HarnessBranch& b : r.branches)
    rows.push_back({b.name, end_name(r, b.from), end_name(r, b.to), std::to_string(b.wires.size()), quantity(b.length, "m"),
                    quantity(b.min_bend_radius, "m"), b.clearance_to.empty() ? "none near" : quantity(b.clearance.value, "m"),
                    r.equilibrium ? quantity(b.settled_bend_radius, "m") : "", r.equilibrium ? quantity(b.settled_clearance.value, "m") : ""});
  std::string text = card.text();
  if (!rows.empty())
    text += "\n" + table_text({"branch", "from", "to", "wires", "length", "bend radius", "clearance", "settled bend radius", "settled clearance"}, rows);
  for (const std::string& miss : r.misses) text += "\nnot kept: " + miss;
  for (const std::string& miss : settled_misses(r)) text += "\nnot kept once settled: " + miss;
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
      .property("min_bend_radius", "m", "Of its route", [](const HarnessBranchHandle& h) { return h.branch().min_bend_radius; })
      .property("clearance", "m", "Smallest gap of its route, certified", clearance_of_branch)
      .property("settled_bend_radius", "m", "In equilibrium", [](const HarnessBranchHandle& h) { return h.branch().settled_bend_radius; })
      .property("settled_clearance", "m", "In equilibrium", [](const HarnessBranchHandle& h) { return h.branch().settled_clearance.value; })
      .tostring([](const HarnessBranchHandle& h) {
        return h.branch().name + ": " + end_name(*h.harness.result, h.branch().from) + " to " + end_name(*h.harness.result, h.branch().to) + ", " +
               quantity(h.branch().length, "m");
      });
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
      .property("settled_misses", "", "What the route keeps, but not the settled harness, in words", [](const HarnessHandle& h) { return settled_misses(*h.result); })
      .property("harness_length", "m", "Of all branches", [](const HarnessHandle& h) { return h.result->harness_length; })
      .property("cable_length", "m", "Over all wires", [](const HarnessHandle& h) { return h.result->cable_length; })
      .property("length_in_collision", "m", "Settled, where it penetrates an obstacle", [](const HarnessHandle& h) { return h.result->length_in_collision; })
      .property("equilibrium", "", "Rods named as the branches; nil: none",
                [](const HarnessHandle& h) { return std::const_pointer_cast<SceneEquilibrium>(h.result->equilibrium); })
      .method("scene", {.does = "A new scene: the obstacles, and the harness as rods joined at its branch points.",
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
