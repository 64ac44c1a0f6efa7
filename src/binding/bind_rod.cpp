// rod: materials, cross-sections and designs of cables and hoses.
#include <algorithm>
#include <array>
#include <cmath>

#include "binding/bind_bundle.h"
#include "binding/examples.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/card.h"
#include "binding/scene_cards.h"
#include "scene/formed_rod.h"

namespace tendril::lua {

/// An entry of a list of sections: {upto = 0.3, section}.
template <>
struct Value<RodPart> {
  static const Kind& kind() {
    static const Kind kind{"a table {upto = arc length in m, section}", "{upto: number, [1]: section}", &wrong};
    return kind;
  }
  static std::string wrong(lua_State* L, int index) {
    if (!lua_istable(L, index)) return describe(L, index);
    lua_getfield(L, index, "upto");
    std::string got = Value<double>::kind().wrong(L, -1);
    lua_pop(L, 1);
    if (!got.empty()) return "'upto' = " + got;
    lua_geti(L, index, 1);
    got = Value<Section>::kind().wrong(L, -1);
    lua_pop(L, 1);
    return got.empty() ? "" : "its section = " + got;
  }
  static RodPart read(lua_State* L, int index) {
    index = lua_absindex(L, index);
    RodPart part;
    lua_getfield(L, index, "upto");
    part.upto = lua_tonumber(L, -1);
    lua_geti(L, index, 1);
    part.section = Value<Section>::read(L, -1);
    lua_pop(L, 2);
    return part;
  }
  static void push(lua_State* L, const RodPart& part) {
    lua_createtable(L, 1, 1);
    Value<double>::push(L, part.upto);
    lua_setfield(L, -2, "upto");
    Value<Section>::push(L, part.section);
    lua_seti(L, -2, 1);
  }
};

namespace {

using Pair = std::array<double, 2>;
using OneOrTwo = std::variant<double, Pair>;
using SectionOrParts = std::variant<Section, std::vector<RodPart>>;

Pair both(const OneOrTwo& given) {
  if (const double* one = std::get_if<double>(&given)) return {*one, *one};
  return std::get<Pair>(given);
}

Schema material_options() {
  return {
      option<double>("young", "Pa", "Young's modulus").required().above(0),
      option<double>("poisson", "", "Poisson's ratio; give this or shear").above(-1).at_most(0.5),
      option<double>("shear", "Pa", "Shear modulus; give this or poisson").above(0),
      option<double>("density", "kg/m^3", "Mass per volume").required().at_least(0),
  };
}

Material make_material(const Options& o) {
  if (o.has("poisson") == o.has("shear"))
    throw UsageError("rod.material: give exactly one of 'poisson' and 'shear', got " +
                     std::string(o.has("shear") ? "both" : "neither"));
  if (o.has("shear")) return Material::from_shear(o.get<double>("young"), o.get<double>("shear"), o.get<double>("density"));
  return Material::from_poisson(o.get<double>("young"), o.get<double>("poisson"), o.get<double>("density"));
}

Schema section_options() {
  return {
      option<double>("outer", "m", "Outer diameter").required().above(0),
      option<double>("inner", "m", "Inner diameter; 0: solid").at_least(0).preset(0),
      option<Material>("material", "", "What it is made of; the stiffnesses and the mass follow from it"),
      option<double>("EA", "N", "Measured stretch stiffness").above(0),
      option<OneOrTwo>("GA", "N", "Measured shear stiffness, or {along d1, along d2}"),
      option<OneOrTwo>("EI", "N m^2", "Measured bending stiffness, or {about d1, about d2}"),
      option<double>("GJ", "N m^2", "Measured twist stiffness").above(0),
      option<double>("mass", "kg/m", "Measured mass per length").at_least(0),
  };
}

Section measured_section(const Options& o) {
  for (const char* name : {"EA", "GA", "EI", "GJ", "mass"})
    if (!o.has(name))
      throw UsageError(std::string("rod.section: '") + name +
                       "' is missing; give 'material', or all of 'EA', 'GA', 'EI', 'GJ' and 'mass'");
  Section section;
  section.outer = o.get<double>("outer");
  section.inner = o.get<double>("inner");
  section.EA = o.get<double>("EA");
  const Pair shear = both(o.get<OneOrTwo>("GA")), bend = both(o.get<OneOrTwo>("EI"));
  section.GA1 = shear[0];
  section.GA2 = shear[1];
  section.EI1 = bend[0];
  section.EI2 = bend[1];
  section.GJ = o.get<double>("GJ");
  section.mass = o.get<double>("mass");
  section.check();
  return section;
}

Section make_section(const Options& o) {
  const Material* material = o.find<Material>("material");
  if (!material) return measured_section(o);
  for (const char* name : {"EA", "GA", "EI", "GJ", "mass"})
    if (o.has(name))
      throw UsageError(std::string("rod.section: got both 'material' and '") + name + "'; give one or the other");
  return Section::round(o.get<double>("outer"), o.get<double>("inner"), *material);
}

Schema design_options(bool is_new) {
  Option section = option<SectionOrParts>("section", "", "Cross-section, or a list of {upto = s, section} along the rod");
  Option segments = option<int>("segments", "", "Elements along the rod").at_least(1).at_most(Rod::max_segments);
  return {
      is_new ? std::move(section).required() : std::move(section),
      option<double>("length", "m", "Unstressed length; that of the curve when there is a shape").above(0),
      option<Curve>("shape", "", "Unstressed shape of a preformed rod; default straight"),
      is_new ? std::move(segments).preset(40) : std::move(segments),
  };
}

/// One section all along; with several, the last must end where the rod does.
std::vector<RodPart> parts_of(const SectionOrParts& given, double length) {
  if (const Section* section = std::get_if<Section>(&given)) return {{length, *section}};
  return std::get<std::vector<RodPart>>(given);
}

void put_shape(Rod& rod, const Curve& curve, const Options& o) {
  if (o.has("length") && std::abs(o.get<double>("length") - curve.length()) > 1e-9 * curve.length())
    throw UsageError(o.who() + ": 'length' is " + plain_number(o.get<double>("length")) + " m but 'shape' is " +
                     plain_number(curve.length()) + " m long; a preformed rod is as long as its curve, leave 'length' out");
  form(rod, curve);
}

Rod make_rod(const Options& o) {
  Rod rod;
  rod.segments = o.get<int>("segments");
  const Curve* curve = o.find<Curve>("shape");
  if (curve) put_shape(rod, *curve, o);
  else if (o.has("length")) rod.length = o.get<double>("length");
  else throw UsageError("rod.new: 'length' is missing (or 'shape', whose length it then has)");
  rod.parts = parts_of(o.get<SectionOrParts>("section"), rod.length);
  rod.check();
  if (curve) check_bends(rod, *curve, o.who());
  return rod;
}

Rod changed_rod(const Rod& old, const Options& o) {
  Rod rod = old;
  if (o.has("segments")) rod.segments = o.get<int>("segments");
  const Curve* curve = o.find<Curve>("shape");
  if (curve) {
    put_shape(rod, *curve, o);
  } else if (o.has("length")) {
    if (old.shape && o.get<double>("length") != old.length)
      throw UsageError("rod:with: the length of a preformed rod is that of its shape; give a new 'shape' instead");
    rod.length = o.get<double>("length");
  }
  if (o.has("section")) rod.parts = parts_of(o.get<SectionOrParts>("section"), rod.length);
  else if (rod.length != old.length)  // parts keep their share of the length
    for (RodPart& part : rod.parts) part.upto = &part == &rod.parts.back() ? rod.length : part.upto * rod.length / old.length;
  rod.check();
  if (curve) check_bends(rod, *curve, o.who());
  return rod;
}

void bind_material_and_section(lua_State* L) {
  Class<Material>(L, "An isotropic linear-elastic material")
      .property("young", "Pa", "Young's modulus", [](const Material& m) { return m.young; })
      .property("shear", "Pa", "Shear modulus", [](const Material& m) { return m.shear; })
      .property("density", "kg/m^3", "Mass per volume", [](const Material& m) { return m.density; })
      .tostring([](const Material& m) {
        return Card("material").row("young", m.young, "Pa").row("shear", m.shear, "Pa").row("density", m.density, "kg/m^3").text();
      });
  const auto stiffness = [](double Section::*member) { return [member](const Section& s) { return s.*member; }; };
  Class<Section>(L, "A cross-section: its size, stiffnesses and mass")
      .property("outer", "m", "Outer diameter", stiffness(&Section::outer))
      .property("inner", "m", "Inner diameter", stiffness(&Section::inner))
      .property("EA", "N", "Stretch stiffness", stiffness(&Section::EA))
      .property("GA1", "N", "Shear stiffness along d1", stiffness(&Section::GA1))
      .property("GA2", "N", "Shear stiffness along d2", stiffness(&Section::GA2))
      .property("EI1", "N m^2", "Bending stiffness about d1", stiffness(&Section::EI1))
      .property("EI2", "N m^2", "Bending stiffness about d2", stiffness(&Section::EI2))
      .property("GJ", "N m^2", "Twist stiffness", stiffness(&Section::GJ))
      .property("mass", "kg/m", "Mass per length", stiffness(&Section::mass))
      .property("material", "", "What it is made of; nil where the stiffnesses were measured", [](const Section& s) { return s.made_of(); })
      .tostring(describe_section);
}

void bind_design(lua_State* L) {
  Class<Rod>(L, "The design of a cable or hose; it never changes")
      .property("length", "m", "Unstressed", [](const Rod& r) { return r.length; })
      .property("segments", "", "Elements", [](const Rod& r) { return r.segments; })
      .property("mass", "kg", "All of it", [](const Rod& r) { return r.mass(); })
      .property("section", "", "Cross-section, the first when there are several", [](const Rod& r) { return r.parts.front().section; })
      .property("sections", "", "List of {upto =, section} along the rod", [](const Rod& r) { return r.parts; })
      .property("shape", "", "Unstressed shape; nil when straight", [](const Rod& r) -> std::optional<Curve> {
        const Curve* curve = curve_of(r);
        return curve ? std::optional<Curve>(*curve) : std::nullopt;
      })
      .method("section_at", {.takes = {"s"}, .does = "The section at an arc length in m.",
                         .example = with_hose("print(r:section_at(0.5).outer)  --> 0.02")},
              [](const Rod& r, double s) { return r.section_at(s); })
      .method("with",
              {.options = design_options(false), .does = "A changed copy; this one stays as it is.",
               .example = "local m = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
                          "local r = rod.new{length = 1, section = rod.section{outer = 0.02, material = m}}\n"
                          "print(r:with{length = 1.2}.length, r.length)  --> 1.2 1.0"},
              changed_rod)
      .tostring(describe_rod);
}

}  // namespace

void bind_rod(lua_State* L) {
  bind_material_and_section(L);
  bind_design(L);
  Module rod(L, "rod", "What a cable or hose is");
  add_bundles_to(L, rod);
  rod.function("material",
                {.options = material_options(), .does = "An isotropic linear-elastic material.",
                 .example = "print(rod.material{young = 6 * units.MPa, poisson = 0.49, density = 1150})"},
                make_material)
      .function("section",
                {.options = section_options(), .does = "A cross-section, from a material or from measured stiffnesses.",
                 .example = "local m = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
                            "print(rod.section{outer = 18 * units.mm, inner = 10 * units.mm, material = m})\n"
                            "print(rod.section{outer = 0.018, EA = 500, GA = 160, EI = {0.02, 0.03}, GJ = 0.015, mass = 0.2})"},
                make_section)
      .function("new",
                {.options = design_options(true), .does = "A rod design: straight, or preformed by a shape.",
                 .example = "local m = rod.material{young = 6e6, poisson = 0.49, density = 1150}\n"
                            "print(rod.new{length = 1.2, section = rod.section{outer = 0.018, inner = 0.01, material = m}})"},
                make_rod);
}

}  // namespace tendril::lua
