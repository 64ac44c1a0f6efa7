#include "scene/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace tendril {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The gap of one stretch of the rod with one radius.
class GapAlong {
 public:
  GapAlong(const Equilibrium& equilibrium, const DistanceTo& distance, double radius)
      : equilibrium_(equilibrium), distance_(distance), radius_(radius) {}

  Clearance at(double s) const {
    const Vec3 p = equilibrium_.frame_at(s).at;
    const ClosestPoint closest = distance_(p);
    return {closest.obstacle < 0 ? infinity : closest.distance - radius_, s, p, closest.point, closest.obstacle};
  }
  double radius() const { return radius_; }

 private:
  const Equilibrium& equilibrium_;
  const DistanceTo& distance_;
  double radius_;
};

/// Golden-section search between a and b: needs no derivative, and the gap has kinks where the closest primitive changes.
Clearance refine(const GapAlong& gap, double a, double b, double tolerance, Clearance best) {
  constexpr double golden = 0.6180339887498949;
  Clearance left = gap.at(b - golden * (b - a)), right = gap.at(a + golden * (b - a));
  while (b - a > tolerance) {
    if (left.value < right.value) {
      b = right.s;
      right = left;
      left = gap.at(b - golden * (b - a));
    } else {
      a = left.s;
      left = right;
      right = gap.at(a + golden * (b - a));
    }
  }
  for (const Clearance& c : {left, right})
    if (c.value < best.value) best = c;
  return best;
}

/// A piece of the rod and the smallest gap that it can hide.
struct Piece {
  Clearance a, b;
  double bound;
  bool operator<(const Piece& other) const { return bound > other.bound; }  // the priority queue's top: least bound
};

/// The centre line between two close places is hardly longer than the way between them; the margin covers its curvature
/// and stretch, which the chord does not see.
Piece make_piece(const Clearance& a, const Clearance& b) {
  const double way = std::max((b.at - a.at).norm(), b.s - a.s) * 1.05;
  return {a, b, 0.5 * (a.value + b.value - way)};
}

Clearance smallest_gap(const GapAlong& gap, double begin, double end, double tolerance) {
  const double coarse = std::max(2 * gap.radius(), (end - begin) / 2000);
  const double fine = std::max(gap.radius() / 25, (end - begin) / 20000);  // hides gaps of at most half of this
  const int pieces = std::max(1, static_cast<int>(std::ceil((end - begin) / coarse)));
  std::priority_queue<Piece> open;
  Clearance last = gap.at(begin), best = last;
  if (best.obstacle < 0) return best;
  for (int i = 1; i <= pieces; ++i) {
    const Clearance next = gap.at(begin + (end - begin) * i / pieces);
    if (next.value < best.value) best = next;
    open.push(make_piece(last, next));
    last = next;
  }
  double around = (end - begin) / pieces;
  while (!open.empty()) {
    const Piece piece = open.top();
    open.pop();
    if (piece.bound >= best.value) break;
    around = piece.b.s - piece.a.s;
    if (around <= fine) break;  // every piece left is at most one division away from this size
    const Clearance middle = gap.at(0.5 * (piece.a.s + piece.b.s));
    if (middle.value < best.value) best = middle;
    open.push(make_piece(piece.a, middle));
    open.push(make_piece(middle, piece.b));
  }
  return refine(gap, std::max(begin, best.s - around), std::min(end, best.s + around), tolerance, best);
}

}  // namespace

bool too_close(double gap, double required, double radius) {
  return required > 0 ? gap < required : gap < -0.01 * radius;
}

Clearance clearance_of(const Rod& rod, const Equilibrium& equilibrium, const DistanceTo& distance, double begin,
                       double end) {
  Clearance best;
  best.value = infinity;
  double from = 0;
  for (const RodPart& part : rod.parts) {
    const double a = std::max(begin, from), b = std::min(end, part.upto);
    from = part.upto;
    if (a > b || (a == b && a != begin)) continue;
    const GapAlong gap(equilibrium, distance, part.section.radius());
    const Clearance here = smallest_gap(gap, a, b, 1e-9 * rod.length);
    if (here.value < best.value) best = here;
  }
  return best;
}

}  // namespace tendril
