// A first guess that does not cross the surroundings.
//
// The usual first guess sags freely and may hang through a floor, from where no force leads back. Tried in turn: the usual
// guess; the same sagging less, as if the rod were still being paid out; the bulge turned about the chord, to the sides and
// up; free ends curled up, to the sides and down. The first without a crossing is taken; where all cross, the ways around
// the rim of what they cross (contact_detour.h) are tried, and the one that suits the rod's length best is taken. A shape
// that is given and crosses is led around what it crosses before anything else is tried.
#pragma once

#include "statics/contact_network.h"

namespace tendril {

struct ContactStart {
  RodState state;
  int crossings = 0;    ///< pairs of neighbouring contact points with a surface between them
  int tried = 0;
};

/// Branch points stay where the network's first guess, or the given shape, has them; the rods are changed one by one.
/// `near`: a shape to keep as much of as possible; null: none.
ContactStart clear_start(const RodNetwork& network, ContactNetwork& contact, const RodState* near = nullptr);

}  // namespace tendril
