// Thin pressed sheets: one layer of triangles with open edges.
#pragma once

#include "engine_bay/detail.h"
#include "engine_bay/mesh.h"

namespace tendril::engine_bay {

struct Hole {
  Vec2 centre;  ///< mm
  double radius;
};

/// The flat rectangle [0, width] x [0, height] at z = 0, facing +z, with round holes. Throws UsageError when two
/// holes stand closer than a quarter of a radius to each other or to the rim.
Mesh sheet(double width, double height, const std::vector<Hole>& holes, const Detail& detail);

/// The sheet laid over a surface: local (u, v) of the rectangle to a point.
Mesh sheet(double width, double height, const std::vector<Hole>& holes, const Detail& detail,
           const std::function<Vec3(double u, double v)>& surface);

/// Holes in rows and columns that fill the rectangle from `low` to `high`.
std::vector<Hole> hole_field(const Vec2& low, const Vec2& high, int columns, int rows, double radius);

/// A smooth step from 0 to 1 as x goes from a to b: the flank of a swage.
double smooth_step(double a, double b, double x);

/// A raised field in a sheet: 1 inside the rectangle, 0 outside, flanks of width `flank`.
double embossed(const Vec2& low, const Vec2& high, double flank, double u, double v);

}  // namespace tendril::engine_bay
