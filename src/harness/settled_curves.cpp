#include "harness/settled_curves.h"

#include <algorithm>
#include <array>

namespace tendril {
namespace {

/// Places and tangents at both ends; the tangents times the arc length between them.
struct Piece {
  Vec3 from, to, from_slope, to_slope;

  Vec3 at(double t) const {
    const double u = 1 - t;
    return u * u * (1 + 2 * t) * from + t * t * (3 - 2 * t) * to + u * u * t * from_slope - t * t * u * to_slope;
  }
  std::array<Vec3, 4> bezier() const { return {from, from + from_slope / 3, to - to_slope / 3, to}; }
};

Piece piece_between(const Equilibrium& rod, double a, double b) {
  const Frame from = rod.frame_at(a), to = rod.frame_at(b);
  return {from.at, to.at, (b - a) * from.d3(), (b - a) * to.d3()};
}

bool fits(const Piece& piece, const Equilibrium& rod, double a, double b, int elements, double tolerance) {
  const int places = 4 * elements + 3;
  for (int k = 1; k < places; ++k) {
    const double t = double(k) / places;
    if ((piece.at(t) - rod.frame_at(a + t * (b - a)).at).norm() > tolerance) return false;
  }
  return true;
}

/// The control points of a uniform B-spline over one span that is this Bezier curve.
HarnessCurve unclamped(const std::array<Vec3, 4>& b) {
  return {3,
          {6 * b[0] - 7 * b[1] + 2 * b[2], 2 * b[1] - b[2], 2 * b[2] - b[1], 2 * b[1] - 7 * b[2] + 6 * b[3]},
          {},
          {}};
}

}  // namespace

std::vector<HarnessCurve> settled_curves(const Equilibrium& rod, KnotReading reading, double tolerance) {
  std::vector<HarnessCurve> curves;
  const std::vector<double>& s = rod.s;
  for (std::size_t from = 0; from + 1 < s.size();) {
    std::size_t to = from + 1;
    Piece piece = piece_between(rod, s[from], s[to]);
    while (to + 1 < s.size()) {
      const Piece longer = piece_between(rod, s[from], s[to + 1]);
      if (!fits(longer, rod, s[from], s[to + 1], static_cast<int>(to + 1 - from), tolerance)) break;
      piece = longer;
      ++to;
    }
    const std::array<Vec3, 4> bezier = piece.bezier();
    if (reading == KnotReading::unclamped) curves.push_back(unclamped(bezier));
    else curves.push_back({3, {bezier.begin(), bezier.end()}, {}, {}});
    from = to;
  }
  return curves;
}

}  // namespace tendril
