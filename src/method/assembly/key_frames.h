// The states of a forward play as equilibria of the scene: for pictures, charts and scripts.
#pragma once

#include "method/assembly/proof.h"

namespace tendril::assembly {

/// At most `most` of the states that were passed, the first and the last among them, each with what held it and at its time. `grips`:
/// held in the poses that the states give them; `gravity`: that acted, m/s^2. Those on the way down from a snap-through are left out.
std::vector<KeyFrame> key_frames(const Scene& scene, const InstalledSystem& system, const std::vector<Grip>& grips, const std::vector<Passed>& passed,
                                 const Vec3& gravity, const SolveOptions& solve, int most = 100);

}  // namespace tendril::assembly
