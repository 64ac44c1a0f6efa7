#include "method/route/straight_finish.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "scene/formed_rod.h"

namespace tendril::routing {
namespace {

bool is(const Curve& curve, const char* kind) { return std::string(curve.kind()) == kind; }

/// The radii that a curve of constant curvatures was made with, read off its bends.
std::vector<double> radii_of(const Curve& curve) {
  std::vector<double> ends = curve.breaks();
  ends.push_back(curve.length());
  std::vector<std::pair<double, double>> bends;  // radius, arc length
  double begin = 0;
  for (const double end : ends) {
    const double radius = curve.bend_radius(0.5 * (begin + end));
    if (std::isfinite(radius)) bends.push_back({radius, end - begin});
    begin = end;
  }
  const std::vector<Vec3>& points = curve.points();
  std::vector<double> radii;
  std::size_t at = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 in = (points[i] - points[i - 1]).normalized(), out = (points[i + 1] - points[i]).normalized();
    const double turn = 2 * std::atan2((out - in).norm(), (out + in).norm());
    if (turn <= 1e-9 || at >= bends.size()) {
      radii.push_back(radii.empty() ? 1 : radii.back());  // no bend: any radius will do
      continue;
    }
    radii.push_back(bends[at].first);
    // Two bends in one plane with one radius may follow each other without a break between.
    bends[at].second -= bends[at].first * turn;
    if (bends[at].second < 1e-6 * bends[at].first) ++at;
  }
  return radii;
}

}  // namespace

double straight_finish(const Curve& curve) {
  if (!is(curve, "pcc") && !is(curve, "polyline")) return 0;
  const double begin = curve.breaks().empty() ? 0 : curve.breaks().back();
  return std::isfinite(curve.bend_radius(0.5 * (begin + curve.length()))) ? 0 : curve.length() - begin;
}

void check_straight_finish(const Rod& rod) {
  const Curve* curve = curve_of(rod);
  if (curve && straight_finish(*curve) > 1e-6 * rod.length) return;
  throw UsageError("refine: the length of a preformed rod is adjusted at its finish, expected a shape of straights and bends "
                   "(curve.pcc) that ends with a straight; leave 'length' out of what is adjusted, or give such a shape");
}

Curve with_finish_moved(const Curve& curve, double by) {
  std::vector<Vec3> points = curve.points();
  points.back() += by * (points.back() - points[points.size() - 2]).normalized();
  return is(curve, "polyline") ? Curve::polyline(points) : Curve::pcc(points, radii_of(curve));
}

}  // namespace tendril::routing
