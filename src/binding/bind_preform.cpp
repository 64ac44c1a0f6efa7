// method.preform: distinct preformed hoses through real surroundings.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "base/write_file.h"
#include "binding/bind_method.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/method_options.h"
#include "binding/method_steps.h"
#include "binding/number_like.h"
#include "binding/preform_classes.h"
#include "binding/routing_options.h"
#include "binding/saved_file.h"
#include "binding/scene_classes.h"
#include "geometry/mesh_export.h"
#include "method/preform/settle.h"

namespace tendril::lua {
namespace {

Schema preform_schema() {
  return routing_schema() +
         Schema{
             option<int>("max_bends", "", "At most").at_least(0).at_most(30).preset(6),
             option<double>("max_turn", "rad", "Largest angle of one bend").above(0).below(units::pi).preset(3.0),
             option<double>("min_length", "m", "Least length").at_least(0).preset(0),
             option<double>("max_length", "m", "Largest length").above(0),
             option<double>("from_cone", "rad", "Half angle of the cone in which the direction of the start may turn").at_least(0).below(units::pi / 2).preset(0),
             option<double>("to_cone", "rad", "The same of the finish").at_least(0).below(units::pi / 2).preset(0),
             option<double>("grid", "m", "Step of the search for passages").above(0).at_most(1).preset(20 * units::mm),
             option<double>("exclusion", "m", "Paths of the search keep this far from earlier ones").above(0).preset(60 * units::mm),
             option<int>("max_paths", "", "Paths of the search, at most").at_least(1).at_most(1000).preset(30),
             option<double>("max_detour", "", "Paths of the search cost at most so many times what the cheapest one costs").at_least(1).preset(6.0),
             option<double>("same", "m", "Hoses nearer than this all along count as one").above(0).preset(25 * units::mm),
         } +
         method_schema();
}

preform::Options preform_options(const Options& o) {
  preform::Options options;
  options.ends = routing_ends(o);
  options.space = space_demands(o);
  options.curve = pcc_demands(o);
  options.curve.max_turn = o.get<double>("max_turn");
  options.curve.min_length = o.get<double>("min_length");
  if (o.has("max_length")) options.curve.max_length = o.get<double>("max_length");
  options.curve.start_cone = o.get<double>("from_cone");
  options.curve.finish_cone = o.get<double>("to_cone");
  options.max_bends = o.get<int>("max_bends");
  options.grid = o.get<double>("grid");
  options.exclusion = o.get<double>("exclusion");
  options.exclusion_ends = 2 * options.exclusion;
  options.max_paths = o.get<int>("max_paths");
  options.max_detour = o.get<double>("max_detour");
  options.same = o.get<double>("same");
  return options;
}

// --- hoses

const Section& section_of(const HoseHandle& h, const char* who) {
  if (!h.set.section) throw UsageError(std::string(who) + ": what is the hose made of? give method.preform a 'section' instead of 'outer'");
  return *h.set.section;
}

/// Elements of at most an eighth of the sharpest bend, and at least 40.
int segments_for(const HoseHandle& h) {
  const double piece = h.set.result->options.curve.radii.front() / 4;
  return std::max(40, static_cast<int>(std::ceil(h.hose().length / piece)));
}

Rod rod_of(const HoseHandle& h) { return preform::formed_rod(h.hose().points.curve(), section_of(h, "hose.rod"), segments_for(h)); }

ClearanceValue clearance_of_hose(const HoseHandle& h) {
  const routing::CurveGap& gap = h.hose().clearance;
  const std::string& name = h.hose().clearance_to;
  const double value = gap.obstacle < 0 ? std::numeric_limits<double>::infinity() : gap.value;
  const Clearance clearance{value, gap.s, gap.at, gap.on, gap.obstacle};
  const double required = gap.obstacle < 0 ? 0 : h.set.result->space->surroundings().clearance(gap.obstacle);
  return {clearance, name, required, gap.obstacle >= 0 && gap.value < required - 1e-5};
}

/// CSV text as an aligned table.
std::string aligned(const std::string& csv) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  for (const char c : csv) {
    if (c == '\n') rows.emplace_back(1);
    else if (c == ',') rows.back().emplace_back();
    else rows.back().back() += c;
  }
  if (rows.back().size() == 1 && rows.back().front().empty()) rows.pop_back();
  const std::vector<std::string> head = rows.front();
  rows.erase(rows.begin());
  return table_text(head, rows);
}

std::string csv_of(const HoseHandle& h, const std::string& kind) {
  if (kind == "LRA") return preform::lra_csv(h.hose().points);
  if (kind == "XYZ") return preform::xyz_csv(h.hose().points);
  return preform::centre_line_csv(h.hose().points);
}

MeshValue mesh_of(const HoseHandle& h) {
  const double inner = h.set.section ? h.set.section->inner : 0;
  return make_mesh_value(preform::tube_mesh(h.hose().points, h.outer(), inner));
}

SavedFile save_hose(const HoseHandle& h, const std::string& path, const Options& o) {
  const std::string kind = o.get<std::string>("table");
  if (path.size() > 4 && path.substr(path.size() - 4) == ".csv") {
    write_file(path, csv_of(h, kind));
  } else {
    const std::string unit = o.maybe<std::string>("unit").value_or("m");
    save_mesh(path, mesh_of(h).mesh(), metres_per(unit));
  }
  return {path, Status::solved, 0};
}

SettledHandle settle_hose(lua_State* L, const HoseHandle& h, const Options& o) {
  const int segments = o.maybe<int>("segments").value_or(segments_for(h));
  const preform::Settled settled = preform::settle(*h.set.scene, h.hose().points.curve(), section_of(h, "hose:settle"), segments,
                                                   solve_options(o), run_context(L, o));
  return {settled.equilibrium, settled.moved, settled.at};
}

std::string describe_hose(const HoseHandle& h) {
  const preform::Hose& hose = h.hose();
  Card card("hose " + std::to_string(h.index + 1) + ": " + hose.label);
  card.row("length", hose.length, "m").row("bends", std::to_string(hose.points.bends()));
  if (hose.points.bends() > 0) card.row("bend radius", *std::min_element(hose.points.radii.begin(), hose.points.radii.end()), "m");
  if (hose.clearance.obstacle >= 0)
    card.row("clearance", hose.clearance.value, "m", "to '" + hose.clearance_to + "' at s = " + quantity(hose.clearance.s, "m"));
  card.row("passage", std::to_string(hose.passage));
  return card.text() + "\n" + aligned(preform::lra_csv(hose.points));
}

// --- the set

std::string describe_set(const PreformHandle& set) {
  const preform::Result& r = *set.result;
  Card card("preformed hoses");
  card.row("status", r.ok ? "solved" : name_of(r.status), r.message).row("time", r.seconds, "s");
  std::string text = card.text();
  if (r.hoses.empty()) return text;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < r.hoses.size(); ++i) {
    const preform::Hose& hose = r.hoses[i];
    rows.push_back({std::to_string(i + 1), quantity(hose.length, "m"), std::to_string(hose.points.bends()),
                    hose.clearance.obstacle < 0 ? "none near" : quantity(hose.clearance.value, "m"), std::to_string(hose.passage), hose.label});
  }
  return text + "\n" + table_text({"hose", "length", "bends", "clearance", "passage", "what sets it apart"}, rows);
}

std::string report(const PreformHandle& set) {
  std::string text = describe_set(set);
  text += "\n\n" + steps_table(set.result->steps);
  for (const std::string& miss : set.result->near_misses) text += "\nnear miss: " + miss;
  for (std::size_t i = 0; i < set.result->hoses.size(); ++i) text += "\n\n" + describe_hose({set, static_cast<int>(i)});
  return text;
}

const std::string example =
    "local mm = units.mm\n"
    "local s = scene.new{}\n"
    "s:obstacle(\"post\", scene.cylinder{radius = 40*mm, length = 1}, {clearance = 5*mm})\n"
    "local hoses = method.preform(s, {from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},\n"
    "                                 outer = 20*mm, min_bend_radius = 50*mm, min_straight = 10*mm})\n";

void bind_bend(lua_State* L) {
  Class<preform::Bend>(L, "One bend of a hose, as the bending machine makes it")
      .property("radius", "m", "Of the centre line", [](const preform::Bend& b) { return b.radius; })
      .property("angle", "rad", "How far it turns", [](const preform::Bend& b) { return b.angle; })
      .property("plane", "rad", "Turn of its plane against the last bend's, right-handed about the way forward; 0 for the first",
                [](const preform::Bend& b) { return b.plane; })
      .property("straight_before", "m", "Between the last bend, or the start, and this one", [](const preform::Bend& b) { return b.straight_before; })
      .property("s", "m", "Arc length where it begins", [](const preform::Bend& b) { return b.begin; })
      .property("vertex", "m", "Where the straights before and after it would meet", [](const preform::Bend& b) { return b.vertex; })
      .tostring([](const preform::Bend& b) {
        return "bend of " + quantity(b.angle, "rad") + " with a radius of " + quantity(b.radius, "m") + " after " + quantity(b.straight_before, "m");
      });
}

void bind_hose(lua_State* L) {
  Class<HoseHandle>(L, "A preformed hose: straights joined by bends")
      .property("curve", "", "The centre line", [](const HoseHandle& h) { return h.hose().points.curve(); })
      .property("rod", "", "As a design for scene:rod; needs a section", rod_of)
      .property("from", "", "Frame of its start, for scene:rod", [](const HoseHandle& h) { return h.hose().points.curve().at(0); })
      .property("to", "", "Frame of its finish", [](const HoseHandle& h) {
        const Curve curve = h.hose().points.curve();
        return curve.at(curve.length());
      })
      .property("length", "m", "Of the centre line", [](const HoseHandle& h) { return h.hose().length; })
      .property("objective", "m", "Length, or what it costs with preferences", [](const HoseHandle& h) { return h.hose().objective; })
      .property("bends", "", "List of bends", [](const HoseHandle& h) { return preform::bends_of(h.hose().points); })
      .property("clearance", "m", "Smallest gap, with .at, .on, .s; certified along its true arcs and straights", clearance_of_hose)
      .property("passage", "", "Hoses with one number can be moved into each other", [](const HoseHandle& h) { return h.hose().passage; })
      .property("label", "", "What sets it apart", [](const HoseHandle& h) { return h.hose().label; })
      .property("mesh", "", "Its surface, to save, or to place as an obstacle for the next hose", mesh_of)
      .method("table", {.takes = {"kind"}, .does = "Its bending table as text, mm and degrees: \"LRA\" (length, rotation, angle) or \"XYZ\".",
                        .example = example + "print(hoses[1]:table(\"LRA\"))"},
              [](const HoseHandle& h, const std::optional<std::string>& kind) {
                const std::string wanted = kind.value_or("LRA");
                if (wanted != "LRA" && wanted != "XYZ") throw UsageError("hose:table: got '" + wanted + "', expected 'LRA' or 'XYZ'");
                return aligned(csv_of(h, wanted));
              })
      .method("save", {.takes = {"path"},
                       .options = {option<std::string>("table", "", "What a .csv holds").one_of({"LRA", "XYZ", "centre_line"}).preset("LRA"),
                                   option<std::string>("unit", "", "Of a mesh; default \"m\"").one_of({"mm", "cm", "m", "in"})},
                       .does = "Writes a table as .csv (mm, degrees), or its surface as .stl, .ply, .obj or .glb.",
                       .example = example + "hoses[1]:save(\"hose.csv\", {table = \"XYZ\"})\nhoses[1]:save(\"hose.stl\", {unit = \"mm\"})"},
              save_hose)
      .method("settle", {.options = solve_schema() + timeout_schema() + Schema{option<int>("segments", "", "Elements; default by its bends").at_least(1)},
                         .does = "Gravity check: how far its equilibrium is from the shape as formed, with .equilibrium, .s. Needs a section.",
                         .example = "local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
                                    "local s = scene.new{gravity = {0, 0, -9.81}}\n"
                                    "local hoses = method.preform(s, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.4, 0.2, 0}, along = {0, 1, 0}},\n"
                                    "  section = rod.section{outer = 0.02, inner = 0.012, material = rubber}, min_bend_radius = 0.05})\n"
                                    "print(hoses[1]:settle() < 0.02)  --> true"},
              settle_hose)
      .tostring(describe_hose);
}

}  // namespace

void bind_preform(lua_State* L) {
  bind_bend(L);
  Class<SettledHandle> settled(L, "How far gravity moves a hose; computes as a number (m)");
  settled.property("value", "m", "Largest distance from the shape as formed", [](const SettledHandle& s) { return s.moved; })
      .property("s", "m", "Arc length where", [](const SettledHandle& s) { return s.at; })
      .property("ok", "", "The equilibrium was found", [](const SettledHandle& s) { return s.equilibrium->ok(); })
      .property("equilibrium", "", "Of the rod \"hose\"", [](const SettledHandle& s) { return s.equilibrium; })
      .tostring([](const SettledHandle& s) {
        return s.equilibrium->ok() ? "moves by " + quantity(s.moved, "m") + " at s = " + quantity(s.at, "m") : s.equilibrium->message();
      });
  compute_as_number(settled);
  bind_hose(L);
  Class<PreformHandle>(L, "Distinct hoses, the best first: #hoses, hoses[i]")
      .property("ok", "", "There is at least one hose, and the search was not stopped", [](const PreformHandle& r) { return r.result->ok; })
      .property("status", "", "\"solved\", \"infeasible\", \"cancelled\", \"timeout\"", [](const PreformHandle& r) { return name_of(r.result->status); })
      .property("message", "", "How many, or what stood in the way", [](const PreformHandle& r) { return r.result->message; })
      .property("seconds", "s", "Run time", [](const PreformHandle& r) { return r.result->seconds; })
      .property("steps", "", "Name, seconds, counts of each", [](const PreformHandle& r) { return r.result->steps; })
      .property("passages", "", "Number of passages that the hoses take", [](const PreformHandle& r) { return r.result->passages; })
      .property("near_misses", "", "What the best candidates lack where nothing is feasible", [](const PreformHandle& r) { return r.result->near_misses; })
      .method("report", {.does = "The card, the steps and every hose with its bending table, as text.", .example = example + "print(hoses:report())"}, report)
      .list([](const PreformHandle& r) { return r.result->hoses.size(); },
            [](const PreformHandle& r, std::size_t i) { return HoseHandle{r, static_cast<int>(i)}; })
      .tostring(describe_set);
}

void add_preform_to(Module& method) {
  method.function("preform",
                  {.takes = {"scene"}, .options = preform_schema(),
                   .does = "Distinct preformed hoses between two frames, ranked: straights and bends that keep what is demanded, as short as can be.",
                   .example = example + "print(hoses.ok, hoses.passages)  --> true\t2"},
                  [](lua_State* state, const std::shared_ptr<Scene>& scene, const Options& o) {
                    const RunContext context = method_context(state, o);
                    return PreformHandle{std::make_shared<const preform::Result>(preform::run(*scene, preform_options(o), context)), scene,
                                         routed_section(o)};
                  });
}

}  // namespace tendril::lua
