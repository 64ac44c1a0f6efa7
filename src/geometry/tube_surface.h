// A tube around a curve as a closed triangle mesh.
#pragma once

#include <vector>

#include "geometry/curve.h"
#include "geometry/mesh.h"

namespace tendril {

/// Rings of `sides` vertices about the curve at the arc lengths `rings` (m, rising, two at least), joined, with flat ends. The
/// vertices lie on the tube's surface, so that the mesh lies within it on straights. `outer`, `inner`: diameters, m; with an
/// inner one above 0 the tube is hollow. Closed, with outward normals; the ends have vertices of their own, for shading.
/// Throws UsageError unless 0 <= inner < outer, finite, sides >= 3, and the rings rise.
Mesh tube_surface(const Curve& curve, const std::vector<double>& rings, double outer, double inner, int sides);

/// How many sides a circle of radius `radius` (m) needs so that its polygon stays within `tolerance` (m) of it: 8 to 512.
int sides_for(double radius, double tolerance);

}  // namespace tendril
