// What a VEC file places on its topology: fixings on segments, connectors and other components at nodes.
#pragma once

#include "harness/harness_file.h"
#include "harness/vec_units.h"

namespace tendril {

/// Adds fixings to the segments of `found` and names of components to its nodes. Protections, which lie along segments, are counted
/// in found.skipped with whatever else is not taken. Throws UsageError, at its line, for what refers to nothing.
/// Source: VDA 4968, the guideline on routing, and the classes of locations.
void read_vec_placements(const XmlFile& file, const VecUnits& units, HarnessFile& found);

}  // namespace tendril
