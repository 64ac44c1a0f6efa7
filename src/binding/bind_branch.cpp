// branch: rigid junctions of a harness.
#include "binding/bind_branch.h"

#include "binding/card.h"
#include "binding/examples.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

using Where = std::variant<std::string, double>;
/// {"a", "finish"}, or {"a", "finish", frame}.
using Joined = std::variant<std::tuple<std::string, Where, Frame>, std::tuple<std::string, Where>>;

Schema branch_options() {
  return {option<Frame>("frame", "", "Where the branch point is held, fully; default: free, it finds its place")};
}

Schema hold_options() {
  return {
      option<bool>("position", "", "The place is held").preset(true),
      option<bool>("orientation", "", "The orientation is held").preset(true),
  };
}

BranchPlace place_of(const Scene& scene, const Joined& joined) {
  return std::visit(
      [&](const auto& entry) {
        BranchPlace place;
        place.rod = &scene.rod(std::get<0>(entry));
        const Where& where = std::get<1>(entry);
        const std::string* end = std::get_if<std::string>(&where);
        place.at = end ? place.rod->place(*end) : std::get<double>(where);
        if constexpr (std::tuple_size_v<std::decay_t<decltype(entry)>> == 3) place.relative = std::get<2>(entry);
        return place;
      },
      joined);
}

std::string describe_branch(const PlacedBranchHandle& handle) {
  const PlacedBranch& branch = handle.branch();
  Card card("branch point '" + branch.name + "'");
  for (const JoinedPlace& place : branch.places) card.row("'" + place.rod + "'", handle.scene->rod(place.rod).describe(place.at));
  const char* held = branch.position && branch.orientation ? "fully" : branch.position ? "position" : "orientation";
  card.row("held", branch.position || branch.orientation ? held : "no, it finds its place");
  return card.text();
}

}  // namespace

void add_branch_to(Class<Scene>& scene) {
  scene
      .property("branches", "", "Names of the branch points",
                [](const Scene& s) {
                  std::vector<std::string> names;
                  for (const auto& branch : s.branches()) names.push_back(branch->name);
                  return names;
                })
      .method("branch",
              {.takes = {"name", "places"}, .options = branch_options(),
               .does = "Joins sections of rods, {rod, place} each, to one rigid body. Their relative frames are kept from where "
                       "the rods are held there now, and the branch point takes those holds' place; a third entry gives a "
                       "section's frame seen from the branch point instead.",
               .example = "local rubber = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
                          "local r = rod.new{length = 0.4, section = rod.section{outer = 0.012, material = rubber}}\n"
                          "local s = scene.new{gravity = {0, 0, -9.81}}\n"
                          "s:rod(\"trunk\", r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})\n"
                          "s:rod(\"left\", r, {to = frame{at = {0.6, 0.3, 0}, along = {1, 0, 0}}})\n"
                          "s:rod(\"right\", r, {to = frame{at = {0.6, -0.3, 0}, along = {1, 0, 0}}})\n"
                          "s:branch(\"fork\", {{\"trunk\", \"finish\"}, {\"left\", \"start\"}, {\"right\", \"start\"}})\n"
                          "print(s:solve{}.ok)  --> true"},
              [](std::shared_ptr<Scene> s, const std::string& name, const std::vector<Joined>& places, const Options& o) {
                std::vector<BranchPlace> joined;
                for (const Joined& place : places) joined.push_back(place_of(*s, place));
                s->join(name, joined, o.maybe<Frame>("frame"));
                return PlacedBranchHandle{s, name};
              });
}

void bind_branch(lua_State* L) {
  Class<PlacedBranchHandle>(L, "A rigid junction of rods in a scene")
      .property("name", "", "Its name in the scene", [](const PlacedBranchHandle& b) { return b.name; })
      .property("rods", "", "Names of the rods that it joins",
                [](const PlacedBranchHandle& b) {
                  std::vector<std::string> names;
                  for (const JoinedPlace& place : b.branch().places) names.push_back(place.rod);
                  return names;
                })
      .method("hold", {.takes = {"frame"}, .options = hold_options(), .does = "Holds it in place, in orientation or both.",
                       .example = with_hose("local b = s:branch(\"end\", {{\"hose\", \"finish\"}})\n"
                                            "b:hold(frame{at = {0.8, 0, 0}, along = {1, 0, 0}})")},
              [](std::shared_ptr<PlacedBranchHandle> b, const Frame& frame, const Options& o) {
                PlacedBranch& branch = b->branch();
                branch.frame = frame;
                branch.position = o.get<bool>("position");
                branch.orientation = o.get<bool>("orientation");
                if (!branch.position && !branch.orientation)
                  throw UsageError("placed_branch:hold: neither position nor orientation of '" + b->name + "' is held; use release");
                return b;
              })
      .method("release", {.does = "Lets it find its own place.",
                          .example = with_hose("s:branch(\"end\", {{\"hose\", \"finish\"}}):release()")},
              [](std::shared_ptr<PlacedBranchHandle> b) {
                b->branch().position = b->branch().orientation = false;
                return b;
              })
      .tostring(describe_branch);
}

}  // namespace tendril::lua
