// Bolts and clamps.
#pragma once

#include "engine_bay/loft.h"

namespace tendril::engine_bay {

/// A flanged hexagon bolt whose flange sits on local z = 0 with the head along +z; `size` is the shank's diameter (mm).
Mesh bolt(double size, const Detail& detail);

/// One bolt a place, all heads along `along`.
Mesh bolts(const std::vector<Vec3>& places, const Vec3& along, double size, const Detail& detail);

/// Places along the rim of a rectangle from `low` to `high` in the plane z = low.z: `along_x` and `along_y` pieces a side.
std::vector<Vec3> rim_places(const Vec3& low, const Vec3& high, int along_x, int along_y);

/// A worm-drive hose clamp around local z: band radius and width (mm).
Mesh hose_clamp(double radius, double width, const Detail& detail);

/// A flat strap bent through the corners: width along `across`, rounded bends.
Mesh strap(const Path& corners, double width, double thickness, const Vec3& across, const Detail& detail);

}  // namespace tendril::engine_bay
