// The softest disturbances of a scene's equilibrium, and other equilibria for the same holds.
#pragma once

#include "base/run_context.h"
#include "scene/scene_equilibrium.h"

namespace tendril {

/// Fills `found.modes` (statics/modes.h says how they are found). Systems of rods do not feel each other: the eigenvalues
/// are those of all systems together, and each other equilibrium differs from `found` in one system.
void find_modes(SceneEquilibrium& found, const SolveOptions& options, const RunContext& context);

}  // namespace tendril
