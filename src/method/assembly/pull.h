// The first half of assembly verification, backwards: the connections let go, and a handle pulls the system out into the open
// (thesis 3.4, constraint relaxation and handle path planning). What every grip does meanwhile is traced.
#pragma once

#include "method/assembly/installed_system.h"
#include "method/assembly/quasi_static.h"

namespace tendril::assembly {

struct Pulled {
  bool ok = false;
  std::string message;          ///< what stopped it, where
  Drive unplugged, released, pulled;
  std::vector<Vec3> path;       ///< m, of the handle
};

/// Connectors that are plugged into something are first withdrawn straight from their sockets, one after the other, the farthest from
/// the handle first. Where rods hang together or connectors are plugged in, all connections are then carried along with the handle,
/// along its path or straight up, if nothing is in the way (not with gravity). Else they let go, and the rest follows the handle.
/// `gravity`: acts all along; else it is taken away while the connections let go. Springs hold those ever less, from stiffer than
/// the rods to nothing, so that nothing jumps that need not.
Pulled pull(const InstalledSystem& system, const Grip& handle, const std::vector<Vec3>& path, bool gravity, const DriveOptions& options,
            const SolveOptions& solve, const RunContext& context = {});

/// What these grips did while the system was pulled, over a common time that runs evenly with the farthest that any of them moves.
Manipulation traces(const InstalledSystem& system, const Pulled& pulled, const std::vector<Grip>& grips);

}  // namespace tendril::assembly
