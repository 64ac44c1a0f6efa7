// Piecewise constant curvature (thesis 3.2, figure 3.4): straights joined by circular arcs that fillet the vertices between.
//
//   first vertex = start + first * start direction,  last vertex = finish - last * finish direction
//   length = sum |edges| - sum over vertices R (2 tan(turn/2) - turn)
#pragma once

#include <vector>

#include "base/frame.h"
#include "geometry/curve.h"

namespace tendril::routing {

/// A place and a unit direction at either end.
struct Ends {
  Vec3 start = Vec3::Zero(), start_along = Vec3::UnitX();
  Vec3 finish = Vec3::Zero(), finish_along = Vec3::UnitX();
};

/// Ends and vertices; one radius (m) for each vertex. With two points it is a straight.
struct PccPoints {
  std::vector<Vec3> points;
  std::vector<double> radii;

  int bends() const { return static_cast<int>(radii.size()); }
  double length() const;         ///< m, by the formula above
  Curve curve() const { return Curve::pcc(points, radii); }
};

/// One straight or arc, in order along the curve.
struct PccPiece {
  bool is_arc = false;
  double begin = 0, length = 0;   ///< m, arc lengths
  Vec3 start, finish;             ///< m
  Vec3 start_along, finish_along; ///< unit
  double radius = 0, turn = 0;    ///< of an arc: m, rad
  Vec3 axis = Vec3::Zero();       ///< of the turn, unit; zero for a straight
  Vec3 at(double share) const;    ///< 0 ... 1
  Vec3 along(double share) const; ///< unit tangent, 0 ... 1
};

/// All pieces of positive length. Straights shorter than 1e-12 of the whole are left out, as are those for which arcs that
/// overlap leave nothing. Throws UsageError, as length() does, unless there is a radius for each vertex.
std::vector<PccPiece> pieces_of(const PccPoints& points);

/// By how much neighbouring arcs overlap at worst, m; 0 where Curve::pcc takes the curve.
double overlap_of(const PccPoints& points);

/// Neighbouring arcs that overlap by at most `most` (m) made to fit: both radii are reduced in proportion. What overlaps by more
/// stays as it is. violations() forgives no overlap beyond rounding.
PccPoints fitted(const PccPoints& points, double most = 1e-6);

/// Unit directions of the edges. One without length goes on as the one before, the first ones as the first that has a length;
/// zero where none has.
std::vector<Vec3> edge_directions(const std::vector<Vec3>& points);

/// The angle between two unit directions (rad), to rounding also near 0 and pi.
double turn_between(const Vec3& in, const Vec3& out);

}  // namespace tendril::routing
