#include "statics/elimination.h"

#include <algorithm>
#include <array>

namespace tendril {
namespace {

/// The graph while nodes are taken out of it. Degrees stay small: two along a rod, a few at a branch point.
class ShrinkingGraph {
 public:
  explicit ShrinkingGraph(const BlockPattern& pattern) : neighbours_(pattern.nodes), out_(pattern.nodes, 0) {
    for (const BlockPattern::Edge& edge : pattern.edges)
      if (edge.a >= 0 && edge.a != edge.b) connect(edge.a, edge.b);
    for (int i = 0; i < pattern.nodes; ++i) queue(i);
  }

  /// The node of least degree; of the nodes with one neighbour or none the first one, so that a rod is walked along.
  int next(const std::vector<int>& just_left) {
    for (const int node : just_left)
      if (!out_[node] && neighbours_[node].size() <= 1) return node;
    for (std::size_t degree = 0; degree < waiting_.size(); ++degree) {
      std::vector<int>& list = waiting_[degree];
      std::size_t& at = taken_[degree];
      if (degree >= 2)
        for (const int node : just_left)
          if (!out_[node] && neighbours_[node].size() == degree) return node;
      for (; at < list.size(); ++at)
        if (!out_[list[at]] && neighbours_[list[at]].size() == degree) return list[at];
    }
    return -1;
  }

  /// Takes a node out and couples those it leaves behind. Returns them.
  std::vector<int> take_out(int node) {
    out_[node] = 1;
    std::vector<int> left = std::move(neighbours_[node]);
    for (const int other : left) std::erase(neighbours_[other], node);
    for (std::size_t i = 0; i < left.size(); ++i)
      for (std::size_t j = i + 1; j < left.size(); ++j) connect(left[i], left[j]);
    for (const int other : left) queue(other);
    return left;
  }

 private:
  void connect(int a, int b) {
    if (std::find(neighbours_[a].begin(), neighbours_[a].end(), b) != neighbours_[a].end()) return;
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }

  void queue(int node) {
    const std::size_t degree = neighbours_[node].size();
    if (degree >= waiting_.size()) {
      waiting_.resize(degree + 1);
      taken_.resize(degree + 1, 0);
    }
    waiting_[degree].push_back(node);
  }

  std::vector<std::vector<int>> neighbours_;
  std::vector<char> out_;
  std::vector<std::vector<int>> waiting_;  ///< by degree; entries may be out of date
  std::vector<std::size_t> taken_;
};

/// Rods without branch points: every node is coupled with the next one, or with none.
bool is_chain(const BlockPattern& pattern) {
  if (static_cast<int>(pattern.edges.size()) != pattern.nodes) return false;
  for (int e = 0; e < pattern.nodes; ++e) {
    const BlockPattern::Edge& edge = pattern.edges[e];
    if (edge.a >= 0 && (edge.a != e || edge.b != e + 1)) return false;
  }
  return true;
}

}  // namespace

/// What the general way comes to, without its lists: a coarse rod is solved in the time that those take.
void Elimination::eliminate_chain(const BlockPattern& pattern) {
  columns_.reserve(pattern.nodes);
  links_.reserve(pattern.nodes);
  sources_.reserve(pattern.nodes);
  bool coupled = false;  // with the node before
  for (int p = 0; p < pattern.nodes; ++p) {
    Column column{p, static_cast<int>(links_.size()), 0, false, coupled};
    coupled = pattern.edges[p].a >= 0;
    if (coupled) {
      links_.push_back({p + 1, static_cast<int>(sources_.size()), static_cast<int>(sources_.size()) + 1, false});
      sources_.push_back({p, false});
    }
    column.links_end = static_cast<int>(links_.size());
    columns_.push_back(column);
  }
}

Elimination::Elimination(const BlockPattern& pattern) {
  if (is_chain(pattern)) {
    eliminate_chain(pattern);
    return;
  }
  const int n = pattern.nodes;
  ShrinkingGraph graph(pattern);
  std::vector<int> order, position(n);
  std::vector<std::vector<int>> later(n);  // by position: nodes
  order.reserve(n);
  std::vector<int> left;
  for (int p = 0; p < n; ++p) {
    const int node = graph.next(left);
    position[node] = p;
    order.push_back(node);
    later[p] = left = graph.take_out(node);
  }
  std::vector<std::vector<Source>> sources(n);  // by the position that is eliminated first
  for (int e = 0; e < static_cast<int>(pattern.edges.size()); ++e) {
    const BlockPattern::Edge& edge = pattern.edges[e];
    if (edge.a < 0) continue;
    const bool transposed = position[edge.b] < position[edge.a];
    sources[position[transposed ? edge.b : edge.a]].push_back({e, transposed});
  }
  std::vector<int> contributions(n, 0);
  for (int p = 0; p < n; ++p) {
    std::vector<int>& targets = later[p];
    for (int& node : targets) node = position[node];
    std::sort(targets.begin(), targets.end());
    Column column{order[p], static_cast<int>(links_.size()), 0, false, false};
    for (const int target : targets) {
      ++contributions[target];
      Link link{target, static_cast<int>(sources_.size()), 0, false};
      for (const Source& source : sources[p]) {
        const BlockPattern::Edge& edge = pattern.edges[source.edge];
        if (position[source.transposed ? edge.a : edge.b] == target) sources_.push_back(source);
      }
      link.sources_end = static_cast<int>(sources_.size());
      links_.push_back(link);
    }
    column.links_end = static_cast<int>(links_.size());
    columns_.push_back(column);
  }
  for (int p = 0; p < n; ++p) {
    const Column& before = columns_[std::max(0, p - 1)];
    const bool only_link = p > 0 && before.links_end - before.links_begin == 1 && links_[before.links_begin].target == p;
    columns_[p].carried = only_link && contributions[p] == 1;
    columns_[p].filled = contributions[p] > 0 && !columns_[p].carried;
    for (int a = columns_[p].links_begin; a < columns_[p].links_end; ++a)
      for (int b = a + 1; b < columns_[p].links_end; ++b)
        links_[link_between(links_[a].target, links_[b].target)].filled = true;
  }
}

int Elimination::link_between(int from, int to) const {
  const Column& column = columns_[from];
  const auto begin = links_.begin() + column.links_begin, end = links_.begin() + column.links_end;
  const auto found = std::lower_bound(begin, end, to, [](const Link& link, int target) { return link.target < target; });
  return static_cast<int>(found - links_.begin());
}

}  // namespace tendril
