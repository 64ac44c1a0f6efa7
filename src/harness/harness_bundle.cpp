#include "harness/harness_bundle.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace tendril {
namespace {

constexpr double smallest_wire = 0.1e-3;       // m
constexpr double usual_outer = 1.6e-3, usual_area = 0.5e-6;  // a 0.5 mm^2 wire, where only a cross-section is stated
constexpr double usual_packing = 0.694;        // as in bundle_of

bool names(const std::string& text, const char* word) {
  const auto same = [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; };
  const std::string_view wanted = word;
  return std::search(text.begin(), text.end(), wanted.begin(), wanted.end(), same) != text.end();
}

/// Across the circle around a conductor's strands, of which metal fills 0.7.
double conductor_across(double area) { return std::sqrt(area * 4 / (0.7 * std::numbers::pi)); }

BundleWire wire_of(const HarnessWire& wire, std::string& note) {
  double outer = wire.outer;
  if (outer < smallest_wire && wire.conductor_area > 0) {
    outer = 1.6 * conductor_across(wire.conductor_area);  // as thin-walled wires are
    note = "the outside of wires without one follows from their conductors";
  }
  double area = wire.conductor_area;
  if (area <= 0 || conductor_across(area) > 0.97 * outer) {
    // Thin-walled wires: the conductor's metal fills about 0.28 of the whole.
    area = 0.28 * std::numbers::pi / 4 * outer * outer;
    note = "the conductors of wires that state none, or one that does not fit, follow from their outside";
  }
  BundleWire made = copper_wire(outer, area, wire.mass);
  if (wire.min_bend_radius > 0) made.min_bend_radius = wire.min_bend_radius;
  return made;
}

std::vector<BundleWire> wires_of(const HarnessFile& file, const HarnessSegment& segment, std::string& note) {
  std::vector<BundleWire> wires;
  for (const int k : segment.wires) {
    const HarnessWire& wire = file.wires[k];
    if (wire.outer < smallest_wire && wire.conductor_area <= 0) {
      note = "wire '" + wire.name + "' states no size and does not count";
      continue;
    }
    wires.push_back(wire_of(wire, note));
  }
  if (!wires.empty() || segment.area <= 0) return wires;
  note = "no wires run through it: filled with 0.5 mm^2 wires";
  const double share = usual_packing * segment.area / (std::numbers::pi / 4 * usual_outer * usual_outer);
  wires.push_back(copper_wire(usual_outer, usual_area, 0, std::clamp(static_cast<int>(std::lround(share)), 1, 100000)));
  return wires;
}

}  // namespace

SegmentBundle segment_bundle(const HarnessFile& file, const HarnessSegment& segment, const std::optional<double>& slip) {
  SegmentBundle found;
  const std::vector<BundleWire> wires = wires_of(file, segment, found.note);
  if (wires.empty()) return found;
  BundleOptions options;
  options.slip = slip;
  double taped = 0, mass = 0;
  for (const HarnessProtection& around : segment.protections) {
    mass += around.mass * (around.to - around.from);
    if (names(around.kind, "TAPE")) taped += around.to - around.from;
  }
  options.taped = taped > 0.5;
  if (mass > 0) options.tape_density = 0;  // the file says what it weighs
  found.bundle = bundle_of(wires, options);
  found.bundle.section.mass += mass;
  found.known = true;
  return found;
}

}  // namespace tendril
