// Traces backwards become a manipulation forwards: smoother, and no nearer to anything than before (thesis 3.4, path smoothing).
#pragma once

#include "method/assembly/installed_system.h"

namespace tendril::assembly {

/// Grips moved out to where their rods just touch: obstacles gave way to the pull. `raw`: forwards, its last poses the routed ones.
Manipulation kept_clear(const InstalledSystem& system, const Manipulation& raw);

/// Moving averages of places and orientations, over as long a window as each place allows: every grip keeps the distance that its
/// raw path had there, or `system.radius` where that is less, but for 0.005 of it. Ends stay. `window`: of the common time.
Manipulation smoothed(const InstalledSystem& system, const Manipulation& raw, double window);

}  // namespace tendril::assembly
