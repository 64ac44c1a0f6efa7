// Shortest paths through a roadmap from which more and more is taken away.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/run_context.h"
#include "method/free_space/roadmap.h"

namespace tendril::preform {

/// From one place to another, both joined to the nodes around them. Costs to the finish through all free nodes are found once; they
/// never overestimate those that are left when nodes are excluded, and guide every search (A*). Each search raises them where it
/// went in vain: what is behind a node and what is ahead of it are together at least the cost of the path (adaptive A*; Koenig and
/// Likhachev, AAMAS 2005), so that the next one does not go there again. Ties are broken by node.
class PathSearch {
 public:
  /// An end is joined to nodes up to so many steps away: not a distance that nodes of a grid have, so that rounding decides nothing.
  static constexpr double joined_steps = 2.37;

  PathSearch(const routing::FreeSpace& space, const routing::Roadmap& roadmap, const Vec3& start, const Vec3& finish);

  /// A way and its cost (m, by FreeSpace::cost).
  struct Path {
    std::vector<Vec3> places;  ///< start, nodes, finish; m. Empty: there is none
    std::vector<int> nodes;
    double cost = 0;
  };
  /// The cheapest path without excluded nodes, if it costs no more than `most` (m). Stopped by `context`: none.
  Path shortest(double most = std::numeric_limits<double>::infinity(), const RunContext& context = {});

  /// Takes away the nodes within `radius` (m) of a path's, but for those that `is_kept` holds for. Returns how many nodes of the
  /// path itself are among them.
  template <class IsKept>
  int exclude_around(const Path& path, double radius, const IsKept& is_kept);

 private:
  using Roadmap = routing::Roadmap;
  using Goal = Roadmap::Goal;
  std::vector<Goal> joined(const Vec3& end) const;
  void reach(int node, float cost, int from);
  void expand(int node);
  bool finish_is_enclosed() const;
  Path path_to(int node, float cost) const;

  const routing::FreeSpace& space_;
  const routing::Roadmap& roadmap_;
  Vec3 start_, finish_;
  std::vector<Goal> starts_, finishes_;
  std::vector<float> to_finish_;  ///< by node: never more than what it costs from there
  std::vector<float> leave_;      ///< by node: the straight to the finish; infinite for those that are not joined to it
  std::vector<char> excluded_;    ///< by node

  // Of the search under way, by node; what it touched is cleared afterwards.
  struct Waiting {
    float whole, behind;  ///< the least that the whole path costs; the cost up to here
    int node;
    bool operator<(const Waiting& other) const { return whole > other.whole || (whole == other.whole && node > other.node); }
  };
  float most_ = Roadmap::unreachable;  ///< m: nodes on no cheaper path are not gone to
  std::vector<float> behind_;
  std::vector<int> before_, touched_;
  std::vector<Waiting> waiting_;  ///< a heap
};

template <class IsKept>
int PathSearch::exclude_around(const Path& path, double radius, const IsKept& is_kept) {
  const int reach = static_cast<int>(radius / roadmap_.step() + 1e-9);
  for (const int node : path.nodes) {
    const std::array<int, 3> at = roadmap_.cell(node);
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
          const std::array<int, 3> cell{at[0] + x, at[1] + y, at[2] + z};
          if (!roadmap_.holds(cell)) continue;
          char& excluded = excluded_[roadmap_.node(cell)];
          if (excluded || roadmap_.step() * std::sqrt(double(x * x + y * y + z * z)) > radius + 1e-9) continue;
          excluded = !is_kept(roadmap_.place(roadmap_.node(cell)));
        }
  }
  // None of them was excluded before, or the path would not have gone there.
  int taken = 0;
  for (const int node : path.nodes) taken += excluded_[node];
  return taken;
}

}  // namespace tendril::preform
