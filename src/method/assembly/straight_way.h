// Ways out straight along the rod that is gripped: what sits in a hole leaves it best along its own axis.
#pragma once

#include <vector>

#include "method/assembly/handle_path.h"

namespace tendril::assembly {

/// To either side of the section `handle`, as far as the system has room, where a ball of two radii or more passes; the wider first.
/// None where an exit is prescribed and where nothing is in the way anyhow.
std::vector<HandlePath> straight_ways(const routing::FreeSpace& space, const Frame& handle, const HandlePathOptions& options);

}  // namespace tendril::assembly
