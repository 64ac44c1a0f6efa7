#include "method/pcc/pcc_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/number_text.h"
#include "base/units.h"
#include "method/pcc/gap_search.h"

namespace tendril::routing {

namespace {

// A turn below this (rad) is rounding of points that lie on a line, as in pieces_of().
constexpr double no_turn = 1e-9;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The arc lengths between which gaps count.
struct Kept {
  double from, to;
};

Kept kept_of(const std::vector<PccPiece>& pieces, double free_start, double free_finish) {
  const double length = pieces.empty() ? 0 : pieces.back().begin + pieces.back().length;
  return {free_start, length - free_finish};
}

struct Found {
  Violation violation;
  double share = 0;  ///< of what was demanded
};

/// A vertex at which the curve bends.
struct Corner {
  double turn = 0, radius = 0, tangent = 0;  ///< rad, m, m
  double reach = 0;                          ///< m, from the start along the edges
};

struct Polyline {
  std::vector<Corner> corners;
  double edges = 0;  ///< m, their sum
};

Polyline polyline_of(const PccPoints& curve) {
  Polyline line;
  const std::vector<Vec3> along = edge_directions(curve.points);
  for (std::size_t i = 0; i < along.size(); ++i) {
    line.edges += (curve.points[i + 1] - curve.points[i]).norm();
    if (i + 1 == along.size()) break;
    const double turn = turn_between(along[i], along[i + 1]), radius = curve.radii[i];
    if (turn > no_turn) line.corners.push_back({turn, radius, radius * std::tan(0.5 * turn), line.edges});
  }
  return line;
}

void check(const PccDemands& demands, const Ends& ends, const PccPoints& curve, double tolerance) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw UsageError("violations: " + what);
  };
  require(curve.points.size() >= 2 && curve.points.size() == curve.radii.size() + 2,
          std::to_string(curve.points.size()) + " points and " + std::to_string(curve.radii.size()) +
              " radii; two ends, and a radius for each vertex between them, are expected");
  require(std::all_of(curve.points.begin(), curve.points.end(), [](const Vec3& p) { return all_finite(p); }),
          "a point of the curve is not finite");
  require(std::all_of(curve.radii.begin(), curve.radii.end(), [](double r) { return std::isfinite(r) && r >= 0; }),
          "a radius of the curve is not finite or negative");
  require(!demands.radii.empty(), "no bend radius is allowed; at least one expected");
  require(std::isfinite(demands.free_ends) && demands.free_ends >= 0,
          "the free ends are " + number_text(demands.free_ends) + " m; at least 0 expected");
  require(tolerance > 0 && std::isfinite(tolerance), "the tolerance is " + number_text(tolerance) + "; above 0 expected");
  const double scale = 1e-9 * (1 + curve.points.front().cwiseAbs().maxCoeff() + curve.points.back().cwiseAbs().maxCoeff());
  require((curve.points.front() - ends.start).norm() <= scale, "the curve does not begin at the start");
  require((curve.points.back() - ends.finish).norm() <= scale, "the curve does not end at the finish");
}

/// Collects what is violated, with the place by arc length.
class Collector {
 public:
  Collector(const std::vector<PccPiece>& pieces, double tolerance) : pieces_(pieces), tolerance_(tolerance) {}

  void add(Violation::Kind kind, double by, double demanded, double s) {
    if (!(by > tolerance_)) return;
    Violation v;
    v.kind = kind;
    v.by = by;
    v.s = s;
    v.at = place(s);
    found.push_back({v, by / demanded});
  }

  std::vector<Found> found;

 private:
  Vec3 place(double s) const {
    for (const PccPiece& piece : pieces_)
      if (s <= piece.begin + piece.length) return piece.at(std::clamp((s - piece.begin) / piece.length, 0.0, 1.0));
    return pieces_.empty() ? Vec3(Vec3::Zero()) : pieces_.back().finish;
  }
  const std::vector<PccPiece>& pieces_;
  double tolerance_;
};

void check_straights(const PccDemands& demands, const Polyline& line, Collector& found) {
  const std::vector<Corner>& corners = line.corners;
  const double scale = demands.radii.front();
  double s = 0;  // where the straight begins on the curve
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const bool first = i == 0, last = i == corners.size();
    const double begin = first ? 0 : corners[i - 1].reach + corners[i - 1].tangent;
    const double straight = (last ? line.edges : corners[i].reach - corners[i].tangent) - begin;
    const double least = first && last ? 0 : first || last ? demands.end_straight : demands.min_straight;
    const auto kind = first || last ? Violation::Kind::end_straight : Violation::Kind::straight;
    found.add(kind, least - straight, std::max(least, scale), s + 0.5 * std::max(straight, 0.0));
    s += std::max(straight, 0.0) + (last ? 0 : corners[i].radius * corners[i].turn);
  }
}

void check_bends(const PccDemands& demands, const Polyline& line, Collector& found) {
  double s = 0, reached = 0;
  for (const Corner& corner : line.corners) {
    s += std::max(corner.reach - corner.tangent - reached, 0.0);
    const double arc = corner.radius * corner.turn, middle = s + 0.5 * arc;
    found.add(Violation::Kind::turn, corner.turn - demands.max_turn, demands.max_turn, middle);
    double off = infinity, tool = 0;
    for (const double radius : demands.radii)
      if (std::abs(radius - corner.radius) < off) off = std::abs(radius - corner.radius), tool = radius;
    found.add(Violation::Kind::radius, off, tool, middle);
    s += arc;
    reached = corner.reach + corner.tangent;
  }
}

void check_whole(const PccDemands& demands, const Ends& ends, const PccPoints& curve, Collector& found) {
  const double length = curve.length();
  found.add(Violation::Kind::length, demands.min_length - length, demands.min_length, 0.5 * length);
  found.add(Violation::Kind::length, length - demands.max_length, demands.max_length, 0.5 * length);
  // What no cone allows is weighed against a tenth of a radian.
  const double least_cone = 0.1;
  const std::vector<Vec3> along = edge_directions(curve.points);
  const auto cone = [&](const Vec3& edge, const Vec3& wanted, double half_angle, double s) {
    found.add(Violation::Kind::cone, turn_between(wanted, edge) - half_angle, std::max(half_angle, least_cone), s);
  };
  cone(along.front(), ends.start_along, demands.start_cone, 0);
  cone(along.back(), ends.finish_along, demands.finish_cone, length);
}

/// The worst gap by obstacle, zone and wall.
void check_gaps(const FreeSpace& space, const std::vector<PccPiece>& pieces, const Kept& kept, double tolerance,
                std::vector<Found>& found) {
  // A search finds the smallest of all gaps of a piece; worse ones of other pieces must not hide it.
  GapSearch search(space, -0.5 * tolerance, 0.5 * tolerance);
  const int first_zone = space.first_zone(), walls = static_cast<int>(space.demands().keep_out.size()) + first_zone;
  for (const PccPiece& piece : pieces) {
    search.forget();
    search.along(piece, kept.from, kept.to);
    const CurveGap& gap = search.best();
    if (gap.obstacle < 0) continue;
    using Kind = Violation::Kind;
    const Kind kind = gap.obstacle < first_zone ? Kind::clearance : gap.obstacle < walls ? Kind::keep_out : Kind::keep_in;
    const double demanded = space.demands().radius + (kind == Kind::clearance ? space.demands().clearance : 0);
    const Found worst{{kind, -gap.value, gap.s, gap.at, gap.obstacle}, -gap.value / std::max(demanded, tolerance)};
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const Found& f) { return f.violation.obstacle == gap.obstacle; });
    if (same == found.end()) found.push_back(worst);
    else if (worst.violation.by > same->violation.by) *same = worst;
  }
}

/// How far a point is outside a box, m; negative inside.
double outside(const Eigen::AlignedBox3d& box, const Vec3& p) {
  return std::max((box.min() - p).maxCoeff(), (p - box.max()).maxCoeff());
}

/// Where along the free ends of a piece the centre line passes through a surface, or leaves keep_in the most.
void check_free_end(const FreeSpace& space, const PccPiece& piece, double from, double to, double tolerance, Collector& found) {
  from = std::max(from, piece.begin);
  to = std::min(to, piece.begin + piece.length);
  if (!(from < to)) return;
  // Chords of an arc, within the tolerance of it.
  const double chord = piece.is_arc ? std::sqrt(8 * piece.radius * tolerance) : infinity;
  const int count = std::max(1, static_cast<int>(std::min(std::ceil((to - from) / chord), 1e5)));
  const auto at = [&](int i) { return piece.at(((from + (to - from) * i / count) - piece.begin) / piece.length); };
  const double whole = std::max(space.demands().radius + space.demands().clearance, 2 * tolerance);
  const auto& keep_in = space.demands().keep_in;
  double farthest = 0, farthest_s = 0;
  for (int i = 0; i <= count; ++i) {
    const double s = from + (to - from) * i / count;
    const double out = keep_in ? outside(*keep_in, at(i)) : 0;
    if (out > farthest) farthest = out, farthest_s = s;
    if (i == count) break;
    if (const auto hit = space.surroundings().ray(at(i), at(i + 1))) {
      found.add(Violation::Kind::crossing, whole, whole, s + hit->share * (to - from) / count);
      found.found.back().violation.obstacle = hit->obstacle;
      break;
    }
  }
  if (farthest > tolerance) {
    found.add(Violation::Kind::keep_in, farthest, std::max(space.demands().radius, tolerance), farthest_s);
    found.found.back().violation.obstacle = space.first_zone() + static_cast<int>(space.demands().keep_out.size());
  }
}

std::string in_mm(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f mm", value < 0.1 * units::mm ? 3 : 1, value / units::mm);
  return text;
}

std::string in_degrees(double angle) { return number_text(std::round(1e3 * angle / units::deg) / 1e3) + " degrees"; }

}  // namespace

CurveGap smallest_gap(const FreeSpace& space, const PccPoints& curve, double free_ends, double limit, double tolerance) {
  return smallest_gap(space, curve, free_ends, free_ends, limit, tolerance);
}

CurveGap smallest_gap(const FreeSpace& space, const PccPoints& curve, double free_start, double free_finish, double limit, double tolerance) {
  const std::vector<PccPiece> pieces = pieces_of(curve);
  const Kept kept = kept_of(pieces, free_start, free_finish);
  GapSearch search(space, limit, tolerance);
  constexpr double first_look = 20e-3;
  for (const PccPiece& piece : pieces) search.sample(piece, kept.from, kept.to, first_look);
  for (const PccPiece& piece : pieces) search.along(piece, kept.from, kept.to);
  return search.best();
}

CurveClearance clearance_of(const FreeSpace& space, const PccPoints& curve, double free_start, double free_finish, double limit) {
  CurveClearance clearance{smallest_gap(space, curve, free_start, free_finish, limit, FreeSpace::straight_tolerance), ""};
  const int obstacle = clearance.gap.obstacle;
  if (obstacle < 0) return clearance;
  clearance.to = space.name(obstacle);
  if (obstacle < space.surroundings().size()) clearance.gap.value += space.surroundings().clearance(obstacle);
  return clearance;
}

bool is_clear(const FreeSpace& space, const PccPoints& curve, double free_ends, double tolerance) {
  const std::vector<PccPiece> pieces = pieces_of(curve);
  const Kept kept = kept_of(pieces, free_ends, free_ends);
  GapSearch search(space, -0.5 * tolerance, 0.5 * tolerance, true);
  for (const PccPiece& piece : pieces) {
    search.along(piece, kept.from, kept.to);
    if (search.best().obstacle >= 0) return false;
  }
  return true;
}

std::vector<Violation> violations(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& curve,
                                  double tolerance) {
  check(demands, ends, curve, tolerance);
  const std::vector<PccPiece> pieces = pieces_of(curve);
  const Polyline line = polyline_of(curve);
  Collector collector(pieces, tolerance);
  check_straights(demands, line, collector);
  // Arcs may not overlap by more than rounding, whatever the tolerance: such a curve does not exist.
  const double overlap = overlap_of(curve);
  if (overlap > 0 && collector.found.empty())
    collector.add(Violation::Kind::straight, std::max(overlap, 1.01 * tolerance), demands.radii.front(), 0.5 * curve.length());
  check_bends(demands, line, collector);
  check_whole(demands, ends, curve, collector);
  if (overlap == 0) {
    const Kept kept = kept_of(pieces, demands.start_free(), demands.finish_free());
    std::vector<Found> gaps;
    check_gaps(space, pieces, kept, tolerance, gaps);
    collector.found.insert(collector.found.end(), gaps.begin(), gaps.end());
    // Its very ends may lie on what the object is plugged to.
    const double length = pieces.empty() ? 0 : pieces.back().begin + pieces.back().length;
    for (const PccPiece& piece : pieces) {
      check_free_end(space, piece, tolerance, std::min(kept.from, 0.5 * length), tolerance, collector);
      check_free_end(space, piece, std::max(kept.to, 0.5 * length), length - tolerance, tolerance, collector);
    }
  }
  std::stable_sort(collector.found.begin(), collector.found.end(),
                   [](const Found& a, const Found& b) { return a.share > b.share; });
  std::vector<Violation> all;
  for (const Found& each : collector.found) all.push_back(each.violation);
  return all;
}

std::string text_of(const Violation& violation, const FreeSpace& space) {
  using Kind = Violation::Kind;
  const bool named = violation.obstacle >= 0;
  const std::string name = named ? "'" + space.name(violation.obstacle) + "'" : "an obstacle";
  const std::string by = in_mm(violation.by), where = " at " + number_text(std::round(1e3 * violation.s) / 1e3) + " m";
  switch (violation.kind) {
    case Kind::clearance: return by + " too near to " + name + where;
    case Kind::keep_in: return by + " out of keep_in" + where;
    case Kind::keep_out: return by + " within " + (named ? name : "keep_out") + where;
    case Kind::straight: return "the straight between two bends " + by + " too short" + where;
    case Kind::end_straight: return "the straight at an end " + by + " too short" + where;
    case Kind::length: return by + " off the lengths allowed";
    case Kind::turn: return "a bend turns " + in_degrees(violation.by) + " too far" + where;
    case Kind::cone: return "the direction of an end " + in_degrees(violation.by) + " outside its cone" + where;
    case Kind::radius: return "a bend's radius " + by + " off the nearest tool" + where;
    case Kind::crossing: return "the free end passes through " + name + where;
  }
  return {};
}

}  // namespace tendril::routing
