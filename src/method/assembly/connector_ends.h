// What connectors are to statics: ends of their rods as thick as the connectors are wide and next to rigid, which surfaces guide.
#pragma once

#include <string>
#include <vector>

#include "method/assembly/installed_system.h"

namespace tendril::assembly {

/// Adds them to the system and thickens its rods; `routed`: where its rods are. Throws UsageError for names that are empty, unknown
/// or taken, and for bodies without size or shape.
void add_connectors(InstalledSystem& installed, const std::vector<Connector>& connectors, const SystemEquilibrium& routed);

/// The connector that sits in a hole too small for it, in words; empty: none. It does where contacts on its end press against each
/// other across the rod and hold it back along the rod by more than the weight of the system and what bends the rod to ten radii:
/// without friction that is no sliding, and going on pulls the rod to pieces.
std::string wedged(const InstalledSystem& installed, const SystemEquilibrium& state);

}  // namespace tendril::assembly
