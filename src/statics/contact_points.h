// Where along a rod contact is evaluated, and how a force there reaches the unknowns.
//
// se3 element: between vertices a and b of one segment of length h the centre line is the cubic Hermite curve
//   x = H00 r_a + H01 r_b + h H10 R_a e3 + h H11 R_b e3.
// staggered element: x = (1 - xi) r_a + xi r_b, forces go to positions only.
#pragma once

#include <span>
#include <vector>

#include "statics/block_system.h"
#include "statics/problem.h"

namespace tendril {

/// A point of the centre line with its share of the rod's length.
struct ContactPoint {
  int segment;      ///< between vertices `segment` and `segment + 1`
  double s;         ///< arc length, m
  double weight;    ///< m of rod that this point stands for (trapezoid rule)
  double radius;    ///< m
  double ra, rb;    ///< H00, H01: weights of the two positions
  double ta, tb;    ///< h H10, h H11: weights of the two section normals, m
  double keep = 0;  ///< the most of an obstacle's clearance that counts here, m
};

/// Vertices of a rod as contact sees them. Arrays of segments + 1 entries; the staggered element needs no rotations.
struct VertexShape {
  std::span<const Vec3> points;
  std::span<const Quat> rotations;
};

/// Most contact points inside one segment: a longer, thinner segment gets points farther apart than its radius.
inline constexpr int max_points_per_segment = 64;

/// Points at most `spacing` radii apart, every vertex among them, ordered along the rod. `s`: the vertices' arc lengths
/// (m, segments + 1, increasing); `radii`: one for each segment (m). Throws UsageError for arrays that do not match.
std::vector<ContactPoint> contact_points(std::span<const double> s, std::span<const double> radii, Element element,
                                         double spacing = 1);

/// The point at `xi` (0 ... 1) of a segment; its weight is left zero.
ContactPoint contact_point_at(std::span<const double> s, std::span<const double> radii, Element element, int segment,
                              double xi);

/// The point's first and second derivative by arc length: position_of() of them gives dx/ds and d2x/ds2 (1/m), the
/// weights being derivatives of the point's.
ContactPoint slope_of(const ContactPoint& point, std::span<const double> s, Element element);
ContactPoint curvature_of(const ContactPoint& point, std::span<const double> s, Element element);

/// How much of a clearance counts at `way` (m) of rod from the nearest held place: none within a radius, then it grows
/// along an arc of eight radii and from a slope of one half on straight.
double kept_at(double way, double radius);

/// Sets every point's weight by the trapezoid rule over the arc lengths of its neighbours.
void set_trapezoid_weights(std::span<ContactPoint> points);

/// Where the point is (m).
Vec3 position_of(const ContactPoint& point, const VertexShape& shape);

/// First-order motion of the point (m) under the increments `step` of all vertices (block_system.h).
Vec3 displacement_of(const ContactPoint& point, const VertexShape& shape, std::span<const Vec6> step);

/// Positions of all points (m).
void positions_of(std::span<const ContactPoint> points, const VertexShape& shape, std::vector<Vec3>& out);

/// Positions of all points after `share` times the increments `step` has really been applied:
/// r + share dr, R exp(share theta).
void moved_positions(std::span<const ContactPoint> points, const VertexShape& shape, std::span<const Vec6> step,
                     double share, std::vector<Vec3>& out);

/// Adds J^T f to the unknowns of the point's two vertices: a force on the point (N) as they feel it.
void add_point_force(const ContactPoint& point, const VertexShape& shape, const Vec3& force, Vec6& at_a, Vec6& at_b);

/// Adds an energy E(x) of the point to the system. gradient: dE/dx (N); hessian: d2E/dx2 (N/m), which may be any
/// symmetric model of it; geometric: the gradient (N) that multiplies the second derivative of x by the rotations.
void add_point_energy(const ContactPoint& point, const VertexShape& shape, const Vec3& gradient, const Mat3& hessian,
                      const Vec3& geometric, BlockView system);

}  // namespace tendril
