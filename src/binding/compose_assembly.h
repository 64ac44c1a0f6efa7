// What a picture shows of an installation beside the routed configuration, and of a build board.
#pragma once

#include "binding/compose_picture.h"
#include "method/assembly/flatten.h"
#include "method/assembly/options.h"

namespace tendril {

/// So many states, evenly spaced in time, from pale (outside) to full colour, and the handle's path in red. The last state is left
/// out: it is the equilibrium of the picture.
PictureExtras extras_of(const assembly::Result& result, int frames);

/// Names of junctions and ends; names and lengths of rods in mm.
PictureExtras extras_of(const assembly::FlattenResult& board);

}  // namespace tendril
