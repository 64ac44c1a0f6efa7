#include "method/preform/path_search.h"

#include <algorithm>
#include <cmath>

namespace tendril::preform {

using routing::FreeSpace;
using routing::Roadmap;

namespace {

/// Of paths that cost the same but for so much the search follows the one that is nearest to the finish.
constexpr float even = 1e-5f;
// A search that has expanded so many nodes asks whether the finish has fewer around it, from which nothing leads out.
constexpr std::size_t enclosed_nodes = 4096;

/// Mean of both ends, as between nodes.
double cost_of_straight(const FreeSpace& space, const Vec3& a, const Vec3& b) {
  const double length = (b - a).norm();
  return space.has_preferences() ? 0.5 * (space.cost(a) + space.cost(b)) * length : length;
}

}  // namespace

PathSearch::PathSearch(const FreeSpace& space, const Roadmap& roadmap, const Vec3& start, const Vec3& finish)
    : space_(space), roadmap_(roadmap), start_(start), finish_(finish), starts_(joined(start)), finishes_(joined(finish)),
      to_finish_(roadmap.costs_to(finishes_)), leave_(roadmap.nodes(), Roadmap::unreachable), excluded_(roadmap.nodes(), 0),
      behind_(roadmap.nodes(), Roadmap::unreachable), before_(roadmap.nodes(), -1) {
  for (const Goal& goal : finishes_) leave_[goal.node] = static_cast<float>(goal.cost);
}

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

void PathSearch::reach(int node, float cost, int from) {
  const float whole = cost + (1 + even) * to_finish_[node];
  if (!(whole <= most_)) return;
  if (behind_[node] == Roadmap::unreachable) touched_.push_back(node);
  behind_[node] = cost;
  before_[node] = from;
  waiting_.push_back({whole, cost, node});
  std::push_heap(waiting_.begin(), waiting_.end());
}

void PathSearch::expand(int node) {
  roadmap_.visit_free_neighbours(node, [&](int other, float steps) {
    if (excluded_[other]) return;
    const float cost = behind_[node] + roadmap_.cost_between(node, other, steps);
    if (cost < behind_[other] && roadmap_.passes(node, other)) reach(other, cost, node);
  });
}

/// By what is excluded, in a space of few nodes without a start: to search all the rest for it would be in vain.
bool PathSearch::finish_is_enclosed() const {
  std::vector<int> around;
  std::vector<char> seen(excluded_);
  const auto see = [&](int node) {
    if (!seen[node]) around.push_back(node);
    seen[node] = 1;
  };
  for (const Goal& goal : finishes_) see(goal.node);
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around.size() > enclosed_nodes || behind_[around[i]] < Roadmap::unreachable) return false;
    roadmap_.visit_free_neighbours(around[i], [&](int other, float) {
      if (!seen[other] && roadmap_.passes(other, around[i])) see(other);
    });
  }
  return true;
}

PathSearch::Path PathSearch::path_to(int node, float cost) const {
  Path path;
  path.cost = cost;
  for (; node >= 0; node = before_[node]) path.nodes.push_back(node);
  std::reverse(path.nodes.begin(), path.nodes.end());
  path.places.push_back(start_);
  for (const int n : path.nodes) path.places.push_back(roadmap_.place(n));
  path.places.push_back(finish_);
  return path;
}

PathSearch::Path PathSearch::shortest(double most, const RunContext& context) {
  // What is out of reach has infinite costs.
  most_ = static_cast<float>(std::min((1 + 2 * even) * most, double(std::numeric_limits<float>::max())));
  for (const Goal& goal : starts_)
    if (!excluded_[goal.node] && goal.cost < behind_[goal.node]) reach(goal.node, static_cast<float>(goal.cost), -1);
  float best = Roadmap::unreachable;
  int last = -1;
  std::vector<int> expanded;
  bool stopped = false;
  for (long count = 0; !waiting_.empty() && waiting_.front().whole < best && !stopped; ++count) {
    const Waiting next = waiting_.front();
    std::pop_heap(waiting_.begin(), waiting_.end());
    waiting_.pop_back();
    if (next.behind > behind_[next.node]) continue;
    stopped = (count & 1023) == 1023 && context.stop();
    if (next.behind + leave_[next.node] < best) {
      best = next.behind + leave_[next.node];
      last = next.node;
    }
    expanded.push_back(next.node);
    if (expanded.size() == enclosed_nodes && last < 0 && finish_is_enclosed()) break;
    expand(next.node);
  }
  const Path path = last < 0 || stopped ? Path{} : path_to(last, best);
  if (!path.places.empty())
    for (const int node : expanded) to_finish_[node] = std::max(to_finish_[node], (1 - even) * best - behind_[node]);
  for (const int node : touched_) behind_[node] = Roadmap::unreachable;
  touched_.clear();
  waiting_.clear();
  return path;
}

}  // namespace tendril::preform
