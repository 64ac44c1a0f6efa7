// How a proven manipulation bears hands that do not follow their paths exactly: one that only an exact hand can do is fragile.
#pragma once

#include "method/assembly/installed_system.h"
#include "method/assembly/optimisation.h"
#include "method/assembly/options.h"

namespace tendril::assembly {

/// The manipulation with every grip led astray by up to `most` (m), smoothly over time, another way for each number and seed.
/// Orientations stay; so do the first poses, and the last: connections end where they belong.
Manipulation led_astray(const Manipulation& manipulation, double most, std::uint64_t seed, int number);

/// Plays it `replays` times, grips led astray by a quarter of the thickest radius but not into what surrounds them: hands feel that.
/// The same for every number of threads; where `context` stops, what was not played to its end counts as failed.
Robustness robustness(const InstalledSystem& system, const Manipulation& manipulation, const Prove& prove, int replays, const RunContext& context);

}  // namespace tendril::assembly
