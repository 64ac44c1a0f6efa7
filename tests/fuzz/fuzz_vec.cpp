// VEC files: what is read has finite places and curves that can be measured, wires and fixings of sizes that make sense.
#include <cmath>

#include "fuzz_target.h"
#include "harness/centre_line.h"

using namespace tendril;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  HarnessFile file;
  const std::string text(fuzz::text_of(data, size));
  if (!fuzz::accepts("scene.import: ", [&] { file = parse_vec(text, "input.vec"); })) return 0;
  const int nodes = static_cast<int>(file.nodes.size());
  for (const HarnessNode& node : file.nodes) fuzz::expect(node.at.allFinite(), "nodes have finite places");
  for (const HarnessSegment& segment : file.segments) {
    fuzz::expect(segment.start >= 0 && segment.start < nodes && segment.finish >= 0 && segment.finish < nodes, "segments join nodes of the file");
    const double length = CentreLine(file, segment).length();
    fuzz::expect(std::isfinite(length) && length >= 0, "centre lines have a length");
    for (const HarnessFixing& fixing : segment.fixings) fuzz::expect(fixing.location >= 0 && fixing.location <= 1, "fixings lie on their segment");
    for (const int wire : segment.wires) fuzz::expect(wire >= 0 && wire < static_cast<int>(file.wires.size()), "segments hold wires of the file");
  }
  for (const HarnessWire& wire : file.wires)
    for (const double size : {wire.outer, wire.conductor_area, wire.mass, wire.min_bend_radius, wire.stated_length})
      fuzz::expect(std::isfinite(size) && size >= 0, "wires have sizes");
  return 0;
}
