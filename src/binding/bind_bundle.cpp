// wire, bundle: sections of wiring harnesses from the wires in them.
#include "binding/bind_bundle.h"

#include "base/units.h"
#include "binding/bundle_classes.h"
#include "binding/card.h"
#include "binding/scene_classes.h"

namespace tendril::lua {

/// An entry of a list of wires: a wire, or {wire =, count =}. A type of its own, as a wire alone is a class.
struct CountedWire {
  BundleWire wire;
};

template <>
struct Value<CountedWire> {
  static const Kind& kind() {
    static const Kind kind{"a wire, or a table {wire =, count =}", "wire|{wire: wire, count: integer}", &wrong};
    return kind;
  }
  static std::string wrong(lua_State* L, int index) {
    if (Value<BundleWire>::kind().wrong(L, index).empty()) return "";
    if (!lua_istable(L, index)) return describe(L, index);
    index = lua_absindex(L, index);
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
      lua_pop(L, 1);
      const std::string key = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : describe(L, -1);
      if (key == "wire" || key == "count") continue;
      lua_pop(L, 1);
      return "a table with '" + key + "'";
    }
    lua_getfield(L, index, "wire");
    std::string got = Value<BundleWire>::kind().wrong(L, -1);
    lua_pop(L, 1);
    if (!got.empty()) return "'wire' = " + got;
    lua_getfield(L, index, "count");
    if (!lua_isnil(L, -1)) got = Value<int>::kind().wrong(L, -1);
    lua_pop(L, 1);
    return got.empty() ? "" : "'count' = " + got;
  }
  static CountedWire read(lua_State* L, int index) {
    if (Value<BundleWire>::kind().wrong(L, index).empty()) return {Value<BundleWire>::read(L, index)};
    lua_getfield(L, index, "wire");
    CountedWire entry{Value<BundleWire>::read(L, -1)};
    lua_pop(L, 1);
    lua_getfield(L, index, "count");
    if (!lua_isnil(L, -1)) entry.wire.count = Value<int>::read(L, -1);
    lua_pop(L, 1);
    return entry;
  }
};

namespace {

Schema wire_options() {
  return {
      option<double>("outer", "m", "Outside diameter, with insulation").required().above(0),
      option<double>("area", "m^2", "Metal in the conductor; 0: none, a filler or tube").required().at_least(0),
      option<double>("mass", "kg/m", "Measured; default: that of copper and PVC").above(0),
      option<double>("min_bend_radius", "m", "Of its centre line; default: three outside diameters").at_least(0),
      option<double>("conductor", "m", "Diameter of the circle around the conductor's strands; default: metal fills 0.7 of it").above(0),
      option<int>("strands", "", "In the conductor; default: as ISO 6722 makes up flexible wires of this area").at_least(1).at_most(1e6),
      option<double>("young", "Pa", "Of the conductor's metal; default: copper").above(0),
      option<double>("insulation_young", "Pa", "Default: soft PVC").above(0),
  };
}

BundleWire make_wire(const Options& o) {
  const double outer = o.get<double>("outer"), area = o.get<double>("area");
  BundleWire wire;
  if (area > 0 && !o.has("conductor")) {
    wire = copper_wire(outer, area, o.maybe<double>("mass").value_or(0));
  } else {
    if (!o.has("mass")) throw UsageError("rod.wire: 'mass' is missing; only that of an insulated copper wire follows from its sizes");
    if (area == 0 && o.has("conductor")) throw UsageError("rod.wire: got a 'conductor' without metal; give its 'area'");
    const BundleWire usual = area > 0 ? copper_wire(2 * outer + 4 * std::sqrt(area), area) : BundleWire{};
    wire.outer = outer;
    wire.conductor = o.maybe<double>("conductor").value_or(0);
    wire.mass = o.get<double>("mass");
    wire.young = usual.young;
    wire.insulation_young = 30e6;
    wire.strands = usual.strands;
    wire.fill = area > 0 ? area / (units::pi / 4 * wire.conductor * wire.conductor) : 1;
    wire.min_bend_radius = 3 * outer;
    if (wire.fill > 1) throw UsageError("rod.wire: 'area' is larger than the circle of 'conductor'");
  }
  wire.min_bend_radius = o.maybe<double>("min_bend_radius").value_or(wire.min_bend_radius);
  wire.strands = o.maybe<int>("strands").value_or(wire.strands);
  wire.young = o.maybe<double>("young").value_or(wire.young);
  wire.insulation_young = o.maybe<double>("insulation_young").value_or(wire.insulation_young);
  bundle_of({wire});  // tells what makes no sense
  return wire;
}

Schema bundle_options() {
  return {
      option<std::vector<CountedWire>>("wires", "", "List of wires, or of {wire =, count =}").required(),
      option<double>("slip", "", "How freely wires and strands slip: 1 freely, 0 glued; default 0.85, with tape 0.7").at_least(0).at_most(1),
      option<bool>("taped", "", "Wound with tape, half overlapped").preset(false),
      option<double>("tape_thickness", "m", "All layers, on the radius").above(0).preset(0.26e-3),
      option<double>("tape_young", "Pa", "Of the tape").above(0).preset(30e6),
      option<double>("tape_density", "kg/m^3", "Of the tape").at_least(0).preset(1300),
      option<double>("packing", "", "Wires' area over that of the circle around them; default: the known packings up to seven equal "
                                    "wires, otherwise 0.694").above(0).at_most(1),
  };
}

Pushed make_bundle(lua_State* L, const Options& o) {
  std::vector<BundleWire> wires;
  for (const CountedWire& entry : o.get<std::vector<CountedWire>>("wires")) wires.push_back(entry.wire);
  BundleOptions options;
  options.slip = o.maybe<double>("slip");
  options.taped = o.get<bool>("taped");
  options.tape_thickness = o.get<double>("tape_thickness");
  options.tape_young = o.get<double>("tape_young");
  options.tape_density = o.get<double>("tape_density");
  options.packing = o.maybe<double>("packing");
  const Bundle bundle = bundle_of(wires, options);
  Value<Section>::push(L, bundle.section);
  Value<Bundle>::push(L, bundle);
  return {2};
}

using Range = std::array<double, 2>;

void bind_classes(lua_State* L) {
  const auto number = [](double BundleWire::*member) { return [member](const BundleWire& w) { return w.*member; }; };
  Class<BundleWire>(L, "An insulated wire, for bundles")
      .property("outer", "m", "Outside diameter, with insulation", number(&BundleWire::outer))
      .property("conductor", "m", "Diameter of the circle around the conductor's strands", number(&BundleWire::conductor))
      .property("area", "m^2", "Metal in the conductor",
                [](const BundleWire& w) { return w.fill * units::pi / 4 * w.conductor * w.conductor; })
      .property("strands", "", "In the conductor", [](const BundleWire& w) { return w.strands; })
      .property("mass", "kg/m", "Mass per length", number(&BundleWire::mass))
      .property("min_bend_radius", "m", "Of its centre line; 0: not stated", number(&BundleWire::min_bend_radius))
      .property("young", "Pa", "Of the conductor's metal", number(&BundleWire::young))
      .property("insulation_young", "Pa", "Of the insulation", number(&BundleWire::insulation_young))
      .tostring([](const BundleWire& w) {
        return Card("wire").row("outer", w.outer, "m").row("conductor", w.conductor, "m", std::to_string(w.strands) + " strands")
            .row("mass", w.mass, "kg/m").row("min bend radius", w.min_bend_radius, "m").text();
      });
  Class<Bundle>(L, "How the section of a bundle came about")
      .property("section", "", "For rod.new", [](const Bundle& b) { return b.section; })
      .property("outer", "m", "Outside diameter, with tape", [](const Bundle& b) { return b.outer; })
      .property("min_bend_radius", "m", "Of the bundle's centre line, so that no wire inside bends below its own; 0: none stated",
                [](const Bundle& b) { return b.min_bend_radius; })
      .property("EI_range", "N m^2", "{wires and strands slip freely, all glued}", [](const Bundle& b) { return Range{b.EI_slipping, b.EI_glued}; })
      .property("GJ_range", "N m^2", "{wires and strands slip freely, all glued}", [](const Bundle& b) { return Range{b.GJ_slipping, b.GJ_glued}; })
      .property("slip", "", "That was used: 1 slips freely, 0 glued", [](const Bundle& b) { return b.slip; })
      .tostring([](const Bundle& b) {
        return Card("bundle").row("outer", b.outer, "m").row("min bend radius", b.min_bend_radius, "m")
            .row("EI", b.section.EI1, "N m^2", "from " + quantity(b.EI_slipping, "N m^2") + " slipping to " + quantity(b.EI_glued, "N m^2") + " glued")
            .row("GJ", b.section.GJ, "N m^2", "from " + quantity(b.GJ_slipping, "N m^2") + " to " + quantity(b.GJ_glued, "N m^2"))
            .row("mass", b.section.mass, "kg/m").row("slip", b.slip, "").text();
      });
}

}  // namespace

void add_bundles_to(lua_State* L, Module& rod) {
  bind_classes(L);
  const std::string wire = "local mm = units.mm\nlocal w = rod.wire{outer = 1.6*mm, area = 0.5*mm^2, mass = 6e-3}\n";
  rod.function("wire",
               {.options = wire_options(), .does = "An insulated stranded wire, by default of copper and PVC.", .example = wire + "print(w.strands)  --> 14"},
               make_wire)
      .function("bundle",
                {.options = bundle_options(), .returns = "section, bundle",
                 .does = "The section of a bundle of wires, its stiffness between that of wires that slip freely and wires that are glued; "
                         "and how it came about.",
                 .example = wire + "local section, about = rod.bundle{wires = {{wire = w, count = 7}}, taped = true}\n"
                                   "print(section.outer / mm, about.min_bend_radius / mm)\nprint(about)"},
                make_bundle);
}

}  // namespace tendril::lua
