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

/// The same, solid, through sections that are given: `sections` (two at least, d3 along the tube) with the radii `radii` (m,
/// above 0). Vertices: `sides` of each section in turn; then the first end's rim and middle, then the last end's: so the vertices
/// of section i are known, see section_of_vertex(). Throws UsageError for counts that do not fit and numbers that are not finite.
Mesh tube_surface(const std::vector<Frame>& sections, const std::vector<double>& radii, int sides);

/// For each vertex of such a tube the number of its section.
std::vector<int> section_of_vertex(int sections, int sides);

/// How many sides a circle of radius `radius` (m) needs so that its polygon stays within `tolerance` (m) of it: 8 to 512.
int sides_for(double radius, double tolerance);

}  // namespace tendril
