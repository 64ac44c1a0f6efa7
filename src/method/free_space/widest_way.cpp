#include "method/free_space/widest_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Nearer than this (m) to a surface a node may lie on it but for rounding, and its edges would lead through.
constexpr double least_distance = 1e-6;

/// Of equally wide ways the shorter one first, then that of the lower node.
struct Waiting {
  double gap, length;
  int node;
  bool operator<(const Waiting& other) const {
    if (gap != other.gap) return gap < other.gap;
    return length > other.length || (length == other.length && node > other.node);
  }
};

struct Reached {
  double gap = -infinity, length = infinity;
  int before = -1;
  bool is_worse_than(double other_gap, double other_length) const {
    return other_gap > gap || (other_gap == gap && gap > -infinity && other_length < length);
  }
};

/// Gaps at the nodes of a lattice, asked for when first needed, and which of its edges a surface cuts.
class GapLattice {
 public:
  GapLattice(const FreeSpace& space, const NodeLattice& lattice, const std::vector<Ball>& closed)
      : space_(space), lattice_(lattice), closed_(closed), gaps_(lattice.count(), std::nan("")), in_the_way_(space.surroundings().size(), 0) {}

  Vec3 place(int node) const {
    const int nx = lattice_.size.x(), ny = lattice_.size.y();
    return lattice_.node(node % nx, node / nx % ny, node / (nx * ny));
  }

  /// At most 0; minus infinity within solids, on surfaces and where it is closed.
  double gap(int node) {
    double& known = gaps_[node];
    if (std::isnan(known)) known = measured(place(node));
    return known;
  }

  bool is_cut(int from, int to) {
    const Vec3 a = place(from), b = place(to);
    // Both are that far from every surface: a short edge meets none.
    const double clear = space_.demands().radius + (space_.demands().keep_out.empty() ? space_.demands().clearance : 0);
    if (gap(from) + gap(to) + 2 * clear > (b - a).norm()) return false;
    const auto hit = space_.surroundings().ray(a, b);
    if (hit) ++in_the_way_[hit->obstacle];
    return hit.has_value();
  }

  const std::vector<long>& in_the_way() const { return in_the_way_; }

 private:
  double measured(const Vec3& p) {
    for (const Ball& ball : closed_)
      if ((p - ball.middle).norm() < ball.radius) return -infinity;
    if (space_.bounds(p).low >= 0) return 0;
    const Gap gap = space_.gap(p, 0);
    if (gap.obstacle < 0) return 0;
    const bool wall = gap.obstacle >= space_.surroundings().size();
    const double off = space_.demands().radius + (wall ? 0 : space_.surroundings().obstacle(gap.obstacle).clearance);
    if (gap.value + off > least_distance) return gap.value;
    if (!wall) ++in_the_way_[gap.obstacle];
    return -infinity;
  }

  const FreeSpace& space_;
  const NodeLattice& lattice_;
  const std::vector<Ball>& closed_;
  std::vector<double> gaps_;
  std::vector<long> in_the_way_;
};

}  // namespace

WidestWay widest_way(const FreeSpace& space, const NodeLattice& lattice, const std::vector<int>& sources, const std::vector<int>& sinks,
                     const std::vector<Ball>& closed, const RunContext& context) {
  WidestWay way;
  GapLattice gaps(space, lattice, closed);
  std::vector<Reached> reached(lattice.count());
  std::vector<char> is_sink(lattice.count(), 0);
  for (const int sink : sinks) is_sink[sink] = 1;
  std::priority_queue<Waiting> waiting;
  const auto reach = [&](int node, double gap, double length, int before) {
    reached[node] = {gap, length, before};
    waiting.push({gap, length, node});
  };
  for (const int source : sources)
    if (gaps.gap(source) > -infinity) reach(source, gaps.gap(source), 0, -1);
  int found = -1;
  const Eigen::Array3i& size = lattice.size;
  while (!waiting.empty() && found < 0) {
    const Waiting next = waiting.top();
    waiting.pop();
    if (next.gap < reached[next.node].gap || next.length > reached[next.node].length) continue;
    if ((++way.reached & 1023) == 0 && context.stop()) return way;
    if (is_sink[next.node]) found = next.node;
    const int i = next.node % size.x(), j = next.node / size.x() % size.y(), k = next.node / (size.x() * size.y());
    for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.z() - 1); ++z)
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.y() - 1); ++y)
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, size.x() - 1); ++x) {
          const int other = static_cast<int>(lattice.index(x, y, z));
          const double length = next.length + std::sqrt(double((x - i) * (x - i) + (y - j) * (y - j) + (z - k) * (z - k)));
          if (other == next.node || !reached[other].is_worse_than(next.gap, length)) continue;
          const double through = std::min(next.gap, gaps.gap(other));
          if (reached[other].is_worse_than(through, length) && !gaps.is_cut(next.node, other)) reach(other, through, length, next.node);
        }
  }
  for (int node = found; node >= 0; node = reached[node].before) {
    way.places.push_back(gaps.place(node));
    way.gaps.push_back(gaps.gap(node));
  }
  std::reverse(way.places.begin(), way.places.end());
  std::reverse(way.gaps.begin(), way.gaps.end());
  way.in_the_way = gaps.in_the_way();
  return way;
}

}  // namespace tendril::routing
