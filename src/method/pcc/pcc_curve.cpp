// Straights and arcs of a polyline whose vertices are rounded.
#include "method/pcc/pcc_curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tendril::routing {

namespace {

// A turn below this (rad) is rounding of points that lie on a line, as in Curve::pcc.
constexpr double no_turn = 1e-9;

void check(const PccPoints& points) {
  if (points.points.size() < 2 || points.points.size() != points.radii.size() + 2)
    throw UsageError("pcc: " + std::to_string(points.points.size()) + " points and " + std::to_string(points.radii.size()) +
                     " radii; two ends, and a radius for each vertex between them, are expected");
}

/// What the arc at each point takes of the edges beside it, m.
std::vector<double> tangents_of(const PccPoints& points) {
  check(points);
  const std::vector<Vec3> along = edge_directions(points.points);
  std::vector<double> tangents(points.points.size(), 0.0);
  for (std::size_t i = 0; i < points.radii.size(); ++i) {
    const double turn = turn_between(along[i], along[i + 1]);
    if (turn > no_turn) tangents[i + 1] = points.radii[i] * std::tan(0.5 * turn);
  }
  return tangents;
}

PccPiece arc(const Vec3& vertex, const Vec3& in, const Vec3& out, double radius, double turn) {
  PccPiece piece;
  const double tangent = radius * std::tan(0.5 * turn);
  piece.is_arc = true;
  piece.length = radius * turn;
  piece.start = vertex - tangent * in;
  piece.finish = vertex + tangent * out;
  piece.start_along = in;
  piece.finish_along = out;
  piece.radius = radius;
  piece.turn = turn;
  const Vec3 axis = in.cross(out);
  // A turn by pi to the last digit: any plane will do.
  piece.axis = axis.norm() > 1e-14 ? axis.normalized() : in.unitOrthogonal();
  return piece;
}

}  // namespace

std::vector<Vec3> edge_directions(const std::vector<Vec3>& points) {
  std::vector<Vec3> along(points.size() - 1, Vec3::Zero());
  Vec3 last = Vec3::Zero();
  for (std::size_t i = 0; i < along.size(); ++i) {
    const Vec3 edge = points[i + 1] - points[i];
    const double length = edge.stableNorm();
    if (length > 0) last = edge / length;
    along[i] = last;
  }
  for (std::size_t i = along.size() - 1; i-- > 0;)
    if (along[i].isZero(0)) along[i] = along[i + 1];
  return along;
}

double turn_between(const Vec3& in, const Vec3& out) { return 2 * std::atan2((out - in).norm(), (out + in).norm()); }

double PccPoints::length() const {
  check(*this);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) sum += (points[i + 1] - points[i]).stableNorm();
  const std::vector<Vec3> along = edge_directions(points);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double turn = turn_between(along[i], along[i + 1]);
    if (turn > no_turn) sum -= radii[i] * (2 * std::tan(0.5 * turn) - turn);
  }
  return sum;
}

Vec3 PccPiece::at(double share) const {
  if (!is_arc) return start + share * (finish - start);
  // 1 - cos as a product, which keeps its digits for small turns.
  const double angle = share * turn, half = std::sin(0.5 * angle);
  return start + radius * (std::sin(angle) * start_along + 2 * half * half * axis.cross(start_along));
}

Vec3 PccPiece::along(double share) const {
  if (!is_arc) return start_along;
  const double angle = share * turn;
  return std::cos(angle) * start_along + std::sin(angle) * axis.cross(start_along);
}

double overlap_of(const PccPoints& points) {
  const std::vector<double> tangents = tangents_of(points);
  double worst = 0;
  for (std::size_t i = 0; i + 1 < points.points.size(); ++i) {
    const double wanted = tangents[i] + tangents[i + 1], there = (points.points[i + 1] - points.points[i]).norm();
    if (wanted > there * (1 + 1e-9)) worst = std::max(worst, wanted - there);
  }
  return worst;
}

PccPoints fitted(const PccPoints& points, double most) {
  const std::vector<double> tangents = tangents_of(points);
  std::vector<double> shares(points.points.size(), 1.0);
  for (std::size_t i = 0; i + 1 < points.points.size(); ++i) {
    const double wanted = tangents[i] + tangents[i + 1], there = (points.points[i + 1] - points.points[i]).norm();
    if (wanted <= there || wanted - there > most) continue;
    for (const std::size_t k : {i, i + 1}) shares[k] = std::min(shares[k], there / wanted);
  }
  PccPoints result = points;
  for (std::size_t i = 0; i < points.radii.size(); ++i) result.radii[i] *= shares[i + 1];
  return result;
}

std::vector<PccPiece> pieces_of(const PccPoints& points) {
  check(points);
  const std::vector<Vec3>& p = points.points;
  const std::vector<Vec3> along = edge_directions(p);
  const double shortest = 1e-12 * points.length();
  std::vector<PccPiece> pieces;
  double s = 0;
  Vec3 reached = p.front();
  const auto go_straight = [&](const Vec3& to, const Vec3& direction) {
    const double length = (to - reached).dot(direction);
    if (length <= shortest || length <= 0) return;
    PccPiece piece;
    piece.length = length;
    piece.start = reached;
    piece.finish = to;
    piece.start_along = piece.finish_along = direction;
    piece.begin = s;
    s += length;
    pieces.push_back(piece);
  };
  for (std::size_t i = 0; i < points.radii.size(); ++i) {
    const double turn = turn_between(along[i], along[i + 1]);
    // Without a turn the vertex still ends its straight: it may lie off the line by what a tiny turn makes of a long edge.
    const bool bends = turn > no_turn && points.radii[i] > 0;
    const PccPiece bend = bends ? arc(p[i + 1], along[i], along[i + 1], points.radii[i], turn) : PccPiece();
    go_straight(bends ? bend.start : p[i + 1], along[i]);
    reached = bends ? bend.finish : p[i + 1];
    if (!bends) continue;
    pieces.push_back(bend);
    pieces.back().begin = s;
    s += bend.length;
  }
  go_straight(p.back(), along.back());
  return pieces;
}

}  // namespace tendril::routing
