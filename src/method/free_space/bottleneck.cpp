#include "method/free_space/bottleneck.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/units.h"
#include "method/free_space/widest_way.h"

namespace tendril::routing {
namespace {

/// Each zoom makes the step this much smaller, about so many places to both sides of the narrowest one.
constexpr int zooms = 3, finer = 6, beside = 3;
/// Narrow places of one way that are looked at closely, and ways.
constexpr int most_places = 12, most_ways = 6;
/// Where no way is found the step is halved, at most so often and to so many nodes.
constexpr int most_halvings = 2;
constexpr double most_nodes = 4e6;

NodeLattice lattice_over(const Eigen::AlignedBox3d& box, double step) {
  NodeLattice lattice;
  lattice.spacing = step;
  lattice.origin = box.min();
  lattice.size = (box.sizes().array() / step + 1e-9).floor().cast<int>() + 1;
  return lattice;
}

/// Nodes within `reach` of a place that no surface hides from it.
std::vector<int> nodes_around(const FreeSpace& space, const NodeLattice& lattice, const Vec3& p, double reach) {
  std::vector<int> nodes;
  const Eigen::Array3d at = ((p - lattice.origin) / lattice.spacing).array();
  const double steps = reach / lattice.spacing;
  const Eigen::Array3i first = (at - steps).ceil().max(0).cast<int>();
  const Eigen::Array3i last = (at + steps).floor().min((lattice.size - 1).cast<double>()).cast<int>();
  for (int k = first.z(); k <= last.z(); ++k)
    for (int j = first.y(); j <= last.y(); ++j)
      for (int i = first.x(); i <= last.x(); ++i) {
        const Vec3 node = lattice.node(i, j, k);
        if ((node - p).norm() <= reach && !space.surroundings().ray(p, node)) nodes.push_back(static_cast<int>(lattice.index(i, j, k)));
      }
  return nodes;
}

int narrowest(const WidestWay& way) {
  return static_cast<int>(std::min_element(way.gaps.begin(), way.gaps.end()) - way.gaps.begin());
}

struct Narrow {
  double gap = 0;  ///< m, at most 0
  Vec3 at = Vec3::Zero();
};

/// The way about one of its places on ever finer lattices, free to leave the nodes it went through.
Narrow zoomed(const FreeSpace& space, WidestWay way, int index, double step, const RunContext& context) {
  Narrow narrow{way.gaps[index], way.places[index]};
  for (int zoom = 0; zoom < zooms && narrow.gap < 0; ++zoom, step /= finer) {
    const int first = std::max(0, index - beside), last = std::min(static_cast<int>(way.places.size()) - 1, index + beside);
    Eigen::AlignedBox3d box;
    for (int i = first; i <= last; ++i) box.extend(way.places[i]);
    box.min().array() -= step;
    box.max().array() += step;
    box = box.intersection(space.region());
    const NodeLattice lattice = lattice_over(box, step / finer);
    const WidestWay finer_way = widest_way(space, lattice, nodes_around(space, lattice, way.places[first], step),
                                           nodes_around(space, lattice, way.places[last], step), {}, context);
    if (finer_way.places.empty()) break;
    way = finer_way;
    index = narrowest(way);
    // Nodes of the coarser lattice may lie better than those of the finer one.
    if (way.gaps[index] > narrow.gap) narrow = {way.gaps[index], way.places[index]};
  }
  return narrow;
}

/// The narrowest of the way's narrow places, each looked at closely.
Narrow narrowest_of(const FreeSpace& space, const WidestWay& way, double step, const RunContext& context) {
  std::vector<char> done(way.places.size(), 0);
  Narrow worst{std::numeric_limits<double>::infinity(), {}};
  for (int turn = 0; turn < most_places && !context.stop(); ++turn) {
    int index = -1;
    for (int i = 0; i < static_cast<int>(way.places.size()); ++i)
      if (!done[i] && (index < 0 || way.gaps[i] < way.gaps[index])) index = i;
    if (index < 0 || way.gaps[index] >= std::min(worst.gap, 0.0)) break;
    const Narrow found = zoomed(space, way, index, step, context);
    if (found.gap < worst.gap) worst = found;
    for (int i = std::max(0, index - beside + 1); i < std::min(static_cast<int>(way.places.size()), index + beside); ++i) done[i] = 1;
  }
  return worst;
}

/// What limits a place, and what does so on its other side.
std::string limits_of(const FreeSpace& space, const Vec3& p) {
  const Gap nearest = space.gap(p, std::numeric_limits<double>::infinity());
  if (nearest.obstacle < 0) return "";
  const Surroundings& surroundings = space.surroundings();
  const Vec3 to_nearest = nearest.on - p;
  std::string across;
  double least = 2 * to_nearest.norm() + 1e-6;
  const auto consider = [&](const Vec3& on, const std::string& name) {
    if (name == space.name(nearest.obstacle) || !((on - p).norm() < least) || (on - p).dot(to_nearest) > 0) return;
    least = (on - p).norm();
    across = name;
  };
  for (int i = 0; i < surroundings.size(); ++i) {
    const ClosestPoint found = surroundings.closest_on(i, p, least);
    if (found.obstacle >= 0) consider(found.point, space.name(i));
  }
  if (const auto& in = space.demands().keep_in)
    for (int k = 0; k < 3; ++k)
      for (const double wall : {in->min()[k], in->max()[k]}) {
        Vec3 on = p;
        on[k] = wall;
        consider(on, "keep_in");
      }
  const std::string name = "'" + space.name(nearest.obstacle) + "'";
  return across.empty() ? "at " + name : "between " + name + " and '" + across + "'";
}

/// The same start and finish on one lattice.
struct Attempt {
  NodeLattice lattice;
  std::vector<int> sources, sinks;
  Attempt(const FreeSpace& space, const Vec3& start, const Vec3& finish, double step) : lattice(lattice_over(space.region(), step)) {
    const double reach = 1.8 * step;  // the corners of the cell around, and a little more
    sources = nodes_around(space, lattice, start, reach);
    sinks = nodes_around(space, lattice, finish, reach);
  }
};

Bottleneck enclosure(const FreeSpace& space, const Attempt& attempt, const RunContext& context) {
  const WidestWay from_start = widest_way(space, attempt.lattice, attempt.sources, attempt.sinks, {}, context);
  const WidestWay from_finish = widest_way(space, attempt.lattice, attempt.sinks, attempt.sources, {}, context);
  const bool start = from_start.reached <= from_finish.reached;
  const WidestWay& way = start ? from_start : from_finish;
  Bottleneck result;
  result.kind = start ? Bottleneck::Kind::start_enclosed : Bottleneck::Kind::finish_enclosed;
  result.lets_through = attempt.lattice.spacing;
  const auto most = std::max_element(way.in_the_way.begin(), way.in_the_way.end());
  if (most != way.in_the_way.end() && *most > 0)
    result.between = "'" + space.name(static_cast<int>(most - way.in_the_way.begin())) + "'";
  return result;
}

/// The widest of several ways: each passage that was looked at is closed for the next. A grid misses the middle of a passage by
/// less than half a cell's diagonal: ways that are narrower by more need not be looked at.
Narrow widest_of(const FreeSpace& space, const Attempt& attempt, WidestWay way, const RunContext& context) {
  const double step = attempt.lattice.spacing;
  std::vector<Ball> closed;
  Narrow best{-std::numeric_limits<double>::infinity(), {}};
  for (int turn = 0; turn < most_ways && !way.places.empty() && !context.stop(); ++turn) {
    const int index = narrowest(way);
    if (way.gaps[index] + 0.87 * step < best.gap) break;
    const Narrow narrow = narrowest_of(space, way, step, context);
    if (narrow.gap > best.gap) best = {std::min(narrow.gap, 0.0), std::isfinite(narrow.gap) ? narrow.at : way.places[index]};
    if (best.gap >= 0) break;
    closed.push_back({way.places[index], 1.8 * step});
    way = widest_way(space, attempt.lattice, attempt.sources, attempt.sinks, closed, context);
  }
  return best;
}

}  // namespace

Bottleneck bottleneck_between(const FreeSpace& space, const Vec3& start, const Vec3& finish, double step, const RunContext& context) {
  Attempt attempt(space, start, finish, step);
  WidestWay way = widest_way(space, attempt.lattice, attempt.sources, attempt.sinks, {}, context);
  for (int halving = 0; halving < most_halvings && way.places.empty() && !context.stop(); ++halving) {
    if (8.0 * static_cast<double>(attempt.lattice.count()) > most_nodes) break;
    attempt = Attempt(space, start, finish, 0.5 * attempt.lattice.spacing);
    way = widest_way(space, attempt.lattice, attempt.sources, attempt.sinks, {}, context);
  }
  Bottleneck result;
  if (way.places.empty()) {
    result = enclosure(space, attempt, context);
  } else {
    const Narrow narrow = widest_of(space, attempt, std::move(way), context);
    result.kind = narrow.gap < 0 ? Bottleneck::Kind::narrow : Bottleneck::Kind::passable;
    result.at = narrow.at;
    result.lets_through = space.demands().radius + space.demands().clearance + narrow.gap;
    result.between = limits_of(space, result.at);
  }
  if (context.stop()) result.kind = Bottleneck::Kind::stopped;
  return result;
}

std::string text_of(const Bottleneck& bottleneck, const FreeSpace& space, double step) {
  const auto mm = [](double value) { return number_text(std::round(value / units::mm * 10) / 10) + " mm"; };
  const auto place = [&] {
    const auto rounded = [](double x) { return number_text(std::round(x * 1e4) / 1e4); };
    return "(" + rounded(bottleneck.at.x()) + ", " + rounded(bottleneck.at.y()) + ", " + rounded(bottleneck.at.z()) + ") m" +
           (bottleneck.between.empty() ? "" : " " + bottleneck.between);
  };
  const std::string wanted = mm(space.demands().radius + space.demands().clearance);
  switch (bottleneck.kind) {
    case Bottleneck::Kind::narrow:
      return "no passage for a radius + clearance of " + wanted + ": the widest one found, at " + place() + ", lets " +
             mm(std::max(bottleneck.lets_through, 0.0)) + " through";
    case Bottleneck::Kind::passable:
      return "no passage on a grid of " + mm(step) + ": it misses the one at " + place() + ", which is wide enough for a radius + clearance of " +
             wanted + "; take a smaller 'grid'";
    case Bottleneck::Kind::start_enclosed:
    case Bottleneck::Kind::finish_enclosed:
      return std::string(bottleneck.kind == Bottleneck::Kind::start_enclosed ? "start" : "finish") + " is enclosed" +
             (bottleneck.between.empty() ? "" : " by " + bottleneck.between) + ": no way for a radius above " + mm(bottleneck.lets_through) +
             " leads out of the space around it";
    case Bottleneck::Kind::stopped: break;
  }
  return "stopped before the passages were judged";
}

}  // namespace tendril::routing
