// A deterministic test surface: bumpy ground of 1.4 x 0.9 m with tubes lying above it.
#pragma once

#include <cmath>

#include "base/units.h"
#include "geometry/mesh.h"

namespace tendril {

/// The height of the ground, m: waves of 2 to 35 mm.
inline double ground_height(double x, double y) {
  return 0.035 * std::sin(7 * x + 1) * std::cos(9 * y) + 0.012 * std::sin(31 * x) * std::sin(27 * y + 2) +
         0.002 * std::cos(170 * x + 60 * y);
}

/// Adds columns x rows quadrilaterals, each in two triangles, over a map from [0, 1]^2 to points.
template <class Map>
void add_patch(Mesh& mesh, int columns, int rows, const Map& map) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      mesh.vertices.push_back(map(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = first + j * (columns + 1) + i, b = a + columns + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
}

/// About `triangles` triangles: seven tenths of them ground, the rest twelve tubes of 8 to 30 mm radius.
inline Mesh test_surface(int triangles) {
  Mesh mesh;
  mesh.name = "test surface";
  const int side = static_cast<int>(std::sqrt(0.35 * triangles));
  add_patch(mesh, side, side, [](double u, double v) {
    const double x = 1.4 * u, y = 0.9 * v;
    return Vec3(x, y, ground_height(x, y));
  });
  const int around = std::max(6, static_cast<int>(std::sqrt(0.0125 * triangles / 4))), along = 4 * around;
  for (int k = 0; k < 12; ++k) {
    const double radius = 0.008 + 0.002 * k, y0 = 0.07 * (k + 0.5);
    add_patch(mesh, along, around, [&](double u, double v) {
      const double x = 0.1 + 1.2 * u, turn = 2 * units::pi * v;
      const Vec3 middle(x, y0 + 0.03 * std::sin(5 * x + k), 0.1 + 0.015 * k + 0.02 * std::cos(8 * x + k));
      return Vec3(middle + radius * Vec3(0, std::cos(turn), std::sin(turn)));
    });
  }
  return mesh;
}

}  // namespace tendril
