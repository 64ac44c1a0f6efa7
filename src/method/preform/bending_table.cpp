#include "method/preform/bending_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "geometry/tube_surface.h"

namespace tendril::preform {

namespace {

using routing::PccPiece;
using routing::PccPoints;

/// A number of a table: 1 nm, or a millionth of a degree, and no -0.
std::string cell(double value) {
  const double rounded = std::round(value * 1e6) / 1e6 + 0.0;
  char text[64];
  std::snprintf(text, sizeof text, "%.6f", rounded);
  return text;
}

std::string mm(double value) { return cell(value / units::mm); }
std::string degrees(double value) { return cell(value / units::deg); }
std::string place(const Vec3& p) { return mm(p.x()) + "," + mm(p.y()) + "," + mm(p.z()); }

Vec3 turned(const Vec3& v, const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis) * v; }

void check(const Bend& bend, std::size_t index) {
  const auto require = [&](bool holds, const char* what, double got, const char* expected) {
    if (!holds)
      throw UsageError("bending table: the " + std::string(what) + " of bend " + std::to_string(index + 1) + " is " +
                       number_text(got) + "; " + expected + " expected");
  };
  const auto length = [](double x) { return std::isfinite(x) && x >= 0; };
  require(length(bend.radius), "radius", bend.radius, "a finite length of at least 0");
  require(length(bend.straight_before), "straight before", bend.straight_before, "a finite length of at least 0");
  require(bend.angle >= 0 && bend.angle < units::pi, "angle", bend.angle, "0 ... pi, without pi,");
  require(std::isfinite(bend.plane), "plane", bend.plane, "a finite angle");
}

}  // namespace

std::vector<Bend> bends_of(const PccPoints& points) {
  std::vector<Bend> bends;
  double straight = 0;
  for (const PccPiece& piece : routing::pieces_of(points)) {
    if (!piece.is_arc) {
      straight += piece.length;
      continue;
    }
    Bend bend;
    bend.radius = piece.radius;
    bend.angle = piece.turn;
    bend.straight_before = straight;
    bend.begin = piece.begin;
    bend.axis = piece.axis;
    bend.vertex = piece.start + piece.radius * std::tan(0.5 * piece.turn) * piece.start_along;
    if (!bends.empty()) {
      const Vec3& last = bends.back().axis;
      bend.plane = std::atan2(last.cross(bend.axis).dot(piece.start_along), last.dot(bend.axis));
    }
    bends.push_back(bend);
    straight = 0;
  }
  return bends;
}

double last_straight_of(const PccPoints& points) {
  double straight = 0;
  for (const PccPiece& piece : routing::pieces_of(points)) straight = piece.is_arc ? 0 : straight + piece.length;
  return straight;
}

Frame start_of(const PccPoints& points) {
  const std::vector<Bend> bends = bends_of(points);
  const Vec3 along = routing::edge_directions(points.points).front();
  return Frame::looking(points.points.front(), along, bends.empty() ? Vec3(Vec3::Zero()) : Vec3(bends.front().axis.cross(along)));
}

PccPoints points_of(const std::vector<Bend>& bends, double last_straight, const Frame& start) {
  if (!(std::isfinite(last_straight) && last_straight >= 0))
    throw UsageError("bending table: the last straight is " + number_text(last_straight) +
                     " m; a finite length of at least 0 expected");
  PccPoints points;
  Vec3 at = start.at, along = start.d3(), axis = start.d2();
  points.points.push_back(at);
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const Bend& bend = bends[i];
    check(bend, i);
    const double tangent = bend.radius * std::tan(0.5 * bend.angle);
    axis = turned(axis, along, bend.plane);
    const Vec3 vertex = at + (bend.straight_before + tangent) * along;
    along = turned(along, axis, bend.angle).normalized();
    axis = (axis - axis.dot(along) * along).normalized();
    points.points.push_back(vertex);
    points.radii.push_back(bend.radius);
    at = vertex + tangent * along;
  }
  points.points.push_back(at + last_straight * along);
  return points;
}

std::string lra_csv(const PccPoints& points) {
  std::string csv = "bend,L_mm,R_deg,A_deg,radius_mm\n";
  const std::vector<Bend> bends = bends_of(points);
  for (std::size_t i = 0; i < bends.size(); ++i)
    csv += std::to_string(i + 1) + "," + mm(bends[i].straight_before) + "," + degrees(bends[i].plane) + "," +
           degrees(bends[i].angle) + "," + mm(bends[i].radius) + "\n";
  return csv + "end," + mm(last_straight_of(points)) + ",0,0,0\n";
}

std::string xyz_csv(const PccPoints& points) {
  std::string csv = "point,x_mm,y_mm,z_mm,radius_mm\nstart," + place(points.points.front()) + ",0\n";
  const std::vector<Bend> bends = bends_of(points);
  for (std::size_t i = 0; i < bends.size(); ++i)
    csv += std::to_string(i + 1) + "," + place(bends[i].vertex) + "," + mm(bends[i].radius) + "\n";
  return csv + "end," + place(points.points.back()) + ",0\n";
}

std::string centre_line_csv(const PccPoints& points, double spacing) {
  const std::vector<PccPiece> pieces = routing::pieces_of(points);
  if (!(spacing > 0)) throw UsageError("centre line: the spacing is " + number_text(spacing) + " m; above 0 expected");
  if (points.length() / spacing > 1e7)
    throw UsageError("centre line: the spacing of " + number_text(spacing) + " m is too small; 10^7 rows at most");
  std::string csv = "s_mm,x_mm,y_mm,z_mm,tx,ty,tz\n";
  const auto row = [&](const PccPiece& piece, double share) {
    const Vec3 t = piece.along(share);
    csv += mm(piece.begin + share * piece.length) + "," + place(piece.at(share));
    for (int k = 0; k < 3; ++k) {
      char text[32];
      std::snprintf(text, sizeof text, ",%.9f", t[k] + 0.0);
      csv += text;
    }
    csv += "\n";
  };
  if (!pieces.empty()) row(pieces.front(), 0);
  for (const PccPiece& piece : pieces) {
    const int count = std::max(1, static_cast<int>(std::ceil(piece.length / spacing * (1 - 1e-12))));
    for (int i = 1; i <= count; ++i) row(piece, double(i) / count);
  }
  return csv;
}

Mesh tube_mesh(const PccPoints& points, double outer, double inner, double tolerance) {
  if (!(tolerance > 0)) throw UsageError("tube: the tolerance is " + number_text(tolerance) + " m; above 0 expected");
  const Curve curve = points.curve();
  std::vector<double> rings{0};
  // Rings of a bend too small to see would only make needles.
  const double nearest = 1e-6 * curve.length();
  for (const PccPiece& piece : routing::pieces_of(points)) {
    int count = 1;
    if (piece.is_arc) {
      if (piece.radius < 0.5 * outer)
        throw UsageError("tube: a bend's radius of " + number_text(piece.radius / units::mm) +
                         " mm is less than the tube's own radius of " + number_text(0.5 * outer / units::mm) + " mm");
      const int whole_circle = sides_for(piece.radius + 0.5 * outer, tolerance);
      count = std::max(1, static_cast<int>(std::ceil(piece.turn / (2 * units::pi) * whole_circle)));
    }
    for (int i = 1; i <= count; ++i) {
      const double s = std::min(piece.begin + piece.length * i / count, curve.length());
      if (s - rings.back() > nearest && (curve.length() - s > nearest || s == curve.length())) rings.push_back(s);
    }
  }
  if (rings.back() < curve.length()) rings.push_back(curve.length());
  return tube_surface(curve, rings, outer, inner, sides_for(0.5 * outer, tolerance));
}

}  // namespace tendril::preform
