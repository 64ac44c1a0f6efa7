#include "method/assembly/handle_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

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
// Distances are exact up to so many radii.
constexpr double exact_upto = 5;
// What rests on a surface is a little nearer to it than its radius.
constexpr double resting = 2e-3;
// The estimate of what is left counts so much more: far fewer places are looked at, and no way is dearer by more.
constexpr double haste = 1.5;

/// A place of the grid: its distance from the nearest surface and what the present search knows of it.
struct Node {
  float distance = -1;   ///< m; negative: not looked up yet
  int search = -1;       ///< which search the rest belongs to
  double value = 0;      ///< cost up to here, or width
  long parent = -1;
};

double step_for(const FreeSpace& space, const HandlePathOptions& options) {
  const double wanted = options.grid > 0 ? options.grid : std::max(options.radius, 2e-3);
  return std::max(wanted, std::cbrt(space.region().volume() / most_nodes));
}

}  // namespace

/// A grid over the region of which only what searches reach takes memory; distances are looked up when they are asked for.
class HandlePaths::Grid {
 public:
  Grid(const FreeSpace& space, const Vec3& from, const HandlePathOptions& options)
      : space_(space), from_(from), options_(options), step_(step_for(space, options)), corner_(space.region().min()) {
    for (int k = 0; k < 3; ++k) {
      size_[k] = static_cast<int>(space.region().sizes()[k] / step_) + 1;
      blocks_wide_[k] = (size_[k] + side - 1) / side;
    }
    blocks_.resize(static_cast<std::size_t>(blocks_wide_[0]) * blocks_wide_[1] * blocks_wide_[2]);
  }
  double step() const { return step_; }
  const FreeSpace& space() const { return space_; }
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
  /// Nodes beside the place where the handle is, that one first.
  std::vector<long> around_start() const {
    const Eigen::Vector3i middle = nearest(from_);
    std::vector<long> nodes{node(middle)};
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3i c = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (i != 13 && holds(c)) nodes.push_back(node(c));
    }
    return nodes;
  }

  /// m from the nearest surface; beyond `exact_upto` radii the field's lower bound.
  double distance(long node) {
    float& known = at(node).distance;
    if (known >= 0) return known;
    const Vec3 p = place(node);
    const double near = exact_upto * options_.radius, radius = space_.demands().radius, low = space_.bounds(p).low + radius;
    known = static_cast<float>(low > near ? low : std::max(0.0, std::max(low, space_.gap(p, near).value + radius)));
    return known;
  }
  /// The largest ball that may be here, m. Around the handle what it has there is enough, then ever more.
  double width(long node) {
    const double d = distance(node) + resting * options_.radius;
    return d >= options_.radius + 0.5 * (place(node) - from_).norm() ? INFINITY : d;
  }
  bool is_out(long node) {
    if (options_.exit) return (place(node) - *options_.exit).norm() <= 1.01 * step_;
    return distance(node) >= options_.arm;
  }
  /// The node as a new search finds it.
  Node& at(long node, int search, double value) {
    Node& found = at(node);
    if (found.search != search) {
      found.search = search;
      found.value = value;
      found.parent = -1;
    }
    return found;
  }
  long parent(long node) { return at(node).parent; }
  int next_search() { return searches_++; }

 private:
  static constexpr int side = 16;
  using Block = std::array<Node, side * side * side>;

  Node& at(long node) {
    const Eigen::Vector3i c = cell(node);
    std::unique_ptr<Block>& block =
        blocks_[c[0] / side + static_cast<std::size_t>(blocks_wide_[0]) * (c[1] / side + static_cast<std::size_t>(blocks_wide_[1]) * (c[2] / side))];
    if (!block) block = std::make_unique<Block>();
    return (*block)[c[0] % side + side * (c[1] % side + side * (c[2] % side))];
  }

  const FreeSpace& space_;
  const Vec3& from_;
  const HandlePathOptions& options_;
  double step_;
  Vec3 corner_;
  std::array<int, 3> size_, blocks_wide_;
  std::vector<std::unique_ptr<Block>> blocks_;
  int searches_ = 0;
};

/// The A* search for a ball from the handle to where it may end, and the widest way.
class HandlePaths::Search {
 public:
  Search(Grid& grid, const Vec3& from, const HandlePathOptions& options, const RunContext& context)
      : grid_(grid), from_(from), options_(options), context_(context), search_(grid.next_search()) {}

  /// Nodes by how wide the way to them is, the widest first (Dijkstra's method for the least width of a way).
  WidestWay widest() {
    struct Waiting {
      double width, distance;
      long node;
      bool operator<(const Waiting& other) const { return std::tie(width, distance, node) < std::tie(other.width, other.distance, other.node); }
    };
    std::priority_queue<Waiting> waiting;
    for (const long node : grid_.around_start()) {
      const double width = grid_.width(node);
      grid_.at(node, search_, 0).value = width;
      waiting.push({width, grid_.distance(node), node});
    }
    WidestWay way;
    double least = INFINITY;
    long narrowest = waiting.top().node;
    for (long popped = 1; !waiting.empty(); ++popped) {
      const Waiting next = waiting.top();
      waiting.pop();
      if (next.width < grid_.at(next.node, search_, 0).value) continue;
      if (popped % 1024 == 0 && context_.stop()) break;
      // What is wider than all before it lies behind the narrowest place so far.
      if (next.width < least) {
        least = next.width;
        narrowest = next.node;
      }
      if (grid_.is_out(next.node)) {
        way.radius = least;
        break;
      }
      each_neighbour(next.node, [&](long node, double steps) {
        const double width = std::min(next.width, grid_.width(node));
        Node& known = grid_.at(node, search_, 0);
        // A straight that is longer than what is free at both its ends might lead through a thin wall.
        if (width <= known.value || std::min(grid_.distance(next.node), grid_.distance(node)) <= 0.5 * steps * grid_.step()) return;
        known.value = width;
        waiting.push({width, grid_.distance(node), node});
      });
    }
    way.narrow = grid_.place(narrowest);
    way.obstacle = grid_.space().gap(way.narrow, options_.arm).obstacle;
    return way;
  }

  /// Outwards; empty: there is no way.
  std::vector<Vec3> cheapest(double ball) {
    struct Waiting {
      double bound, cost;  ///< of the whole way, about; up to here
      long node;
      bool operator<(const Waiting& other) const { return std::tie(bound, node) > std::tie(other.bound, other.node); }
    };
    std::priority_queue<Waiting> waiting;
    for (const long node : grid_.around_start()) {
      if (grid_.width(node) < ball) continue;
      const double cost = price(node) * (grid_.place(node) - from_).norm();
      grid_.at(node, search_, INFINITY).value = cost;
      waiting.push({cost + still(node), cost, node});
    }
    for (long popped = 1; !waiting.empty(); ++popped) {
      const Waiting next = waiting.top();
      waiting.pop();
      if (next.cost > grid_.at(next.node, search_, INFINITY).value) continue;
      if (grid_.is_out(next.node)) return way_to(next.node);
      if (popped % 1024 == 0 && context_.stop()) return {};
      each_neighbour(next.node, [&](long node, double steps) {
        if (grid_.width(node) < ball) return;
        const double there = next.cost + 0.5 * (price(next.node) + price(node)) * steps * grid_.step();
        Node& known = grid_.at(node, search_, INFINITY);
        if (there >= known.value) return;
        known.value = there;
        known.parent = next.node;
        waiting.push({there + still(node), there, node});
      });
    }
    return {};
  }

 private:
  template <class Visit>
  void each_neighbour(long node, const Visit& visit) {
    const Eigen::Vector3i cell = grid_.cell(node);
    for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
      const Eigen::Vector3i c = cell + Eigen::Vector3i(n.offset[0], n.offset[1], n.offset[2]);
      if (grid_.holds(c)) visit(grid_.node(c), n.steps);
    }
  }
  double price(long node) {
    const double share = 4 * options_.radius / std::max(grid_.distance(node), 0.25 * options_.radius);
    return 1 + share * share;
  }
  /// What the rest of the way costs at least, `haste` times: distances grow by no more than a metre in a metre.
  double still(long node) {
    if (options_.exit) return haste * (grid_.place(node) - *options_.exit).norm();
    return haste * std::max(0.0, options_.arm - grid_.distance(node));
  }
  std::vector<Vec3> way_to(long node) {
    std::vector<Vec3> way;
    for (long at = node; at >= 0; at = grid_.parent(at)) way.push_back(grid_.place(at));
    way.push_back(from_);
    std::reverse(way.begin(), way.end());
    if (options_.exit) way.push_back(*options_.exit);
    return way;
  }

  Grid& grid_;
  const Vec3& from_;
  const HandlePathOptions& options_;
  const RunContext& context_;
  int search_;
};

namespace {

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

}  // namespace

HandlePaths::HandlePaths(const FreeSpace& space, const Vec3& from, const HandlePathOptions& options, const RunContext& context)
    : space_(space), from_(from), options_(options), context_(context) {
  if (!(std::isfinite(options.radius) && options.radius > 0)) throw UsageError("assembly: the radius of the handle's ball must be above 0");
  if (!(std::isfinite(options.arm) && options.arm > 0)) throw UsageError("assembly: the system's arm must be above 0");
  if (!all_finite(from)) throw UsageError("assembly: the handle's place must be finite");
  widest_.radius = INFINITY;
  if (!space.has_obstacles()) return;
  grid_ = std::make_unique<Grid>(space_, from_, options_);
  widest_ = Search(*grid_, from_, options_, context_).widest();
}

HandlePaths::~HandlePaths() = default;

std::optional<HandlePath> HandlePaths::next() {
  if (!grid_) {
    if (tried_++ > 0) return std::nullopt;
    const Vec3 out = options_.exit ? *options_.exit : Vec3(from_ + options_.arm * Vec3::UnitZ());
    return HandlePath{{from_, out}, options_.arm, (out - from_).norm()};
  }
  while (tried_ < balls.size() && !context_.stop()) {
    const double ball = balls[tried_++] * options_.radius;
    if (ball > widest_.radius) continue;
    const std::vector<Vec3> way = Search(*grid_, from_, options_, context_).cheapest(ball);
    if (way.empty()) continue;
    HandlePath path = measured(space_, shortened(space_, way, ball), ball);
    if (is_known(found_, path, grid_->step())) continue;
    found_.push_back(path);
    return path;
  }
  return std::nullopt;
}

std::string HandlePaths::why() const {
  const auto mm = [](double metres) { return number_text(metres / units::mm); };
  const std::string place = "(" + mm(widest_.narrow.x()) + ", " + mm(widest_.narrow.y()) + ", " + mm(widest_.narrow.z()) + ") mm";
  const std::string beside = widest_.obstacle < 0 ? "" : " at " + space_.name(widest_.obstacle);
  if (widest_.radius <= 0) return "it is enclosed: every way ends, the widest" + beside + " near " + place + ", on a grid of " + mm(grid_->step()) + " mm";
  return "the widest way lets a ball of " + mm(widest_.radius) + " mm radius through, narrowest" + beside + " near " + place;
}

}  // namespace tendril::assembly
