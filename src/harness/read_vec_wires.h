// The wires of a VEC file and the segments they run through.
#pragma once

#include "harness/harness_file.h"
#include "harness/vec_units.h"

namespace tendril {

/// Adds the wires to `found`, and to each of its segments those that run through it. A wire is a component with a WireRole, however
/// many cores it has. What is not taken is named in found.skipped. Throws UsageError, at its line, for what refers to nothing.
/// Source: VDA 4968, the guidelines on wires and on routing.
void read_vec_wires(const XmlFile& file, const VecUnits& units, HarnessFile& found);

}  // namespace tendril
