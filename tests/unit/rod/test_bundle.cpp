// Bundles of wires against hand-worked values, sums over known places, and the bounds that no bundle may leave.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/units.h"
#include "rod/bundle.h"

using namespace tendril;
using Catch::Matchers::Contains;
using units::pi;

namespace {

/// 1.6 mm over the insulation, 0.5 mm^2 of copper, 6 g/m.
BundleWire signal_wire(int count = 1) { return copper_wire(1.6e-3, 0.5e-6, 6e-3, count); }

BundleWire solid_wire(double outer, double conductor, int count = 1) {
  return {.outer = outer, .conductor = conductor, .young = 100e9, .insulation_young = 20e6, .mass = 0.01,
          .min_bend_radius = 5 * outer, .count = count};
}

double moment(double diameter) { return pi / 64 * std::pow(diameter, 4); }

}  // namespace

TEST_CASE("bundle: one solid wire is that wire") {
  const Bundle one = bundle_of({solid_wire(2e-3, 1e-3)});
  const double EI = 100e9 * moment(1e-3) + 20e6 * (moment(2e-3) - moment(1e-3));
  CHECK(one.outer == 2e-3);
  CHECK(one.EI_slipping == Approx(EI).epsilon(1e-14));
  CHECK(one.EI_glued == Approx(EI).epsilon(1e-14));
  CHECK(one.section.EI1 == Approx(EI).epsilon(1e-14));
  CHECK(one.section.EI2 == one.section.EI1);
  CHECK(one.section.EA == Approx(100e9 * pi / 4 * 1e-6 + 20e6 * pi / 4 * 3e-6).epsilon(1e-14));
  CHECK(one.section.GJ == Approx(2 * (100e9 / 2.68 * moment(1e-3) + 20e6 / 2.9 * (moment(2e-3) - moment(1e-3)))).epsilon(1e-14));
  CHECK(one.section.mass == 0.01);
  CHECK(one.min_bend_radius == Approx(0.01));
}

TEST_CASE("bundle: a stranded conductor bends between its strands and its circle") {
  BundleWire wire = solid_wire(2e-3, 1e-3);
  wire.strands = 19;
  wire.fill = 0.75;
  const Bundle bundle = bundle_of({wire});
  const double insulation = 20e6 * (moment(2e-3) - moment(1e-3));
  CHECK(bundle.EI_slipping == Approx(100e9 * 0.75 * 0.75 / 19 * moment(1e-3) + insulation));
  CHECK(bundle.EI_glued == Approx(100e9 * 0.75 * moment(1e-3) + insulation));
}

TEST_CASE("bundle: up to seven equal wires lie in the known packings") {
  const double D = 2e-3;
  struct Known {
    int count;
    double circle;                              // in wire diameters
    std::vector<std::pair<double, double>> at;  // in wire diameters
  };
  std::vector<Known> known = {{1, 1, {{0, 0}}}, {2, 2, {}}, {3, 2.1547005383792515, {}}, {4, 2.414213562373095, {}},
                              {5, 2.7013016167040798, {}}, {6, 3, {}}, {7, 3, {{0, 0}}}};
  for (Known& k : known) {
    const int ring = k.count - int(k.at.size());
    for (int j = 0; j < ring; ++j)
      k.at.push_back({(k.circle - 1) / 2 * std::cos(2 * pi * j / ring), (k.circle - 1) / 2 * std::sin(2 * pi * j / ring)});
    INFO(k.count << " wires");
    for (const auto& a : k.at) {
      CHECK(std::hypot(a.first, a.second) <= (k.circle - 1) / 2 + 1e-12);  // inside the circle
      for (const auto& b : k.at)
        if (&a != &b) CHECK(std::hypot(a.first - b.first, a.second - b.second) >= 1 - 1e-12);  // apart
    }
    const BundleWire wire = solid_wire(D, 1e-3, k.count);
    const Bundle alone = bundle_of({solid_wire(D, 1e-3)}), bundle = bundle_of({wire});
    CHECK(bundle.outer == Approx(k.circle * D));
    double about_both = 0;  // the mean over the directions of bending
    for (const auto& a : k.at) about_both += 0.5 * D * D * (a.first * a.first + a.second * a.second);
    CHECK(bundle.EI_glued == Approx(k.count * alone.EI_glued + alone.section.EA * about_both));
    CHECK(bundle.EI_slipping == Approx(k.count * alone.EI_slipping));
    CHECK(bundle.section.EA == Approx(k.count * alone.section.EA));
    CHECK(bundle.min_bend_radius == Approx(5 * D + (k.circle - 1) * D / 2));
    // The same wires given one by one.
    const Bundle singly = bundle_of(std::vector<BundleWire>(k.count, solid_wire(D, 1e-3)));
    CHECK(singly.outer == bundle.outer);
    CHECK(singly.EI_glued == Approx(bundle.EI_glued));
  }
}

TEST_CASE("bundle: many wires fill the circle as a uniform disc would") {
  const double D = 1e-3;
  BundleWire wire = solid_wire(D, 0.5e-3, 100'000);
  const Bundle bundle = bundle_of({wire});
  CHECK(bundle.outer == Approx(1.2 * std::sqrt(100'000.0) * D));
  CHECK(bundle.EI_glued == Approx(bundle.section.EA * bundle.outer * bundle.outer / 16).epsilon(1e-4));
  CHECK(bundle_of({wire}, {.packing = 0.8}).outer == Approx(std::sqrt(100'000 / 0.8) * D));
  // Two unequal wires lie side by side, whatever the packing says.
  CHECK(bundle_of({solid_wire(4e-3, 2e-3), solid_wire(1e-3, 0.5e-3)}).outer == Approx(5e-3));
}

TEST_CASE("bundle: slip leads from one bound to the other, tape adds size and mass") {
  const std::vector<BundleWire> wires = {signal_wire(12), copper_wire(2.9e-3, 2.5e-6, 26e-3, 3)};
  const Bundle free = bundle_of(wires, {.slip = 1.0}), glued = bundle_of(wires, {.slip = 0.0}), half = bundle_of(wires, {.slip = 0.5});
  CHECK(free.section.EI1 == Approx(free.EI_slipping));
  CHECK(free.section.GJ == Approx(free.GJ_slipping));
  CHECK(glued.section.EI1 == Approx(glued.EI_glued));
  CHECK(glued.section.GJ == Approx(glued.GJ_glued));
  CHECK(half.section.EI1 == Approx(std::sqrt(half.EI_slipping * half.EI_glued)));
  CHECK(bundle_of(wires).slip == 0.85);
  const Bundle taped = bundle_of(wires, {.taped = true});
  CHECK(taped.slip == 0.7);
  CHECK(taped.outer == Approx(free.outer + 2 * 0.26e-3));
  CHECK(taped.section.mass ==
        Approx(free.section.mass + 1300 * pi / 4 * (taped.outer * taped.outer - free.outer * free.outer)));
  CHECK(taped.EI_slipping == free.EI_slipping);
  CHECK(taped.EI_glued == Approx(free.EI_glued + 30e6 * (moment(taped.outer) - moment(free.outer))));
  CHECK(taped.min_bend_radius == free.min_bend_radius);
}

TEST_CASE("bundle: a typical harness trunk bends like 10 to 100 MPa") {
  for (const bool taped : {false, true}) {
    const Bundle trunk = bundle_of({signal_wire(30)}, {.taped = taped});
    const double modulus = trunk.section.EI1 / moment(trunk.outer);
    INFO(modulus);
    CHECK(modulus > 10e6);
    CHECK(modulus < 100e6);
  }
}

TEST_CASE("bundle: random bundles keep the order of the bounds and do not care for the order of the wires") {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> size(0.5e-3, 8e-3), share(0.1, 0.9), radius(0, 0.1);
    std::uniform_int_distribution<int> kinds(1, 6), count(1, 12), strands(1, 80);
    std::vector<BundleWire> wires(kinds(random));
    double mass = 0, widest = 0, discs = 0;
    for (BundleWire& wire : wires) {
      wire = solid_wire(size(random), 0, count(random));
      wire.conductor = wire.outer * share(random);
      wire.strands = strands(random);
      wire.fill = wire.strands == 1 ? 1 : 0.75;
      wire.min_bend_radius = radius(random);
      mass += wire.count * wire.mass;
      widest = std::max(widest, wire.outer);
      discs += wire.count * wire.outer * wire.outer;
    }
    const Bundle bundle = bundle_of(wires);
    CHECK(bundle.EI_slipping <= bundle.EI_glued * (1 + 1e-12));
    CHECK(bundle.GJ_slipping <= bundle.GJ_glued * (1 + 1e-12));
    CHECK(bundle.section.EI1 >= bundle.EI_slipping * (1 - 1e-12));
    CHECK(bundle.section.EI1 <= bundle.EI_glued * (1 + 1e-12));
    CHECK(bundle.section.mass == Approx(mass));
    CHECK(bundle.outer >= widest);
    CHECK(bundle.outer * bundle.outer >= discs * (1 - 1e-12));
    for (const BundleWire& wire : wires) CHECK(bundle.min_bend_radius >= wire.min_bend_radius);
    std::shuffle(wires.begin(), wires.end(), random);
    const Bundle shuffled = bundle_of(wires);
    CHECK(shuffled.outer == Approx(bundle.outer));
    CHECK(shuffled.section.EI1 == Approx(bundle.section.EI1));
    CHECK(shuffled.section.GJ == Approx(bundle.section.GJ));
  }
}

TEST_CASE("bundle: copper wires from what harness files state") {
  struct Row {
    double area, outer, mass, largest_conductor;  // mm^2, mm, g/m, mm: thin-walled wires of ISO 6722
  };
  for (const Row& row : {Row{0.35, 1.3, 4.5, 0.9}, {0.5, 1.6, 6, 1.1}, {0.75, 1.9, 9, 1.3}, {1, 2.1, 11, 1.5}, {1.5, 2.4, 16, 1.8},
                         {2.5, 3.0, 26, 2.2}, {4, 3.7, 42, 2.8}, {6, 4.3, 61, 3.4}}) {
    INFO(row.area << " mm^2");
    const BundleWire wire = copper_wire(row.outer * 1e-3, row.area * 1e-6);
    CHECK(wire.mass == Approx(row.mass * 1e-3).epsilon(0.12));
    CHECK(wire.conductor < row.largest_conductor * 1e-3);
    CHECK(wire.fill * pi / 4 * wire.conductor * wire.conductor == Approx(row.area * 1e-6));
    CHECK(wire.min_bend_radius == Approx(3e-3 * row.outer));
    CHECK(copper_wire(row.outer * 1e-3, row.area * 1e-6, 0.123).mass == 0.123);
  }
  CHECK(copper_wire(1.6e-3, 0.5e-6).strands == 14);
  CHECK(copper_wire(4.3e-3, 6e-6).strands == 79);
  CHECK(copper_wire(1e-3, 0.01e-6).strands == 1);
}

TEST_CASE("bundle: what makes no sense is refused by name") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(bundle_of({}), Contains("got no wires"));
  const auto refused = [](auto change, const char* words) {
    std::vector<BundleWire> wires = {solid_wire(2e-3, 1e-3), solid_wire(2e-3, 1e-3)};
    change(wires[1]);
    CHECK_THROWS_WITH(bundle_of(wires), Contains("of wire 2 is") && Contains(words));
  };
  for (const double bad : {0.0, -1.0, nan, double(INFINITY)}) refused([&](BundleWire& w) { w.outer = bad; }, "'outer'");
  for (const double bad : {-1e-3, 2e-3, nan}) refused([&](BundleWire& w) { w.conductor = bad; }, "'conductor'");
  for (const double bad : {0.0, nan, double(INFINITY)}) refused([&](BundleWire& w) { w.young = bad; }, "'young'");
  for (const double bad : {0.0, nan}) refused([&](BundleWire& w) { w.insulation_young = bad; }, "'insulation_young'");
  for (const double bad : {-1.0, nan}) refused([&](BundleWire& w) { w.mass = bad; }, "'mass'");
  for (const double bad : {-1.0, nan}) refused([&](BundleWire& w) { w.min_bend_radius = bad; }, "'min_bend_radius'");
  for (const int bad : {0, -1, 1'000'001}) refused([&](BundleWire& w) { w.count = bad; }, "'count'");
  refused([&](BundleWire& w) { w.strands = 0; }, "'strands'");
  for (const double bad : {0.0, 1.1, nan}) refused([&](BundleWire& w) { w.fill = bad; }, "'fill'");
  const std::vector<BundleWire> good = {solid_wire(2e-3, 1e-3)};
  for (const double bad : {-0.1, 1.1, nan}) CHECK_THROWS_WITH(bundle_of(good, {.slip = bad}), Contains("'slip'"));
  for (const double bad : {0.0, 1.1, nan}) CHECK_THROWS_WITH(bundle_of(good, {.packing = bad}), Contains("'packing'"));
  CHECK_THROWS_WITH(bundle_of(good, {.taped = true, .tape_thickness = -1}), Contains("'tape_thickness' is -1"));
  CHECK_THROWS_WITH(bundle_of(good, {.taped = true, .tape_young = 0}), Contains("'tape_young' is 0"));
  CHECK_THROWS_WITH(bundle_of(good, {.taped = true, .tape_density = nan}), Contains("'tape_density'"));
  CHECK_THROWS_WITH(copper_wire(0, 1e-6), Contains("'outer' is 0"));
  CHECK_THROWS_WITH(copper_wire(1e-3, nan), Contains("'area'"));
  CHECK_THROWS_WITH(copper_wire(1e-3, 6e-6), Contains("less than 'outer' = 1 mm"));
  CHECK_THROWS_WITH(copper_wire(2e-3, 1e-6, -1), Contains("'mass'"));
}
