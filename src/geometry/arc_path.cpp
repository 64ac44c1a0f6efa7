// Straights and circular arcs: polylines and piecewise constant curvature. Everything is exact.

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/error.h"
#include "base/units.h"
#include "geometry/curve.h"

namespace tendril {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// A turn below this (rad) is rounding of points that lie on a line.
constexpr double no_turn = 1e-9;

struct Piece {
  double start, length;  ///< arc lengths, m
  Frame first;           ///< at its start
  Vec3 bend;             ///< curvature times the axis of the turn, 1/m; zero for a straight

  Frame at(double s) const {
    const Vec3 tangent = first.d3();
    const double curvature = bend.norm(), angle = curvature * s;
    if (curvature == 0) return {first.at + s * tangent, first.rotation};
    const Vec3 axis = bend / curvature, inwards = axis.cross(tangent);
    // 1 - cos as a product, which keeps its digits for small angles.
    const double half = std::sin(0.5 * angle);
    const Vec3 at = first.at + (std::sin(angle) * tangent + 2 * half * half * inwards) / curvature;
    // Turning about the axis of the arc is rotation-minimising: the axis is normal to the tangent throughout.
    return {at, Quat(Eigen::AngleAxisd(angle, axis)) * first.rotation};
  }
  Vec3 curvature(double s) const { return bend.cross(at(s).d3()); }
};

class ArcPath final : public CurvePath {
 public:
  double length() const override { return pieces_.back().start + pieces_.back().length; }
  Frame frame(double s) const override {
    const Piece& piece = piece_at(s);
    return piece.at(s - piece.start);
  }
  Vec3 curvature(double s) const override {
    const Piece& piece = piece_at(s);
    return piece.curvature(s - piece.start);
  }
  Sharpest sharpest() const override { return sharpest_; }
  const std::vector<double>& breaks() const override { return breaks_; }

  void begin(const Vec3& at, const Vec3& along) { end_ = Frame::looking(at, along); }

  /// Goes on by `length`; turns the frame into the new direction first if there is a corner.
  void add(double length, const Vec3& along, const Vec3& bend) {
    const bool corner = std::atan2(end_.d3().cross(along).norm(), end_.d3().dot(along)) > no_turn;
    const bool jump = !pieces_.empty() && (bend - pieces_.back().bend).norm() > 1e-9 * bend.norm();
    const bool straightens = !pieces_.empty() && bend.norm() == 0 && pieces_.back().bend.norm() > 0;
    const double start = pieces_.empty() ? 0 : this->length();
    if (corner || jump || straightens) breaks_.push_back(start);
    note(corner ? 0 : bend.norm() > 0 ? 1 / bend.norm() : infinity, start);
    // Always turned by the little that is left, so that rounding does not add up.
    end_.rotation = (shortest_turn(end_.d3(), along) * end_.rotation).normalized();
    pieces_.push_back({start, length, end_, bend});
    end_ = pieces_.back().at(length);
  }
  /// Corrects the place where the next piece begins, which is known without the rounding of all before.
  void resume(const Vec3& at) { end_.at = at; }

 private:
  const Piece& piece_at(double s) const {
    const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), s,
                                        [](double value, const Piece& piece) { return value < piece.start; });
    return *(after - 1);
  }
  void note(double radius, double at) {
    // Equal radii differ by rounding; the first one stands.
    if (radius < sharpest_.radius * (1 - 1e-9)) sharpest_ = {radius, at};
  }

  std::vector<Piece> pieces_;
  std::vector<double> breaks_;
  Sharpest sharpest_{infinity, 0};
  Frame end_;
};

struct Corner {
  double turn = 0;     ///< rad
  double tangent = 0;  ///< m, from the corner to where the arc begins and ends
};

std::vector<Corner> rounded_corners(const std::vector<Vec3>& points, const std::vector<double>& radii) {
  std::vector<Corner> corners(points.size());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 in = (points[i] - points[i - 1]).normalized(), out = (points[i + 1] - points[i]).normalized();
    const double turn = 2 * std::atan2((out - in).norm(), (out + in).norm());
    if (turn <= no_turn) continue;
    corners[i] = {turn, radii[i - 1] * std::tan(0.5 * turn)};
  }
  return corners;
}

void check_fit(const std::vector<Vec3>& points, const std::vector<double>& radii, const std::vector<Corner>& corners) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double there = (points[i + 1] - points[i]).norm();
    const double wanted = corners[i].tangent + corners[i + 1].tangent;
    if (wanted <= there * (1 + 1e-9)) continue;
    // The corner that asks for more is the one to name.
    const std::size_t corner = corners[i].tangent > corners[i + 1].tangent ? i : i + 1;
    const double others = wanted - corners[corner].tangent;
    std::ostringstream said;
    said << "curve.pcc: the bend at point " << corner + 1 << " does not fit: a radius of " << radii[corner - 1]
         << " m and a turn of " << corners[corner].turn / units::deg << " degrees take " << corners[corner].tangent
         << " m of the straight between points " << i + 1 << " and " << i + 2 << ", of which " << std::max(0.0, there - others)
         << " m are free";
    if (there > others)
      said << "; a radius of at most " << (there - others) / std::tan(0.5 * corners[corner].turn) << " m fits";
    throw UsageError(said.str());
  }
}

}  // namespace

std::unique_ptr<const CurvePath> make_polyline_path(const std::vector<Vec3>& points) {
  auto path = std::make_unique<ArcPath>();
  path->begin(points[0], points[1] - points[0]);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    path->resume(points[i]);
    path->add((points[i + 1] - points[i]).norm(), (points[i + 1] - points[i]).normalized(), Vec3::Zero());
  }
  return path;
}

std::unique_ptr<const CurvePath> make_pcc_path(const std::vector<Vec3>& points, const std::vector<double>& radii) {
  const std::vector<Corner> corners = rounded_corners(points, radii);
  check_fit(points, radii, corners);
  auto path = std::make_unique<ArcPath>();
  path->begin(points[0], points[1] - points[0]);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 way = points[i + 1] - points[i], along = way.normalized();
    const double straight = way.norm() - corners[i].tangent - corners[i + 1].tangent;
    path->resume(points[i] + corners[i].tangent * along);
    if (straight > 1e-9 * way.norm()) path->add(straight, along, Vec3::Zero());
    if (corners[i + 1].turn == 0) continue;
    const Vec3 out = (points[i + 2] - points[i + 1]).normalized();
    path->resume(points[i + 1] - corners[i + 1].tangent * along);
    path->add(radii[i] * corners[i + 1].turn, along, along.cross(out).normalized() / radii[i]);
  }
  return path;
}

}  // namespace tendril
