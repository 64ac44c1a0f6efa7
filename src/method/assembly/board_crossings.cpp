#include "method/assembly/board_crossings.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

// What leaves a junction side by side may be near for so many spacings; then a share of the further way is asked for.
constexpr double side_by_side = 4, share_of_way = 0.1;

/// One segment of the drawing.
struct Segment {
  int piece, rod;
  double begin, end;  ///< arc lengths
  Vec3 a, b;
};

/// Twice the signed area of a triangle, in long double: the products of two doubles are exact in it but for the last bits.
long double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (static_cast<long double>(b.x()) - a.x()) * (static_cast<long double>(c.y()) - a.y()) -
         (static_cast<long double>(b.y()) - a.y()) * (static_cast<long double>(c.x()) - a.x());
}

bool opposite(long double p, long double q) { return (p > 0 && q < 0) || (p < 0 && q > 0); }

bool cross(const Segment& s, const Segment& t) {
  return opposite(area(s.a, s.b, t.a), area(s.a, s.b, t.b)) && opposite(area(t.a, t.b, s.a), area(t.a, t.b, s.b));
}

Vec3 crossing_of(const Segment& s, const Segment& t) {
  const double p = static_cast<double>(area(t.a, t.b, s.a)), q = static_cast<double>(area(t.a, t.b, s.b));
  return s.a + p / (p - q) * (s.b - s.a);
}

bool boxes_meet(const Segment& s, const Segment& t, double margin) {
  for (int k = 0; k < 2; ++k)
    if (std::max(s.a[k], s.b[k]) + margin < std::min(t.a[k], t.b[k]) || std::max(t.a[k], t.b[k]) + margin < std::min(s.a[k], s.b[k])) return false;
  return true;
}

std::vector<Segment> segments_of(const BoardGraph& graph, const SystemEquilibrium& state) {
  std::vector<Segment> segments;
  for (std::size_t p = 0; p < graph.pieces.size(); ++p) {
    const BoardPiece& piece = graph.pieces[p];
    const Equilibrium& rod = state.rods[piece.rod];
    const double little = 1e-9 * rod.s.back();
    for (std::size_t i = 0; i + 1 < rod.s.size(); ++i)
      if (rod.s[i] >= piece.begin - little && rod.s[i + 1] <= piece.end + little)
        segments.push_back({static_cast<int>(p), piece.rod, rod.s[i], rod.s[i + 1], rod.points[i], rod.points[i + 1]});
  }
  return segments;
}

}  // namespace

BoardCrossings board_crossings(const BoardGraph& graph, const SystemEquilibrium& state, double spacing) {
  BoardCrossings found;
  const std::vector<Segment> segments = segments_of(graph, state);
  double worst = 1;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size(); ++j) {
      const Segment &s = segments[i], &t = segments[j];
      if (!boxes_meet(s, t, spacing)) continue;
      // Neighbours share a place, and so do those that meet at a junction.
      const double between = graph.way(s.piece, 0.5 * (s.begin + s.end), t.piece, 0.5 * (t.begin + t.end));
      const bool neighbours = between <= 0.5 * (s.end - s.begin + t.end - t.begin) * (1 + 1e-9);
      if (!neighbours && cross(s, t)) {
        if (found.crossings++ == 0) {
          found.rod_a = s.rod;
          found.rod_b = t.rod;
          found.at = crossing_of(s, t);
        }
      }
      const double distance = (s.b - t.b).head<2>().norm(), way = graph.way(s.piece, s.end, t.piece, t.end);
      const double wanted = std::min(spacing, share_of_way * (way - side_by_side * spacing));
      if (wanted > 0 && distance < worst * wanted) {
        worst = distance / wanted;
        found.near = true;
        found.distance = distance;
        found.near_a = s.rod;
        found.near_b = t.rod;
      }
    }
  return found;
}

}  // namespace tendril::assembly
