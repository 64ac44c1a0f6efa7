// The states of a forward play as equilibria of the scene: for pictures, charts and scripts.
#pragma once

#include "method/assembly/proof.h"

namespace tendril::assembly {

/// At most `most` states at rising times from 0 to 1, the first and the last among them. Times are those of the manipulation; the
/// last state is the one after all grips but the connections let go, where it came to that.
std::vector<KeyFrame> key_frames(const Scene& scene, const InstalledSystem& system, const Manipulation& manipulation, const Played& played,
                                 const SolveOptions& solve, int most = 100);

}  // namespace tendril::assembly
