#include "method/preform/path_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace tendril::preform {

using routing::FreeSpace;
using routing::Roadmap;

namespace {

struct Waiting {
  float whole, behind;  ///< the least that the whole path costs; the cost up to here
  int node;
  bool operator<(const Waiting& other) const { return whole > other.whole || (whole == other.whole && node > other.node); }
};

/// Mean of both ends, as between nodes.
double cost_of_straight(const FreeSpace& space, const Vec3& a, const Vec3& b) {
  const double length = (b - a).norm();
  return space.has_preferences() ? 0.5 * (space.cost(a) + space.cost(b)) * length : length;
}

}  // namespace

PathSearch::PathSearch(const FreeSpace& space, const Roadmap& roadmap, const Vec3& start, const Vec3& finish)
    : space_(space), roadmap_(roadmap), start_(start), finish_(finish), starts_(joined(start)), finishes_(joined(finish)),
      to_finish_(roadmap.costs_to(finishes_)), excluded_(roadmap.nodes(), 0) {}

/// By free straights to nodes beyond the corners of the cell too, so that an end near a wall finds its way.
std::vector<PathSearch::Goal> PathSearch::joined(const Vec3& end) const {
  std::vector<Goal> goals;
  const std::array<int, 3> at = roadmap_.nearest(end);
  for (int z = -3; z <= 3; ++z)
    for (int y = -3; y <= 3; ++y)
      for (int x = -3; x <= 3; ++x) {
        const std::array<int, 3> cell{at[0] + x, at[1] + y, at[2] + z};
        if (!roadmap_.holds(cell) || !roadmap_.is_free(roadmap_.node(cell))) continue;
        const int node = roadmap_.node(cell);
        const Vec3 place = roadmap_.place(node);
        if ((place - end).norm() <= joined_steps * roadmap_.step() && space_.is_free(end, place))
          goals.push_back({node, cost_of_straight(space_, end, place)});
      }
  return goals;
}

PathSearch::Path PathSearch::shortest(const RunContext& context) const {
  std::vector<float> behind(roadmap_.nodes(), Roadmap::unreachable), ahead(roadmap_.nodes(), Roadmap::unreachable);
  std::vector<int> before(roadmap_.nodes(), -1);
  std::priority_queue<Waiting> waiting;
  const auto reach = [&](int node, float cost, int from) {
    if (excluded_[node] || !(cost < behind[node]) || to_finish_[node] == Roadmap::unreachable) return;
    behind[node] = cost;
    before[node] = from;
    waiting.push({cost + to_finish_[node], cost, node});
  };
  for (const Goal& goal : finishes_) ahead[goal.node] = static_cast<float>(goal.cost);
  for (const Goal& goal : starts_) reach(goal.node, static_cast<float>(goal.cost), -1);
  float best = Roadmap::unreachable;
  int last = -1;
  for (long count = 0; !waiting.empty() && waiting.top().whole < best; ++count) {
    const Waiting next = waiting.top();
    waiting.pop();
    if (next.behind > behind[next.node]) continue;
    if ((count & 1023) == 1023 && context.stop()) return {};
    if (next.behind + ahead[next.node] < best) {
      best = next.behind + ahead[next.node];
      last = next.node;
    }
    const std::array<int, 3> here = roadmap_.cell(next.node);
    for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
      const std::array<int, 3> there{here[0] + n.offset[0], here[1] + n.offset[1], here[2] + n.offset[2]};
      if (!roadmap_.holds(there)) continue;
      const int other = roadmap_.node(there);
      if (!roadmap_.is_free(other) || excluded_[other]) continue;
      const float cost = next.behind + roadmap_.cost_between(next.node, other, n.steps);
      if (cost < behind[other] && roadmap_.passes(next.node, other)) reach(other, cost, next.node);
    }
  }
  Path path;
  if (last < 0) return path;
  path.cost = best;
  for (int node = last; node >= 0; node = before[node]) path.nodes.push_back(node);
  std::reverse(path.nodes.begin(), path.nodes.end());
  path.places.push_back(start_);
  for (const int node : path.nodes) path.places.push_back(roadmap_.place(node));
  path.places.push_back(finish_);
  return path;
}

}  // namespace tendril::preform
