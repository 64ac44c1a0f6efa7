// Only the outer boundary of an envelope is kept: what lies outside all hulls but cannot be left without crossing their
// surface is filled.
#pragma once

#include "base/run_context.h"
#include "method/envelope/field.h"

namespace tendril::envelope {

/// Sets the nodes of cavities in FieldBlock::solid, with all that floats inside them. Nodes outside are connected along
/// the grid's edges, as the surface separates them. Returns the number of cavities.
int fill_cavities(const BlockMap& map, Field& field);

}  // namespace tendril::envelope
