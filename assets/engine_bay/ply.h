// Parts as one binary PLY file and a list of what is where in it.
#pragma once

#include "engine_bay/parts.h"

namespace tendril::engine_bay {

/// Binary little-endian PLY, mm, float coordinates; parts one after the other.
std::string ply(const std::vector<Part>& parts);

/// One line a part: name, "body" or "sheet", first triangle, number of triangles. Then the connections: name, tip (mm),
/// direction, radius (mm).
std::string part_list(const std::vector<Part>& parts);

}  // namespace tendril::engine_bay
