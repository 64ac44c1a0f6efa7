#include "method/preform/pcc_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "method/pcc/pcc_unknowns.h"
#include "method/preform/end_seeds.h"
#include "method/preform/in_parallel.h"

namespace tendril::preform {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// What a metre costs more where the field says that it is blocked, and where arcs leave no room for what is demanded.
constexpr double blocked_cost = 3;
// How strongly edges of unequal length are avoided.
constexpr double evenness = 2;
// Path vertices that are tried at most: longer paths are thinned out evenly.
constexpr int most_vertices = 64;
constexpr int most_end_seeds = 6;

/// The shortest polylines with few vertices along one path.
class Shortcuts {
 public:
  Shortcuts(const FreeSpace& space, const Options& options, const std::vector<Vec3>& path) : space_(space), options_(options) {
    thin(path);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length_ += (path[i + 1] - path[i]).norm();
    // Vertices on the ends' directions, at distances that leave room for more or less sharp bends.
    const double radius = options.curve.radii.front();
    const std::array<double, 5> rooms = {0.15, 0.5, 1, 2, 4};
    for (std::size_t k = 0; k < rooms.size(); ++k) {
      const double away = options.curve.end_straight + rooms[k] * radius;
      firsts_[k] = options.ends.start + away * options.ends.start_along;
      lasts_[k] = options.ends.finish - away * options.ends.finish_along;
      at_start_[k] = blocked(options.ends.start, firsts_[k]) + away;
      at_finish_[k] = blocked(lasts_[k], options.ends.finish) + away;
    }
    between_.resize(path_.size() * path_.size(), -1);
    for (std::size_t k = 0; k < rooms.size(); ++k)
      for (const Vec3& vertex : path_) {
        from_first_[k].push_back(from_start(k, vertex) + blocked(firsts_[k], vertex));
        to_last_[k].push_back(to_finish(k, vertex) + blocked(vertex, lasts_[k]));
      }
  }

  /// The best with this many bends, at least 2.
  std::vector<Vec3> best(int bends) {
    mean_ = length_ / (bends + 1);
    return bends == 2 ? best_of_two() : best_of_more(bends - 2);
  }

 private:
  void thin(const std::vector<Vec3>& path) {
    const int count = static_cast<int>(path.size()), kept = std::min(count, most_vertices);
    for (int i = 0; i < kept; ++i) path_.push_back(path[kept > 1 ? static_cast<long>(i) * (count - 1) / (kept - 1) : 0]);
  }

  /// What an edge costs by its length and what blocks it.
  double blocked(const Vec3& a, const Vec3& b) const {
    if (!space_.has_obstacles() && !space_.demands().keep_in) return 0;
    const double length = (b - a).norm(), step = options_.grid;
    const int count = std::clamp(static_cast<int>(std::ceil(length / step)), 1, 1000);
    int missed = 0;
    for (int i = 0; i < count; ++i) {
      const DistanceField::Bounds bounds = space_.bounds(a + (i + 0.5) / count * (b - a));
      if (bounds.low + bounds.high < 0) ++missed;  // outside the field: not a number, not blocked
    }
    return blocked_cost * length * missed / count;
  }
  double uneven(const Vec3& a, const Vec3& b) const {
    const double length = (b - a).norm();
    return length + evenness * (length - mean_) * (length - mean_) / mean_;
  }
  double between(int i, int j) {
    double& known = between_[i * path_.size() + j];
    if (known < 0) known = blocked(path_[i], path_[j]);
    return known + uneven(path_[i], path_[j]);
  }
  /// Room that the bend at an end's vertex lacks for turning from the end's direction into the way on.
  double lacking(const Vec3& end, const Vec3& vertex, const Vec3& on, double least) const {
    const Vec3 in = (vertex - end).normalized(), way = on - vertex;
    const double out = way.norm();
    if (!(out > 0)) return infinity;
    const double turn = std::min(routing::turn_between(in, way / out), 3.0);
    const double tangent = options_.curve.radii.front() * std::tan(0.5 * turn);
    return blocked_cost * (std::max(0.0, tangent + least - (vertex - end).norm()) + std::max(0.0, tangent - out));
  }
  double from_start(int k, const Vec3& on) const {
    return at_start_[k] + lacking(options_.ends.start, firsts_[k], on, options_.curve.end_straight);
  }
  double to_finish(int k, const Vec3& from) const {
    return at_finish_[k] + lacking(options_.ends.finish, lasts_[k], from, options_.curve.end_straight);
  }

  std::vector<Vec3> best_of_two() const {
    double least = infinity;
    std::vector<Vec3> best;
    for (std::size_t k = 0; k < firsts_.size(); ++k)
      for (std::size_t l = 0; l < lasts_.size(); ++l) {
        const double cost = from_start(k, lasts_[l]) + to_finish(l, firsts_[k]) + uneven(firsts_[k], lasts_[l]) +
                            blocked(firsts_[k], lasts_[l]);
        if (!(cost < least)) continue;
        least = cost;
        best = {firsts_[k], lasts_[l]};
      }
    return best;
  }

  /// Dynamic programming: by layers, the cheapest way to each path vertex as the last but one of so many.
  std::vector<Vec3> best_of_more(int inner) {
    const int count = static_cast<int>(path_.size());
    std::vector<std::vector<int>> from(inner, std::vector<int>(count, -1));
    std::vector<double> cost(count, infinity), next(count);
    for (int j = 0; j < count; ++j)
      for (std::size_t k = 0; k < firsts_.size(); ++k) {
        const double sum = from_first_[k][j] + uneven(firsts_[k], path_[j]);
        if (sum < cost[j]) cost[j] = sum, from[0][j] = static_cast<int>(k);
      }
    for (int layer = 1; layer < inner; ++layer) {
      std::fill(next.begin(), next.end(), infinity);
      for (int j = 0; j < count; ++j)
        for (int i = 0; i < j; ++i)
          if (const double sum = cost[i] + between(i, j); sum < next[j]) next[j] = sum, from[layer][j] = i;
      cost.swap(next);
    }
    double least = infinity;
    int last = -1, finish = -1;
    for (int j = 0; j < count; ++j)
      for (std::size_t k = 0; k < lasts_.size(); ++k) {
        const double sum = cost[j] + to_last_[k][j] + uneven(path_[j], lasts_[k]);
        if (sum < least) least = sum, last = j, finish = static_cast<int>(k);
      }
    if (last < 0) return {};
    std::vector<Vec3> vertices{lasts_[finish]};
    for (int layer = inner - 1; layer >= 0; --layer) {
      vertices.push_back(path_[last]);
      last = from[layer][last];
    }
    vertices.push_back(firsts_[last]);
    std::reverse(vertices.begin(), vertices.end());
    return vertices;
  }

  const FreeSpace& space_;
  const Options& options_;
  std::vector<Vec3> path_;
  double length_ = 0, mean_ = 1;
  std::array<Vec3, 5> firsts_, lasts_;
  std::array<double, 5> at_start_, at_finish_;
  std::array<std::vector<double>, 5> from_first_, to_last_;  ///< by path vertex: of the ends' edges, but for their lengths
  std::vector<double> between_;  ///< blocked() by pairs of path vertices; -1: not known yet
};

/// Adds a candidate unless one with the same vertices is there.
void add(std::vector<Candidate>& candidates, const Options& options, const std::vector<Vec3>& vertices, int path) {
  PccPoints points{{options.ends.start}, std::vector<double>(vertices.size(), options.curve.radii.front())};
  points.points.insert(points.points.end(), vertices.begin(), vertices.end());
  points.points.push_back(options.ends.finish);
  for (const Candidate& other : candidates) {
    if (other.points.bends() != points.bends()) continue;
    double farthest = 0;
    for (std::size_t i = 0; i < points.points.size(); ++i)
      farthest = std::max(farthest, (points.points[i] - other.points.points[i]).norm());
    if (farthest < 0.01 * options.curve.radii.front()) return;
  }
  candidates.push_back({points, path});
}

}  // namespace

std::vector<Candidate> pcc_sampling(const FreeSpace& space, const Options& options, const GlobalPaths& paths, const RunContext& context) {
  std::vector<Candidate> candidates;
  add(candidates, options, {}, -1);
  if (options.max_bends >= 1) add(candidates, options, {routing::crossing(options.ends)}, -1);
  for (const PccPoints& seed : end_seeds(options, most_end_seeds, context))
    add(candidates, options, {seed.points.begin() + 1, seed.points.end() - 1}, -1);
  std::vector<std::vector<std::vector<Vec3>>> found(paths.paths.size());  // vertices by path
  in_parallel(found.size(), context, "candidates", [&](std::size_t path) {
    if (paths.paths[path].size() < 2) return;
    Shortcuts shortcuts(space, options, paths.paths[path]);
    for (int bends = 2; bends <= options.max_bends; ++bends) found[path].push_back(shortcuts.best(bends));
  });
  for (std::size_t path = 0; path < found.size(); ++path)
    for (const std::vector<Vec3>& vertices : found[path])
      if (!vertices.empty()) add(candidates, options, vertices, static_cast<int>(path));
  return candidates;
}

}  // namespace tendril::preform
