// KBL files: what is read of a harness hangs together and is finite, and becomes a scene or is refused.
#include <cmath>

#include "fuzz_target.h"
#include "harness/import_harness.h"

using namespace tendril;

namespace {

void expect_curve(const HarnessCurve& curve) {
  for (const Vec3& point : curve.points) fuzz::expect(point.allFinite(), "control points are finite");
  for (const double weight : curve.weights) fuzz::expect(std::isfinite(weight), "weights are finite");
  fuzz::expect(curve.weights.empty() || curve.weights.size() == curve.points.size(), "each control point has a weight");
  fuzz::expect(curve.knots.empty() || curve.knots.size() == curve.points.size() + curve.degree + 1, "knots go with the control points");
}

void expect_sound(const HarnessFile& file) {
  const int nodes = static_cast<int>(file.nodes.size()), wires = static_cast<int>(file.wires.size());
  for (const HarnessNode& node : file.nodes) fuzz::expect(node.at.allFinite() && std::isfinite(node.min_bend_radius), "nodes are finite");
  for (const HarnessSegment& segment : file.segments) {
    fuzz::expect(segment.start >= -1 && segment.start < nodes && segment.finish >= -1 && segment.finish < nodes, "segments join nodes");
    for (const int wire : segment.wires) fuzz::expect(wire >= 0 && wire < wires, "segments hold wires");
    for (const HarnessCurve& curve : segment.curves) expect_curve(curve);
    for (const double length : {segment.virtual_length, segment.physical_length, segment.area})
      fuzz::expect(std::isfinite(length), "lengths are finite");
    for (const HarnessFixing& fixing : segment.fixings)
      fuzz::expect(fixing.location >= 0 && fixing.location <= 1, "fixings lie on their segments");
  }
  for (const HarnessWire& wire : file.wires) {
    for (const double value : {wire.outer, wire.conductor_area, wire.mass, wire.min_bend_radius, wire.stated_length})
      fuzz::expect(std::isfinite(value) && value >= 0, "what is known of wires is finite and not negative");
    for (const int segment : wire.segments)
      fuzz::expect(segment >= 0 && segment < static_cast<int>(file.segments.size()), "wires run through segments");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  HarnessFile file;
  if (!fuzz::accepts("scene.import: input.kbl", [&] { file = parse_kbl(fuzz::text_of(data, size), "input.kbl"); })) return 0;
  expect_sound(file);
  Scene scene(Vec3(0, 0, -9.81));
  ImportedHarness harness;
  if (!fuzz::accepts("scene.import: ", [&] { harness = import_harness(file, {}, scene); })) return 0;
  fuzz::expect(harness.segments.size() == file.segments.size(), "each segment is accounted for");
  for (const ImportedSegment& segment : harness.segments) {
    fuzz::expect(segment.rod.empty() != segment.left_out.empty(), "a segment is a rod, or it is said why not");
    if (!segment.rod.empty())
      fuzz::expect(std::isfinite(segment.length) && segment.length > 0 && std::isfinite(segment.EI) && segment.EI > 0, "rods have a length and a stiffness");
  }
  return 0;
}
