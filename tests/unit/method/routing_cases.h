// Scenes, random curves and brute-force distances that the tests of routing share.
#pragma once

#include <cmath>
#include <limits>
#include <memory>

#include "geometry/closest_point.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_curve.h"
#include "unit/geometry/random_mesh.h"

namespace tendril::testing {

using test::Random;

inline PlacedObstacle obstacle_of(const char* name, const Mesh& mesh, double clearance = 0) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = std::make_shared<const TriangleSurface>(mesh);
  obstacle.clearance = clearance;
  return obstacle;
}

inline PlacedObstacle solid_of(const std::string& name, const Solid& solid, const Vec3& at) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = solid;
  obstacle.body.pose.at = at;
  return obstacle;
}

/// The distance of a point to all triangles, one after the other, m.
inline double brute_distance(const Mesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    least = std::min(least, closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]).squared);
  return std::sqrt(least);
}

/// Bends of turns up to `most` (rad) between straights of 10 to 150 mm: all arcs fit.
inline routing::PccPoints random_pcc(Random& random, int bends, double radius, double most = 2.4) {
  routing::PccPoints curve;
  Vec3 at = random.point(0.3), along = random.direction();
  double before = 0;
  curve.points.push_back(at);
  for (int i = 0; i < bends; ++i) {
    const double turn = random.in(0, most), tangent = radius * std::tan(0.5 * turn);
    at += (before + tangent + random.in(0.01, 0.15)) * along;
    curve.points.push_back(at);
    curve.radii.push_back(radius);
    along = Eigen::AngleAxisd(turn, along.cross(random.direction()).normalized()) * along;
    before = tangent;
  }
  curve.points.push_back(at + (before + random.in(0.01, 0.15)) * along);
  return curve;
}

/// The ends of a curve as it lies.
inline routing::Ends ends_of(const routing::PccPoints& curve) {
  const std::vector<Vec3>& p = curve.points;
  return {p.front(), (p[1] - p[0]).normalized(), p.back(), (p[p.size() - 1] - p[p.size() - 2]).normalized()};
}

}  // namespace tendril::testing
