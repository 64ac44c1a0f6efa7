// Which further grip a manipulation needs that did not arrive (thesis 3.4, grip point supplementation).
#pragma once

#include <string>

#include "method/assembly/installed_system.h"
#include "method/assembly/proof.h"

namespace tendril::assembly {

/// The grips of a manipulation that have these names, in its order.
Manipulation with_grips(const Manipulation& all, const std::vector<std::string>& names);

/// Of the grips in `all` that `played` did without: the one that strayed farthest from its path in `all`; where nothing strays by a
/// radius, the one nearest along its rod to where contact pressed hardest when the play ended. Empty: there is none left, or a
/// connector hits something on its prescribed way.
std::string supplementary_grip(const InstalledSystem& system, const Manipulation& all, const Manipulation& played, const Played& result);

}  // namespace tendril::assembly
