#include "geometry/curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include "base/error.h"

namespace tendril {

namespace {

void check_points(const char* kind, const std::vector<Vec3>& points) {
  std::ostringstream said;
  said << "curve." << kind << ": ";
  if (points.size() < 2) {
    said << points.size() << (points.size() == 1 ? " point" : " points") << "; at least 2 expected";
    throw UsageError(said.str());
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!all_finite(points[i])) {
      said << "point " << i + 1 << " is (" << points[i].transpose() << "); finite numbers expected";
      throw UsageError(said.str());
    }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double size = std::max(points[i].cwiseAbs().maxCoeff(), points[i + 1].cwiseAbs().maxCoeff());
    if ((points[i + 1] - points[i]).norm() > 1e-12 * size) continue;
    said << "points " << i + 1 << " and " << i + 2 << " are in one place, (" << points[i].transpose() << ")";
    throw UsageError(said.str());
  }
}

}  // namespace

Curve Curve::polyline(const std::vector<Vec3>& points) {
  check_points("polyline", points);
  return {"polyline", Origin{.points = points}, make_polyline_path(points)};
}

Curve Curve::pcc(const std::vector<Vec3>& points, double radius) {
  return pcc(points, std::vector<double>(points.size() > 2 ? points.size() - 2 : 0, radius));
}

Curve Curve::pcc(const std::vector<Vec3>& points, const std::vector<double>& radii) {
  check_points("pcc", points);
  if (radii.size() + 2 != points.size()) {
    std::ostringstream said;
    said << "curve.pcc: " << radii.size() << " radii for " << points.size() << " points; one for each inner point expected";
    throw UsageError(said.str());
  }
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (!(std::isfinite(radii[i]) && radii[i] > 0)) {
      std::ostringstream said;
      said << "curve.pcc: the radius at point " << i + 2 << " is " << radii[i] << "; a finite length above 0 expected (m)";
      throw UsageError(said.str());
    }
  return {"pcc", Origin{.points = points, .radii = radii}, make_pcc_path(points, radii)};
}

Curve Curve::spline(const std::vector<Vec3>& points, const SplineEnds& ends) {
  check_points("spline", points);
  for (const auto& [end, name] : {std::pair{&ends.start, "start"}, std::pair{&ends.finish, "finish"}})
    if (*end && !(all_finite(**end) && (*end)->norm() > 0))
      throw UsageError(std::string("curve.spline: the direction at the ") + name + " is not a finite vector other than zero");
  return {"spline", Origin{.points = points, .ends = ends}, make_spline_path(points, ends)};
}

Curve Curve::helix(double radius, double pitch, double turns, bool left_handed) {
  for (const auto& [name, value, positive] :
       {std::tuple{"radius", radius, true}, std::tuple{"pitch", pitch, false}, std::tuple{"turns", turns, true}}) {
    if (std::isfinite(value) && (!positive || value > 0)) continue;
    std::ostringstream said;
    said << "curve.helix: '" << name << "' is " << value << "; a finite number" << (positive ? " above 0" : "") << " expected";
    throw UsageError(said.str());
  }
  auto path = make_helix_path(radius, pitch, turns, left_handed);
  if (!std::isfinite(path->length())) throw UsageError("curve.helix: longer than a number can tell");
  Origin origin;
  origin.points = {path->frame(0).at, path->frame(path->length()).at};
  origin.radius = radius;
  origin.pitch = pitch;
  origin.turns = turns;
  origin.left_handed = left_handed;
  return {"helix", std::move(origin), std::move(path)};
}

double Curve::checked(double s) const {
  const double slack = 1e-9 * length();
  if (s >= -slack && s <= length() + slack) return std::clamp(s, 0.0, length());
  std::ostringstream said;
  said.precision(12);
  said << "curve." << kind_ << ": arc length " << s << " m is outside 0 ... " << length() << " m";
  throw UsageError(said.str());
}

Frame Curve::at(double s) const { return path_->frame(checked(s)); }

Vec3 Curve::curvature(double s) const { return path_->curvature(checked(s)); }

double Curve::bend_radius(double s) const {
  const double curvature = path_->curvature(checked(s)).norm();
  return curvature > 0 ? 1 / curvature : std::numeric_limits<double>::infinity();
}

std::vector<Vec3> Curve::sampled(double spacing) const {
  if (!(spacing > 0)) throw UsageError("curve: the spacing of samples must be above 0 (m)");
  const double pieces = std::ceil(length() / spacing);
  if (pieces > 1e8) throw UsageError("curve: the spacing of samples is too small for the curve; 10^8 samples at most");
  const int count = std::max(1, static_cast<int>(pieces));
  std::vector<Vec3> points;
  points.reserve(count + 1);
  for (int i = 0; i <= count; ++i) points.push_back(path_->frame(length() * i / count).at);
  return points;
}

}  // namespace tendril
