#include "rod/bundle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {
namespace {

using units::pi;

constexpr double conductor_poisson = 0.34, insulation_poisson = 0.45;
constexpr double shop_packing = 1 / (1.2 * 1.2);
constexpr int max_count = 1'000'000;

double shear_of(double young, double poisson) { return young / (2 * (1 + poisson)); }

double disc_area(double diameter) { return pi / 4 * diameter * diameter; }

/// About a diameter.
double second_moment(double diameter) { return pi / 64 * diameter * diameter * diameter * diameter; }

struct Stiffness {
  double EA = 0, GA = 0;
  double EI_slipping = 0, EI_glued = 0, GJ_slipping = 0, GJ_glued = 0;
};

void check(bool good, std::size_t wire, const char* what, double got, const char* expected) {
  if (!good)
    throw UsageError("rod.bundle: '" + std::string(what) + "' of wire " + std::to_string(wire + 1) + " is " + number_text(got) +
                     ", expected " + expected);
}

void check(const BundleWire& w, std::size_t k) {
  const auto finite_not_negative = [](double value) { return std::isfinite(value) && value >= 0; };
  const char* not_negative = "a finite number of at least 0";
  check(std::isfinite(w.outer) && w.outer > 0, k, "outer", w.outer, "a finite number above 0");
  check(finite_not_negative(w.conductor) && w.conductor < w.outer, k, "conductor", w.conductor, "at least 0 and less than 'outer'");
  const bool metal = w.conductor > 0;
  check(finite_not_negative(w.young) && (!metal || w.young > 0), k, "young", w.young, "a finite number above 0");
  check(std::isfinite(w.insulation_young) && w.insulation_young > 0, k, "insulation_young", w.insulation_young,
        "a finite number above 0");
  check(finite_not_negative(w.mass), k, "mass", w.mass, not_negative);
  check(finite_not_negative(w.min_bend_radius), k, "min_bend_radius", w.min_bend_radius, not_negative);
  check(w.count >= 1 && w.count <= max_count, k, "count", w.count, "1 to 1000000");
  check(w.strands >= 1 && w.strands <= max_count, k, "strands", w.strands, "1 to 1000000");
  check(w.fill > 0 && w.fill <= 1, k, "fill", w.fill, "above 0 and at most 1");
}

void check(const BundleOptions& o) {
  const auto require = [](bool good, const char* what, double got, const char* expected) {
    if (!good) throw UsageError(std::string("rod.bundle: '") + what + "' is " + number_text(got) + ", expected " + expected);
  };
  if (o.slip) require(*o.slip >= 0 && *o.slip <= 1, "slip", *o.slip, "0 (glued) to 1 (slips freely)");
  if (o.packing) require(*o.packing > 0 && *o.packing <= 1, "packing", *o.packing, "above 0 and at most 1");
  if (!o.taped) return;
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  require(positive(o.tape_thickness), "tape_thickness", o.tape_thickness, "a finite number above 0");
  require(positive(o.tape_young), "tape_young", o.tape_young, "a finite number above 0");
  require(std::isfinite(o.tape_density) && o.tape_density >= 0, "tape_density", o.tape_density, "a finite number of at least 0");
}

/// One wire alone.
Stiffness stiffness_of(const BundleWire& w) {
  const double shear = shear_of(w.young, conductor_poisson), insulation_shear = shear_of(w.insulation_young, insulation_poisson);
  const double metal = w.fill * disc_area(w.conductor), insulation = disc_area(w.outer) - disc_area(w.conductor);
  const double strand_moments = w.strands * second_moment(w.conductor * std::sqrt(w.fill / w.strands));
  const double metal_moment = w.fill * second_moment(w.conductor);
  const double insulation_moment = second_moment(w.outer) - second_moment(w.conductor);
  Stiffness s;
  s.EA = w.young * metal + w.insulation_young * insulation;
  s.GA = shear * metal + insulation_shear * insulation;
  s.EI_slipping = w.young * strand_moments + w.insulation_young * insulation_moment;
  s.EI_glued = w.young * metal_moment + w.insulation_young * insulation_moment;
  s.GJ_slipping = 2 * (shear * strand_moments + insulation_shear * insulation_moment);
  s.GJ_glued = 2 * (shear * metal_moment + insulation_shear * insulation_moment);
  return s;
}

/// The circle around all wires, and where the wires lie in it.
struct Packing {
  double circle = 0;                    ///< m, diameter
  std::optional<double> mean_y_square;  ///< m^2, of the wires' centres, known for the exact packings

  double y_square(const BundleWire& wire) const {
    return mean_y_square ? *mean_y_square : std::max(0.0, (circle * circle - wire.outer * wire.outer) / 16);
  }
};

/// Up to seven equal circles: those beside the axis lie on one ring, and one lies on the axis with seven (and with one).
Packing exact_packing(int count, double wire) {
  static const std::array<double, 8> circle = {0, 1, 2, 1 + 2 / std::sqrt(3.0), 1 + std::sqrt(2.0), 1 + 1 / std::sin(pi / 5), 3, 3};
  const double ring = (circle[count] - 1) * wire / 2;
  const int on_ring = count == 7 ? 6 : count;
  return {circle[count] * wire, on_ring * ring * ring / (2 * count)};
}

Packing pack(const std::vector<BundleWire>& wires, const std::optional<double>& packing) {
  int count = 0;
  bool equal = true;
  double squares = 0;
  std::array<double, 2> widest = {0, 0};
  for (const BundleWire& w : wires) {
    count = std::min(count + w.count, max_count);
    equal = equal && w.outer == wires.front().outer;
    squares += w.count * w.outer * w.outer;
    for (int k = 0; k < std::min(w.count, 2); ++k)
      if (w.outer > widest[0]) widest = {w.outer, widest[0]};
      else widest[1] = std::max(widest[1], w.outer);
  }
  if (count == 1) return {widest[0], 0.0};
  if (equal && count <= 7 && !packing) return exact_packing(count, widest[0]);
  return {std::max(std::sqrt(squares / packing.value_or(shop_packing)), widest[0] + widest[1]), std::nullopt};
}

void add(Stiffness& sum, const BundleWire& wire, const Packing& packing) {
  const Stiffness one = stiffness_of(wire);
  const double y_square = packing.y_square(wire);
  sum.EA += wire.count * one.EA;
  sum.GA += wire.count * one.GA;
  sum.EI_slipping += wire.count * one.EI_slipping;
  sum.EI_glued += wire.count * (one.EI_glued + one.EA * y_square);
  sum.GJ_slipping += wire.count * one.GJ_slipping;
  sum.GJ_glued += wire.count * (one.GJ_glued + one.GA * 2 * y_square);
}

/// Wound tape slips along itself as the bundle bends: it counts in the glued bound alone.
void add_tape(Stiffness& sum, double inside, double outside, const BundleOptions& o) {
  const double moment = second_moment(outside) - second_moment(inside);
  sum.EI_glued += o.tape_young * moment;
  sum.GJ_glued += shear_of(o.tape_young, insulation_poisson) * 2 * moment;
}

double between(double slipping, double glued, double slip) { return std::pow(slipping, slip) * std::pow(glued, 1 - slip); }

}  // namespace

Bundle bundle_of(const std::vector<BundleWire>& wires, const BundleOptions& options) {
  if (wires.empty()) throw UsageError("rod.bundle: got no wires, expected at least one");
  for (std::size_t k = 0; k < wires.size(); ++k) check(wires[k], k);
  check(options);
  const Packing packing = pack(wires, options.packing);
  Stiffness sum;
  Bundle bundle;
  for (const BundleWire& wire : wires) {
    add(sum, wire, packing);
    bundle.section.mass += wire.count * wire.mass;
    if (wire.min_bend_radius > 0)
      bundle.min_bend_radius = std::max(bundle.min_bend_radius, wire.min_bend_radius + 0.5 * (packing.circle - wire.outer));
  }
  bundle.outer = packing.circle;
  if (options.taped) {
    bundle.outer += 2 * options.tape_thickness;
    add_tape(sum, packing.circle, bundle.outer, options);
    bundle.section.mass += options.tape_density * (disc_area(bundle.outer) - disc_area(packing.circle));
  }
  bundle.slip = options.slip.value_or(options.taped ? 0.7 : 0.85);
  bundle.EI_slipping = sum.EI_slipping;
  bundle.EI_glued = sum.EI_glued;
  bundle.GJ_slipping = sum.GJ_slipping;
  bundle.GJ_glued = sum.GJ_glued;
  bundle.section.outer = bundle.outer;
  bundle.section.EA = sum.EA;
  bundle.section.GA1 = bundle.section.GA2 = sum.GA;
  bundle.section.EI1 = bundle.section.EI2 = between(sum.EI_slipping, sum.EI_glued, bundle.slip);
  bundle.section.GJ = between(sum.GJ_slipping, sum.GJ_glued, bundle.slip);
  bundle.section.check();
  return bundle;
}

BundleWire copper_wire(double outer, double conductor_area, double mass, int count) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(outer))
    throw UsageError("rod.wire: 'outer' is " + number_text(outer) + ", expected a finite number above 0 (m)");
  if (!positive(conductor_area))
    throw UsageError("rod.wire: 'area' is " + number_text(conductor_area) + ", expected a finite number above 0 (m^2)");
  constexpr double square_millimetre = 1e-6, copper_density = 8960, pvc_density = 1400;
  struct Strand {
    double up_to, diameter;  // m^2, m
  };
  constexpr std::array<Strand, 4> strands = {{{1, 0.21e-3}, {2.5, 0.26e-3}, {6, 0.31e-3}, {50, 0.41e-3}}};
  double strand = 0.51e-3;
  for (auto row = strands.rbegin(); row != strands.rend(); ++row)
    if (conductor_area <= row->up_to * square_millimetre * (1 + 1e-9)) strand = row->diameter;
  BundleWire wire;
  wire.outer = outer;
  wire.fill = 0.7;
  wire.conductor = std::sqrt(4 * conductor_area / (pi * wire.fill));
  if (wire.conductor >= outer)
    throw UsageError("rod.wire: a conductor of " + number_text(conductor_area / square_millimetre) + " mm^2 is " +
                     number_text(wire.conductor * 1e3) + " mm wide, expected less than 'outer' = " + number_text(outer * 1e3) + " mm");
  wire.strands = int(std::clamp(std::round(conductor_area / disc_area(strand)), 1.0, double(max_count)));
  wire.young = 115e9;
  wire.insulation_young = 30e6;
  wire.mass = mass == 0 ? copper_density * conductor_area + pvc_density * (disc_area(outer) - disc_area(wire.conductor)) : mass;
  wire.min_bend_radius = 3 * outer;
  wire.count = count;
  check(wire, 0);
  return wire;
}

}  // namespace tendril
