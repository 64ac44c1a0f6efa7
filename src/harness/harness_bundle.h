// The section of a harness segment from the wires that run through it and what is wound around them.
#pragma once

#include <string>

#include "harness/harness_file.h"
#include "rod/bundle.h"

namespace tendril {

struct SegmentBundle {
  Bundle bundle;
  std::string note;     ///< empty, or what had to be assumed
  bool known = false;   ///< false: neither wires nor a cross-section in the file
};

/// Cables are taken as bundles of copper wires with their stated sizes. A segment without wires is filled with 0.5 mm^2 wires up to
/// the cross-section that the file states. Tape and tubes count with their share of the segment's length, tubes by mass only.
SegmentBundle segment_bundle(const HarnessFile& file, const HarnessSegment& segment, const std::optional<double>& slip);

}  // namespace tendril
