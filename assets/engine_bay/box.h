// Boxes with rounded edges.
#pragma once

#include "engine_bay/detail.h"
#include "engine_bay/mesh.h"

namespace tendril::engine_bay {

/// A box from corner `low` to corner `high` with edges and corners of radius `fillet` (0: sharp).
Mesh box(const Vec3& low, const Vec3& high, double fillet, const Detail& detail);

/// A box whose lower end (at low.z) is drawn in by `taper` on each of its four sides, as a casting or a tank is.
Mesh tapered_box(const Vec3& low, const Vec3& high, double fillet, double taper, const Detail& detail);

/// `count` thin upright plates between the two corners, side by side along the axis (0: x, 1: y, 2: z).
Mesh ribs(const Vec3& low, const Vec3& high, int axis, int count, double thickness, const Detail& detail);

}  // namespace tendril::engine_bay
