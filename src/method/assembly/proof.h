// A manipulation played forward under gravity and in contact, which alone counts (thesis 3.4, grip point supplementation).
#pragma once

#include "method/assembly/installed_system.h"
#include "method/assembly/options.h"
#include "method/assembly/quasi_static.h"

namespace tendril::assembly {

struct Played {
  Proof proof;
  Drive hung, moved, let_go;  ///< gravity comes; the grips move; those that are no connections let go
};

/// `start`: the state at the manipulation's first time, without gravity or with. Proven: every step in a stable equilibrium without a
/// snap-through, nothing passes through a surface, strain and bend radius within limits, and in the end, held by the connections
/// alone, no vertex farther from the routed configuration than `deviation` (m).
Played play(const InstalledSystem& system, const Manipulation& manipulation, const SystemEquilibrium& start, double deviation,
            const DriveOptions& options, const SolveOptions& solve, const RunContext& context = {});

}  // namespace tendril::assembly
