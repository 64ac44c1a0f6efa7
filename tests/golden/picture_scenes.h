// Small surroundings and tubes, made by formula, for pictures in tests and benchmarks.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "view/picture.h"

namespace tendril::scenes {

/// Vertices and triangles that grow part by part.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;

  void box(const Vec3& low, const Vec3& high);
  void cylinder(const Vec3& from, const Vec3& to, double radius, int sides = 40);
  void sphere(const Vec3& centre, double radius, int rings = 24);
  /// A plate in the plane x = `x`, thickness along x, with round holes of `radius` in the middle of every cell of size
  /// `pitch`.
  void perforated_plate(double x, double thickness, double y0, double z0, double pitch, int across, int upward,
                        double radius);
  /// A wavy sheet over [0, size]^2 at height z with about 2 n^2 triangles.
  void wavy_sheet(const Vec3& corner, double size, double height, int n);
};

PictureSurface surface(std::string name, Mesh mesh, SurfaceStyle style = SurfaceStyle::ghost);

/// A coolant hose through a perforated plate, over a ribbed block, under a cover: clearance with violated parts.
Picture hose_in_bay();

/// A hose that runs behind an opaque box and through a closed one, curvature about zero, loads and a planned path.
Picture hose_behind_solid();

/// An envelope as a veil about a hose whose section varies, curvature with a limit above, a pin and a guide.
Picture envelope_of_hose();

/// A shell around a hose over a step, coloured by its distance from the step: near it too small, above a cut-out unknown.
Picture envelope_by_clearance();

/// Clearance far above the limit, one label, tube along the line of sight of a view: what a fit must survive.
Picture straight_hose();

/// hose_in_bay() over a surface of at least `triangles` triangles.
Picture hose_over_fine_bay(std::size_t triangles);

}  // namespace tendril::scenes
