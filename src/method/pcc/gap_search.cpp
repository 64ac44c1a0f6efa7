#include "method/pcc/gap_search.h"

#include <algorithm>
#include <cmath>

namespace tendril::routing {

namespace {

// Where the centre line is inside a solid, the smallest gap is known to this (m): there only its sign and size matter.
constexpr double loss_inside = 1e-4;
// Places nearer together than this (m) are measured at once, whatever the field knows.
constexpr double near_together = 10e-3;
constexpr int deepest = 48;
// No gap is asked for beyond this (m).
constexpr double farthest = 1e6;

double sagitta_of(const PccPiece& piece, double length) {
  if (!piece.is_arc) return 0;
  const double quarter = std::min(0.25 * length / piece.radius, 1.0);  // larger turns are divided in any case
  return 2 * piece.radius * std::sin(quarter) * std::sin(quarter);
}

}  // namespace

double least_between(double da, double db, double chord) {
  // What is far from one place is not near to the other.
  const double a = std::max(da, db - chord), b = std::max(db, da - chord);
  const double by_way = 0.5 * (a + b - chord);
  const double least_end = std::min(a, b);
  if (!(least_end > 0) || chord <= 0) return std::min(by_way, least_end);
  const double u = 0.5 * (1 + (a * a - b * b) / (chord * chord));
  if (u <= 0 || u >= 1) return least_end;
  const double squared = (1 - u) * a * a + u * b * b - u * (1 - u) * chord * chord;
  return std::max(by_way, std::sqrt(std::max(squared, 0.0)));
}

GapSearch::GapSearch(const FreeSpace& space, double limit, double loss, bool first)
    : space_(space), limit_(std::min(limit, farthest)), loss_(loss), first_(first) {
  const SpaceDemands& demands = space.demands();
  const bool zones = demands.keep_in || !demands.keep_out.empty();
  thickness_ = demands.radius + (zones ? 0.0 : demands.clearance);
  forget();
}

double GapSearch::threshold() const { return best_.value - (best_.value < -thickness_ ? std::max(loss_, loss_inside) : loss_); }

GapSearch::Place GapSearch::place(const PccPiece& piece, double s) const {
  Place place;
  place.s = s;
  place.at = piece.at(std::clamp((s - piece.begin) / piece.length, 0.0, 1.0));
  const DistanceField::Bounds known = space_.bounds(place.at);
  place.low = known.low;
  place.high = known.high;
  return place;
}

// Exact below `reach`; beyond it only that is known.
void GapSearch::measure(Place& place, double reach) {
  if (place.reach >= reach) return;
  const Gap gap = space_.gap(place.at, reach);
  ++queries_;
  place.reach = gap.obstacle >= 0 ? std::numeric_limits<double>::infinity() : reach;
  place.low = std::max(place.low, gap.value);
  place.high = gap.obstacle >= 0 ? gap.value : std::max(place.high, gap.value);
  if (gap.obstacle >= 0 && gap.value < best_.value) best_ = {gap.value, place.s, place.at, gap.on, gap.obstacle};
}

// Whether what is known of both places, or what may be hoped for at best, leaves nothing to find between them.
bool GapSearch::clear(const Place& a, const Place& b, double chord, double sagitta, bool hoped) const {
  const double enough = threshold() + sagitta;
  // More than this at one place suffices alone; it also keeps infinities out.
  const double most = enough + 2 * chord + 1e-9;
  const double at_a = std::min(hoped ? a.high : a.low, most) + thickness_;
  const double at_b = std::min(hoped ? b.high : b.low, most) + thickness_;
  return least_between(std::max(at_a, -farthest), std::max(at_b, -farthest), chord) - thickness_ >= enough;
}

void GapSearch::along(const PccPiece& piece, double from, double to) {
  from = std::max(from, piece.begin);
  to = std::min(to, piece.begin + piece.length);
  if (!(from <= to)) return;
  Place a = place(piece, from), b = place(piece, to);
  divide(piece, a, b, 0);
}

void GapSearch::sample(const PccPiece& piece, double from, double to, double spacing) {
  from = std::max(from, piece.begin);
  to = std::min(to, piece.begin + piece.length);
  if (!(from <= to)) return;
  const int count = static_cast<int>(std::min(std::ceil((to - from) / spacing), 1e4));
  for (int i = 0; i <= count; ++i) {
    Place here = place(piece, count > 0 ? from + (to - from) * i / count : from);
    if (here.low < best_.value) measure(here, best_.value);
  }
}

void GapSearch::divide(const PccPiece& piece, Place& a, Place& b, int depth) {
  if (ended()) return;
  const double length = b.s - a.s, chord = (b.at - a.at).norm(), sagitta = sagitta_of(piece, length);
  const bool wide = piece.is_arc && length > 2 * piece.radius;
  if (!wide && clear(a, b, chord, sagitta, false)) return;
  const bool worth = length < near_together || (!wide && clear(a, b, chord, sagitta, true));
  const double reach = threshold() + sagitta + 2 * chord + 1e-9;
  for (Place* end : {&a, &b})
    if (worth || end->high < threshold()) measure(*end, reach);
  if (ended() || (worth && clear(a, b, chord, sagitta, false)) || depth >= deepest) return;
  const double middle = a.s + 0.5 * length;
  if (!(middle > a.s && middle < b.s)) return;
  Place half = place(piece, middle);
  // The nearer half first: what is found there saves work in the other.
  if (a.low <= b.low) {
    divide(piece, a, half, depth + 1);
    divide(piece, half, b, depth + 1);
  } else {
    divide(piece, half, b, depth + 1);
    divide(piece, a, half, depth + 1);
  }
}

}  // namespace tendril::routing
