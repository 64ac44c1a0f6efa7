// scene.import: harness files (KBL) become scenes, with a report of what they hold and how well it fits together.
#include "binding/bind_import.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "binding/card.h"
#include "binding/scene_classes.h"
#include "harness/departure.h"
#include "harness/write_kbl.h"

namespace tendril::lua {

/// A segment or wire of an imported harness, by its number in the file.
struct ImportedSegmentHandle {
  std::shared_ptr<const ImportedHarness> harness;
  std::size_t index = 0;
  const ImportedSegment& made() const { return harness->segments[index]; }
  const HarnessSegment& drawn() const { return harness->file.segments[index]; }
};
/// The whole.
struct ImportedHandle {
  std::shared_ptr<const ImportedHarness> harness;
  const ImportedHarness* operator->() const { return harness.get(); }
};
struct ImportedWireHandle {
  std::shared_ptr<const ImportedHarness> harness;
  std::size_t index = 0;
  const HarnessWire& wire() const { return harness->file.wires[index]; }
  double length() const {
    double sum = 0;
    for (const int k : wire().segments) sum += harness->segments[k].rod.empty() ? 0 : harness->segments[k].length;
    return sum;
  }
};

template <> inline constexpr const char* class_name<ImportedHandle> = "imported_harness";
template <> inline constexpr const char* class_name<ImportedSegmentHandle> = "imported_segment";
template <> inline constexpr const char* class_name<ImportedWireHandle> = "imported_wire";

namespace {

Schema import_schema() {
  return {
      option<Vec3>("gravity", "m/s^2", "Acceleration in the file's axes; default or zero: the term is left out"),
      option<std::string>("shape", "", "Without load: as the file draws it, or straight, as bundles come off the build board")
          .one_of({"drawn", "straight"}).preset("drawn"),
      option<std::string>("clips", "", "What fixings hold: everything, everything but sliding, the place only, or nothing")
          .one_of({"fixed", "slide", "swivel", "none"}).preset("fixed"),
      option<double>("slip", "", "How freely wires slip in their bundles, 1 freely, 0 not at all; default as in rod.bundle").at_least(0).at_most(1),
      option<double>("element", "m", "Longest element of a rod; bends make them shorter").at_least(1e-4).at_most(10).preset(25e-3),
  };
}

HarnessImportOptions import_options(const Options& o) {
  HarnessImportOptions options;
  options.gravity = o.maybe<Vec3>("gravity").value_or(Vec3::Zero());
  options.shape = o.get<std::string>("shape") == "straight" ? HarnessShape::straight : HarnessShape::drawn;
  const std::string clips = o.get<std::string>("clips");
  options.clips = clips == "fixed"    ? HarnessClip::fixed
                  : clips == "slide"  ? HarnessClip::slide
                  : clips == "swivel" ? HarnessClip::swivel
                                      : HarnessClip::none;
  options.slip = o.maybe<double>("slip");
  options.element = o.get<double>("element");
  return options;
}

Pushed import(lua_State* L, const std::string& path, const Options& o) {
  const HarnessImportOptions options = import_options(o);
  auto scene = std::make_shared<Scene>(options.gravity);
  const ImportedHandle harness{std::make_shared<const ImportedHarness>(import_harness(read_harness(path), options, *scene, run_context(L)))};
  Value<std::shared_ptr<Scene>>::push(L, scene);
  Value<ImportedHandle>::push(L, harness);
  return {2};
}

std::vector<std::string> names_of(const std::vector<int>& wires, const HarnessFile& file) {
  std::vector<std::string> names;
  for (const int k : wires) names.push_back(file.wires[k].name);
  return names;
}

/// How far lengths are from those that the file states, over what was taken: the middle one and the largest.
struct LengthsOff {
  double median = 0, largest = 0;
  std::size_t stated = 0;
};

LengthsOff lengths_off(const ImportedHarness& harness) {
  std::vector<double> off;
  for (const ImportedSegment& segment : harness.segments)
    if (!segment.rod.empty() && segment.stated_length > 0) off.push_back(std::abs(segment.length - segment.stated_length));
  if (off.empty()) return {};
  std::sort(off.begin(), off.end());
  return {off[off.size() / 2], off.back(), off.size()};
}

std::string describe_harness(const ImportedHarness& h) {
  double length = 0, mass = 0, thinnest = std::numeric_limits<double>::infinity(), thickest = 0;
  std::size_t taken = 0;
  for (const ImportedSegment& segment : h.segments) {
    if (segment.rod.empty()) continue;
    ++taken;
    length += segment.length;
    mass += segment.mass;
    thinnest = std::min(thinnest, segment.outer);
    thickest = std::max(thickest, segment.outer);
  }
  const LengthsOff off = lengths_off(h);
  Card card("harness '" + h.file.name + "'");
  card.row("format", h.file.format).row("nodes", std::to_string(h.file.nodes.size()));
  card.row("segments", std::to_string(taken), "of " + std::to_string(h.segments.size()));
  card.row("length", length, "m").row("mass", mass, "kg");
  card.row("bundles", quantity(thinnest, "m") + " to " + quantity(thickest, "m"), std::to_string(h.file.wires.size()) + " wires");
  if (off.stated > 0)
    card.row("lengths off", off.median, "m", "the median of " + std::to_string(off.stated) + ", at most " + quantity(off.largest, "m"));
  card.row("branch points", std::to_string(h.branches)).row("held ends", std::to_string(h.held_ends)).row("clips", std::to_string(h.clips));
  std::string text = card.text();
  for (const std::string& note : h.notes) text += "\nnote: " + note;
  return text;
}

const char* const example = "local s, harness = scene.import(\"builtin:t_harness\", {gravity = {0, 0, -9.81}})\n";

Pushed departure_of(lua_State* L, const ImportedSegmentHandle& segment, const SceneEquilibrium& eq) {
  if (segment.made().rod.empty())
    throw UsageError("imported_segment:departure: segment '" + segment.drawn().id + "' was left out: " + segment.made().left_out);
  const Departure found = departure(*segment.harness, static_cast<int>(segment.index), eq.rod(segment.made().rod).equilibrium);
  Value<double>::push(L, found.distance);
  Value<double>::push(L, found.s);
  Value<Vec3>::push(L, found.settled - found.drawn);
  return {3};
}

void bind_segment(lua_State* L) {
  using S = ImportedSegmentHandle;
  Class<S>(L, "A segment of an imported harness")
      .property("rod", "", "The name of its rod in the scene; empty: it was left out", [](const S& s) { return s.made().rod; })
      .property("name", "", "What the file calls it", [](const S& s) { return s.drawn().name; })
      .property("left_out", "", "Why it was left out; empty: it was not", [](const S& s) { return s.made().left_out; })
      .property("length", "m", "Of its centre line", [](const S& s) { return s.made().length; })
      .property("stated_length", "m", "What the file says; 0: nothing", [](const S& s) { return s.made().stated_length; })
      .property("cut_off", "m", "Of the drawn curve beyond its nodes", [](const S& s) { return s.made().cut_off; })
      .property("outer", "m", "Across the bundle of its wires", [](const S& s) { return s.made().outer; })
      .property("stated_outer", "m", "From the cross-section that the file states; 0: none", [](const S& s) { return s.made().stated_outer; })
      .property("min_bend_radius", "m", "Allowed by its wires and nodes; 0: not stated", [](const S& s) { return s.made().min_bend_radius; })
      .property("drawn_bend_radius", "m", "The smallest of the drawn line", [](const S& s) { return s.made().drawn_bend_radius; })
      .property("EI", "N m^2", "Bending stiffness that was taken", [](const S& s) { return s.made().EI; })
      .property("EI_slipping", "N m^2", "Lower bound: every strand bends by itself", [](const S& s) { return s.made().EI_slipping; })
      .property("EI_glued", "N m^2", "Upper bound: nothing slips", [](const S& s) { return s.made().EI_glued; })
      .property("mass", "kg", "Of the segment", [](const S& s) { return s.made().mass; })
      .property("clips", "", "Fixings that hold it", [](const S& s) { return s.made().clips; })
      .property("wires", "", "Names of the wires through it", [](const S& s) { return names_of(s.drawn().wires, s.harness->file); })
      .method("departure", {.takes = {"equilibrium"}, .returns = "number, number, vec",
                            .does = "How far the settled rod lies from the drawn line, at most: m, the arc length there, and the way from the "
                                    "drawn place to the settled one.",
                            .example = std::string(example) + "local far, at, way = harness.segments[1]:departure(s:solve{})\n"
                                                              "assert(far > 0 and way.z < 0)"},
              departure_of)
      .tostring([](const S& s) {
        const ImportedSegment& m = s.made();
        Card card("segment '" + s.drawn().id + "'");
        if (m.rod.empty()) card.row("left out", m.left_out);
        card.row("length", m.length, "m", m.stated_length > 0 ? "stated " + quantity(m.stated_length, "m") : "");
        card.row("outer", m.outer, "m", m.stated_outer > 0 ? "stated " + quantity(m.stated_outer, "m") : "");
        card.row("EI", m.EI, "N m^2", quantity(m.EI_slipping, "N m^2") + " to " + quantity(m.EI_glued, "N m^2"));
        card.row("bend radius drawn", m.drawn_bend_radius, "m");
        if (m.min_bend_radius > 0) card.row("bend radius allowed", m.min_bend_radius, "m");
        card.row("wires", std::to_string(s.drawn().wires.size())).row("clips", std::to_string(m.clips));
        return card.text();
      });
}

void bind_wire(lua_State* L) {
  using W = ImportedWireHandle;
  Class<W>(L, "A wire or cable of an imported harness")
      .property("name", "", "Its number in the harness, else that of its part", [](const W& w) { return w.wire().name; })
      .property("type", "", "As the file has it", [](const W& w) { return w.wire().type; })
      .property("length", "m", "Of the segments it runs through", [](const W& w) { return w.length(); })
      .property("stated_length", "m", "What the file says; 0: nothing", [](const W& w) { return w.wire().stated_length; })
      .property("outer", "m", "Outside diameter; 0: not stated", [](const W& w) { return w.wire().outer; })
      .property("conductor_area", "m^2", "Of all its cores; 0: not stated", [](const W& w) { return w.wire().conductor_area; })
      .property("mass", "kg/m", "Per length; 0: not stated", [](const W& w) { return w.wire().mass; })
      .property("segments", "", "Ids of the segments it runs through",
                [](const W& w) {
                  std::vector<std::string> ids;
                  for (const int k : w.wire().segments) ids.push_back(w.harness->file.segments[k].id);
                  return ids;
                })
      .tostring([](const W& w) {
        Card card("wire '" + w.wire().name + "'");
        card.row("length", w.length(), "m", std::to_string(w.wire().segments.size()) + " segments");
        card.row("outer", w.wire().outer, "m").row("mass", w.wire().mass, "kg/m");
        return card.text();
      });
}

/// By wire, the rods it runs through; of several wires with one name the later ones are called "name (2)" and so on.
std::map<std::string, std::vector<std::string>> rods_by_wire(const ImportedHarness& harness) {
  std::map<std::string, std::vector<std::string>> rods;
  for (const HarnessWire& wire : harness.file.wires) {
    std::string name = wire.name;
    for (int k = 2; rods.count(name) > 0; ++k) name = wire.name + " (" + std::to_string(k) + ")";
    std::vector<std::string>& through = rods[name];
    for (const int k : wire.segments)
      if (!harness.segments[k].rod.empty()) through.push_back(harness.segments[k].rod);
  }
  return rods;
}

template <class Handle>
std::vector<Handle> handles(const std::shared_ptr<const ImportedHarness>& harness, std::size_t count) {
  std::vector<Handle> found;
  for (std::size_t k = 0; k < count; ++k) found.push_back({harness, k});
  return found;
}

}  // namespace

void add_import(lua_State* L, Module& scene) {
  bind_segment(L);
  bind_wire(L);
  Class<ImportedHandle>(L, "What a harness file holds, and what became of it in the scene")
      .property("name", "", "Part description or number", [](const ImportedHandle& h) { return h->file.name; })
      .property("format", "", "Of the file", [](const ImportedHandle& h) { return h->file.format; })
      .property("segments", "", "All of the file's, in its order",
                [](const ImportedHandle& h) { return handles<ImportedSegmentHandle>(h.harness, h->segments.size()); })
      .property("wires", "", "Wires and cables", [](const ImportedHandle& h) { return handles<ImportedWireHandle>(h.harness, h->file.wires.size()); })
      .property("wire_rods", "", "By wire, the names of the rods it runs through: for equilibrium:quantities",
                [](const ImportedHandle& h) { return rods_by_wire(*h.harness); })
      .property("notes", "", "What was assumed, mended or left out", [](const ImportedHandle& h) { return h->notes; })
      .property("clips", "", "Fixings that hold rods", [](const ImportedHandle& h) { return h->clips; })
      .property("branches", "", "Branch points", [](const ImportedHandle& h) { return h->branches; })
      .property("held_ends", "", "Ends held where they are drawn", [](const ImportedHandle& h) { return h->held_ends; })
      .property("median_length_off", "m", "Median of the differences between segments' lengths and what the file states",
                [](const ImportedHandle& h) { return lengths_off(*h.harness).median; })
      .property("largest_length_off", "m", "The largest of them", [](const ImportedHandle& h) { return lengths_off(*h.harness).largest; })
      .method("save", {.takes = {"path", "equilibrium"},
                       .does = "Writes the .kbl file back with the settled centre curves, lengths and nodes in place of the drawn ones; the rest "
                               "stays as it was, byte for byte.",
                       .example = std::string(example) + "harness:save(\"settled.kbl\", s:solve{})"},
              [](const ImportedHandle& h, const std::string& path, const SceneEquilibrium& eq) { save_kbl(path, *h.harness, eq); })
      .tostring([](const ImportedHandle& h) { return describe_harness(*h.harness); });
  scene.function("import",
                 {.takes = {"path"}, .options = import_schema(), .returns = "scene, imported_harness",
                  .does = "A harness file (.kbl, .vec) as a scene: a rod for every segment with the section of its bundle of wires, branch points, "
                          "connectors and fixings as holds; and a report of what the file holds and how well it fits together.",
                  .example = std::string(example) + "print(#s.rods, harness.clips)  --> 3\t1"},
                 import);
}

}  // namespace tendril::lua
