#include "method/pcc/curve_distance.h"

#include <algorithm>

namespace tendril::routing {

std::vector<Vec3> places_along(const PccPoints& curve, int count, double from, double to) {
  const std::vector<routing::PccPiece> pieces = routing::pieces_of(curve);
  std::vector<Vec3> places;
  std::size_t at = 0;
  for (int k = 0; k < count; ++k) {
    const double s = from + (to - from) * k / (count - 1);
    while (at + 1 < pieces.size() && s > pieces[at].begin + pieces[at].length) ++at;
    if (pieces.empty()) places.push_back(curve.points.front());
    else places.push_back(pieces[at].at(std::clamp((s - pieces[at].begin) / pieces[at].length, 0.0, 1.0)));
  }
  return places;
}

std::vector<Vec3> compared_places(const PccPoints& curve) {
  constexpr int count = 48;
  return places_along(curve, count, 0, curve.length());
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
  return most;
}

}  // namespace tendril::routing
