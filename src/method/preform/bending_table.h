// What the bending machine needs: LRA (length, rotation, angle) and XYZ tables of a hose.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "method/pcc/pcc_curve.h"

namespace tendril::preform {

struct Bend {
  double radius = 0, angle = 0;       ///< m, rad
  double straight_before = 0;         ///< m, from the last bend or the end
  double plane = 0;                   ///< rad, turn of the bending plane against the last bend's, about the tangent; 0 for the first
  double begin = 0;                   ///< m, arc length where it begins
  Vec3 vertex = Vec3::Zero();         ///< m
  Vec3 axis = Vec3::UnitZ();          ///< of the bend, unit
};
std::vector<Bend> bends_of(const routing::PccPoints& points);

/// The points (ends and vertices, m) that a table of bends describes, from a start frame whose d1 is in the first bending plane.
routing::PccPoints points_of(const std::vector<Bend>& bends, double last_straight, const Frame& start);

/// CSV with a head line; lengths in mm, angles in degrees; the last row is the last straight.
std::string lra_csv(const routing::PccPoints& points);
/// CSV of ends and vertices with the radius at each.
std::string xyz_csv(const routing::PccPoints& points);
/// CSV of the centre line: s, x, y, z, tangent, at most `spacing` (m) apart, with every start and end of a bend.
std::string centre_line_csv(const routing::PccPoints& points, double spacing = 5e-3);

/// A closed tube around the curve with flat ends: straights without rings between, arcs divided so that the sagitta stays
/// below `tolerance` (m). With `inner` > 0 (m, diameter) it is hollow.
Mesh tube_mesh(const routing::PccPoints& points, double outer, double inner = 0, double tolerance = 0.05e-3);

}  // namespace tendril::preform
