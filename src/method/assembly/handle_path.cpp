#include "method/assembly/handle_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>

#include "base/number_text.h"
#include "base/units.h"
#include "method/free_space/roadmap.h"

namespace tendril::assembly {

namespace {

using routing::FreeSpace;
using routing::Roadmap;

constexpr double most_nodes = 2e7;
// Balls that are tried, in radii of the thickest rod, the largest first.
constexpr std::array<double, 5> balls = {4, 3, 2, 1.5, 1};
// What rests on a surface is a little nearer to it than its radius.
constexpr double resting = 2e-3;

/// A grid over the region with distances that are looked up when they are asked for.
class Grid {
 public:
  Grid(const FreeSpace& space, double step) : space_(space), step_(step), corner_(space.region().min()) {
    for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>(space.region().sizes()[k] / step) + 1;
  }
  long nodes() const { return static_cast<long>(size_[0]) * size_[1] * size_[2]; }
  Vec3 place(long node) const { return corner_ + step_ * cell(node).cast<double>(); }
  Eigen::Vector3i cell(long node) const {
    return {static_cast<int>(node % size_[0]), static_cast<int>(node / size_[0] % size_[1]), static_cast<int>(node / size_[0] / size_[1])};
  }
  long node(const Eigen::Vector3i& c) const { return c[0] + static_cast<long>(size_[0]) * (c[1] + static_cast<long>(size_[1]) * c[2]); }
  bool holds(const Eigen::Vector3i& c) const { return (c.array() >= 0).all() && c[0] < size_[0] && c[1] < size_[1] && c[2] < size_[2]; }
  Eigen::Vector3i nearest(const Vec3& p) const {
    Eigen::Vector3i c = ((p - corner_) / step_).array().round().cast<int>().matrix();
    for (int k = 0; k < 3; ++k) c[k] = std::clamp(c[k], 0, size_[k] - 1);
    return c;
  }
  double step() const { return step_; }
  const FreeSpace& space() const { return space_; }

  /// m from the nearest surface: exact up to `near`, beyond that the field's lower bound.
  double distance(long node, double near) {
    const auto [entry, is_new] = distance_.try_emplace(node, 0.0f);
    float& known = entry->second;
    if (!is_new) return known;
    const Vec3 p = place(node);
    const double radius = space_.demands().radius, low = space_.bounds(p).low + radius;
    known = static_cast<float>(low > near ? low : std::max(0.0, std::max(low, space_.gap(p, near).value + radius)));
    return known;
  }

 private:
  const FreeSpace& space_;
  double step_;
  Vec3 corner_;
  std::array<int, 3> size_;
  std::unordered_map<long, float> distance_;  // few of the nodes are ever looked at
};

struct Waiting {
  double bound, cost;  ///< of the whole way at least; up to here
  long node;
  bool operator<(const Waiting& other) const { return bound > other.bound || (bound == other.bound && node > other.node); }
};

/// The A* search for a ball from the handle to where it may end.
class Search {
 public:
  Search(Grid& grid, const Vec3& from, const HandlePathOptions& options, double ball, const RunContext& context)
      : grid_(grid), from_(from), options_(options), ball_(ball), context_(context) {}

  /// Outwards; empty: there is no way.
  std::vector<Vec3> run() {
    std::priority_queue<Waiting> waiting;
    const Eigen::Vector3i middle = grid_.nearest(from_);
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3i c = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (!grid_.holds(c) || !passes(grid_.node(c))) continue;
      const double cost = price(grid_.node(c)) * (grid_.place(grid_.node(c)) - from_).norm();
      labels_[grid_.node(c)] = {cost, -1};
      waiting.push({cost + still(grid_.node(c)), cost, grid_.node(c)});
    }
    for (long popped = 0; !waiting.empty(); ++popped) {
      const Waiting next = waiting.top();
      waiting.pop();
      if (next.cost > labels_[next.node].cost) continue;
      if (is_out(next.node)) return way_to(next.node);
      if (popped % 1024 == 0 && context_.stop()) return {};
      for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
        const Eigen::Vector3i c = grid_.cell(next.node) + Eigen::Vector3i(n.offset[0], n.offset[1], n.offset[2]);
        if (!grid_.holds(c)) continue;
        const long other = grid_.node(c);
        if (!passes(other)) continue;
        const double there = next.cost + 0.5 * (price(next.node) + price(other)) * n.steps * grid_.step();
        const auto [label, is_new] = labels_.try_emplace(other, Label{there, next.node});
        if (!is_new && there >= label->second.cost) continue;
        label->second = {there, next.node};
        waiting.push({there + still(other), there, other});
      }
    }
    return {};
  }

 private:
  struct Label {
    double cost;
    long parent;
  };

  double near() const { return 8 * ball_ + options_.radius; }
  /// Around the handle as much as it has there is enough, then ever more.
  bool passes(long node) {
    const double from = (grid_.place(node) - from_).norm();
    const double least = std::min(ball_, options_.radius + 0.5 * from);
    return grid_.distance(node, near()) >= least - resting * options_.radius;
  }
  double price(long node) {
    const double share = 4 * options_.radius / std::max(grid_.distance(node, near()), 0.25 * options_.radius);
    return 1 + share * share;
  }
  bool is_out(long node) {
    if (options_.exit) return (grid_.place(node) - *options_.exit).norm() <= 1.01 * grid_.step();
    return grid_.distance(node, near()) >= options_.arm;
  }
  /// What the rest of the way costs at least: distances grow by no more than a metre in a metre, and a metre costs one.
  double still(long node) {
    if (options_.exit) return (grid_.place(node) - *options_.exit).norm();
    return std::max(0.0, options_.arm - grid_.distance(node, near()));
  }
  std::vector<Vec3> way_to(long node) const {
    std::vector<Vec3> way;
    for (long at = node; at >= 0; at = labels_.at(at).parent) way.push_back(grid_.place(at));
    way.push_back(from_);
    std::reverse(way.begin(), way.end());
    if (options_.exit) way.push_back(*options_.exit);
    return way;
  }

  Grid& grid_;
  const Vec3& from_;
  const HandlePathOptions& options_;
  double ball_;
  const RunContext& context_;
  std::unordered_map<long, Label> labels_;
};

/// The widest way out for a ball that may be thinner than the rods.
struct Widest {
  double radius = 0;   ///< m, of the ball; 0: no way of any width
  Vec3 narrow = Vec3::Zero();
  int obstacle = -1;   ///< nearest to the narrow place
};

/// Nodes by how wide the way to them is, the widest first (Dijkstra's method for the least distance of a way).
Widest widest_way(Grid& grid, const Vec3& from, const HandlePathOptions& options, const RunContext& context) {
  using Node = std::pair<double, long>;  // how wide the way to it is; which
  const double near = 8 * options.radius;
  const auto is_out = [&](long node) {
    if (options.exit) return (grid.place(node) - *options.exit).norm() <= 1.01 * grid.step();
    return grid.distance(node, near) >= options.arm;
  };
  std::unordered_map<long, double> widths;
  std::priority_queue<Node> waiting;
  const long first = grid.node(grid.nearest(from));
  waiting.push({INFINITY, first});
  widths[first] = INFINITY;
  Widest widest;
  long narrowest = first;
  double least = INFINITY;
  for (long popped = 1; !waiting.empty(); ++popped) {
    const auto [width, node] = waiting.top();
    waiting.pop();
    if (width < widths[node]) continue;
    if (popped % 1024 == 0 && context.stop()) return widest;
    // What is wider than all before it lies behind the narrowest place so far.
    if (width < least) {
      least = width;
      narrowest = node;
    }
    if (is_out(node)) {
      widest.radius = least;
      break;
    }
    for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
      const Eigen::Vector3i c = grid.cell(node) + Eigen::Vector3i(n.offset[0], n.offset[1], n.offset[2]);
      if (!grid.holds(c)) continue;
      const long other = grid.node(c);
      const double there = std::min(width, grid.distance(other, near));
      double& known = widths[other];
      // A straight that is longer than what is free at both its ends might lead through a thin wall.
      if (there <= 0.5 * n.steps * grid.step() || there <= known) continue;
      known = there;
      waiting.push({there, other});
    }
  }
  widest.narrow = grid.place(narrowest);
  widest.obstacle = grid.space().gap(widest.narrow, options.arm).obstacle;
  return widest;
}

std::string text_of(const Widest& widest, const Grid& grid) {
  const auto mm = [](double metres) { return number_text(metres / units::mm); };
  const std::string place = "(" + mm(widest.narrow.x()) + ", " + mm(widest.narrow.y()) + ", " + mm(widest.narrow.z()) + ") mm";
  const std::string beside = widest.obstacle < 0 ? "" : " at '" + grid.space().name(widest.obstacle) + "'";
  if (widest.radius <= 0) return "it is enclosed: every way ends, the widest" + beside + " near " + place + ", on a grid of " + mm(grid.step()) + " mm";
  return "the widest way lets a ball of " + mm(widest.radius) + " mm radius through, narrowest" + beside + " near " + place;
}

/// Straights over as many places as keep the smallest distance of the places that they pass by.
std::vector<Vec3> shortened(const FreeSpace& space, const std::vector<Vec3>& way, double most) {
  const double radius = space.demands().radius;
  std::vector<double> gap;
  for (const Vec3& p : way) gap.push_back(std::min(space.gap(p, most).value, most));
  std::vector<Vec3> straights{way.front()};
  for (std::size_t i = 0; i + 1 < way.size();) {
    std::size_t farthest = i + 1;
    double least = std::min(gap[i], gap[i + 1]);
    for (std::size_t j = i + 2; j < way.size(); ++j) {
      least = std::min(least, gap[j]);
      if (space.is_free(way[i], way[j], least - resting * radius)) farthest = j;
    }
    straights.push_back(way[farthest]);
    i = farthest;
  }
  return straights;
}

HandlePath measured(const FreeSpace& space, std::vector<Vec3> points, double most) {
  HandlePath path;
  path.points = std::move(points);
  path.clearance = most;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const double way = (path.points[i] - path.points[i - 1]).norm();
    path.length += way;
    const int pieces = std::max(1, static_cast<int>(std::ceil(way / (0.5 * space.demands().radius))));
    for (int k = 0; k <= pieces; ++k) {
      const Vec3 p = path.points[i - 1] + double(k) / pieces * (path.points[i] - path.points[i - 1]);
      // The handle's own place is as near as it is routed.
      if ((p - path.points.front()).norm() < 2 * most) continue;
      path.clearance = std::min(path.clearance, space.gap(p, most).value + space.demands().radius);
    }
  }
  return path;
}

bool is_known(const std::vector<HandlePath>& paths, const HandlePath& path, double near) {
  return std::any_of(paths.begin(), paths.end(), [&](const HandlePath& other) {
    return std::abs(other.length - path.length) < near && other.points.size() == path.points.size();
  });
}

double step_for(const FreeSpace& space, const HandlePathOptions& options) {
  const double wanted = options.grid > 0 ? options.grid : std::max(options.radius, 2e-3);
  const double volume = space.region().volume();
  return std::max(wanted, std::cbrt(volume / most_nodes));
}

}  // namespace

HandlePaths handle_paths(const FreeSpace& space, const Vec3& from, const HandlePathOptions& options, const RunContext& context) {
  if (!(std::isfinite(options.radius) && options.radius > 0)) throw UsageError("assembly: the radius of the handle's ball must be above 0");
  if (!(std::isfinite(options.arm) && options.arm > 0)) throw UsageError("assembly: the system's arm must be above 0");
  if (!all_finite(from)) throw UsageError("assembly: the handle's place must be finite");
  HandlePaths result;
  if (!space.has_obstacles()) {
    const Vec3 out = options.exit ? *options.exit : Vec3(from + options.arm * Vec3::UnitZ());
    result.paths.push_back({{from, out}, options.arm, (out - from).norm()});
    return result;
  }
  Grid grid(space, step_for(space, options));
  for (const double ball : balls) {
    if (static_cast<int>(result.paths.size()) >= options.most_paths || context.stop()) break;
    const std::vector<Vec3> way = Search(grid, from, options, ball * options.radius, context).run();
    if (way.empty()) continue;
    HandlePath path = measured(space, shortened(space, way, ball * options.radius), ball * options.radius);
    if (!is_known(result.paths, path, grid.step())) result.paths.push_back(std::move(path));
  }
  if (result.paths.empty() && !context.stop()) {
    const Widest widest = widest_way(grid, from, options, context);
    result.widest = widest.radius;
    result.narrow = widest.narrow;
    result.why = text_of(widest, grid);
  }
  return result;
}

}  // namespace tendril::assembly
