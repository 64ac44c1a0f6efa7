// A first guess that does not cross the surroundings.
//
// The usual first guess sags freely and may hang through a floor, from where no force leads back. Tried in turn: the usual
// guess; the same sagging less, as if the rod were still being paid out; the bulge turned about the chord, to the sides and
// up; free ends curled up, to the sides and down. The first without a crossing is taken, else the one with the fewest.
#pragma once

#include "statics/contact_network.h"

namespace tendril {

struct ContactStart {
  RodState state;
  int crossings = 0;    ///< pairs of neighbouring contact points with a surface between them
  int tried = 0;
};

/// Branch points stay where the network's first guess puts them; the rods are changed one by one.
ContactStart clear_start(const RodNetwork& network, ContactNetwork& contact);

}  // namespace tendril
