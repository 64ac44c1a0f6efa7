// A proven manipulation made better: fewer grips, shorter and smoother paths, more clearance. Every change is proven again.
#pragma once

#include <functional>

#include "base/run_context.h"
#include "method/assembly/installed_system.h"
#include "method/assembly/proof.h"

namespace tendril::assembly {

/// Plays a manipulation that begins and ends as the one to be optimised does.
using Prove = std::function<Played(const Manipulation& manipulation, const RunContext& context)>;

struct Optimised {
  Manipulation manipulation;
  Played played;
  int tried = 0, accepted = 0;
};

/// m, of all grips' paths together.
double path_length(const Manipulation& manipulation);

/// In turn: grips that are no connections are left out; wider moving averages; straights in place of parts of the paths, at random
/// places that the context's seed gives. A change is kept where it is proven, leaves out a grip or shortens the paths, and gets no
/// nearer to the surroundings than before or than a radius. At most `tries` plays, and until `seconds` are over.
Optimised optimised(const InstalledSystem& system, const Manipulation& manipulation, Played played, const Prove& prove, int tries,
                    double seconds, const RunContext& context);

}  // namespace tendril::assembly
