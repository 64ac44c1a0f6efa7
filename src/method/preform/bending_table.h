// What the bending machine needs: LRA (length, rotation, angle) and XYZ tables of a hose.
//
// LRA, which machines also call Y, B, C: feed the straight length L (Y) up to where the bend begins, turn the tube by R (B)
// about its own axis, bend by A (C). R is right-handed about the direction of feed, from the plane of the last bend to that of
// the next, within (-180, 180] degrees; the first bend's is 0, since the tube is turned into the machine as one likes. Lengths
// are those of straights between the arcs, not between the vertices.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "method/pcc/pcc_curve.h"

namespace tendril::preform {

struct Bend {
  double radius = 0, angle = 0;       ///< m, rad
  double straight_before = 0;         ///< m, from the last bend or the end
  double plane = 0;                   ///< rad, from the last bend's plane to this one's, about the tangent; 0 for the first
  double begin = 0;                   ///< m, arc length where it begins
  Vec3 vertex = Vec3::Zero();         ///< m
  Vec3 axis = Vec3::UnitZ();          ///< of the bend, unit
};
/// Vertices without a turn are no bends. Throws UsageError unless there is a radius for each vertex.
std::vector<Bend> bends_of(const routing::PccPoints& points);

/// From the end of the last bend, or the start, to the finish, m.
double last_straight_of(const routing::PccPoints& points);
/// At the start: d3 along the tangent, d1 in the plane of the first bend, towards its middle.
Frame start_of(const routing::PccPoints& points);

/// The points (ends and vertices, m) that a table of bends describes, of which radius, angle, straight_before and plane count;
/// `start` as start_of(). Throws UsageError, counting bends from 1, for numbers that are not finite, lengths below 0 and angles
/// outside 0 ... pi.
routing::PccPoints points_of(const std::vector<Bend>& bends, double last_straight, const Frame& start);

/// CSV with a head line; lengths in mm, angles in degrees; the last row is the last straight.
std::string lra_csv(const routing::PccPoints& points);
/// CSV of ends and vertices with the radius at each, 0 at the ends.
std::string xyz_csv(const routing::PccPoints& points);
/// CSV of the centre line: s, x, y, z, tangent, at most `spacing` (m) apart, with every start and end of a bend.
std::string centre_line_csv(const routing::PccPoints& points, double spacing = 5e-3);

/// A closed tube around the curve with flat ends: straights without rings between, arcs divided so that the sagitta stays
/// below `tolerance` (m). `outer`, `inner`: diameters, m; with an inner one above 0 it is hollow. Throws UsageError for bends
/// narrower than the tube's own radius, and as Curve::pcc and tube_surface do.
Mesh tube_mesh(const routing::PccPoints& points, double outer, double inner = 0, double tolerance = 0.05e-3);

}  // namespace tendril::preform
