#include "method/route/harness_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/number_text.h"
#include "method/route/subset_search.h"

namespace tendril::routing {

namespace {

constexpr int most_connections = 9;
// Below this weight of the harness's length trees of the same cable length would not be told apart.
constexpr double least_bundling = 1e-4;

void require(bool holds, const std::string& what) {
  if (!holds) throw UsageError("harness: " + what);
}

std::vector<std::array<int, 2>> checked_wires(int count, const TreeOptions& options) {
  require(count >= 2 && count <= most_connections,
          std::to_string(count) + " connections, 2 to 9 expected" +
              (count > most_connections ? "; route parts of it one after the other, each an obstacle for the next" : ""));
  require(options.bundling >= 0 && options.bundling <= 1, "'bundling' is " + number_text(options.bundling) + ", 0 to 1 expected");
  std::vector<std::array<int, 2>> wires = options.wires;
  if (wires.empty())
    for (int t = 1; t < count; ++t) wires.push_back({0, t});
  std::vector<bool> wired(count, false);
  for (std::size_t w = 0; w < wires.size(); ++w) {
    for (const int end : wires[w]) {
      require(end >= 0 && end < count, "wire " + std::to_string(w + 1) + " ends at connection " + std::to_string(end + 1) +
                                           ", 1 to " + std::to_string(count) + " expected");
      wired[end] = true;
    }
    require(wires[w][0] != wires[w][1], "wire " + std::to_string(w + 1) + " begins and ends at connection " + std::to_string(wires[w][0] + 1));
  }
  for (int t = 0; t < count; ++t) require(wired[t], "no wire ends at connection " + std::to_string(t + 1));
  return wires;
}

/// Connections that wires link, by rising number; each group's first connection is the root of its tree.
std::vector<std::vector<int>> linked(int count, const std::vector<std::array<int, 2>>& wires) {
  std::vector<int> group(count);
  std::iota(group.begin(), group.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : wires) {
      const int least = std::min(group[a], group[b]);
      changed = changed || group[a] != group[b];
      group[a] = group[b] = least;
    }
  }
  std::vector<std::vector<int>> groups;
  for (int root = 0; root < count; ++root) {
    std::vector<int> members;
    for (int t = 0; t < count; ++t)
      if (group[t] == root) members.push_back(t);
    if (!members.empty()) groups.push_back(std::move(members));
  }
  return groups;
}

/// One group's search, and the branches that come out of it.
class GroupTree {
 public:
  /// `members`: numbers of the connections; within the group the first one comes last, as the root.
  GroupTree(const Roadmap& roadmap, const std::vector<std::vector<Roadmap::Goal>>& goals, const std::vector<std::array<int, 2>>& wires,
            const TreeOptions& options, const std::vector<int>& members, int connections, HarnessTree& tree)
      : roadmap_(roadmap), goals_(goals), wires_(wires), options_(options), members_(members), connections_(connections), tree_(tree) {
    std::rotate(members_.begin(), members_.begin() + 1, members_.end());
  }

  Status solve(const RunContext& context) {
    const std::vector<Roadmap::Goal>& roots = goals_[members_.back()];
    std::vector<int> from;
    for (const Roadmap::Goal& goal : roots) from.push_back(goal.node);
    const PlaceGraph graph(roadmap_, from, context);
    if (const auto stop = context.stop()) return *stop;
    std::vector<std::vector<SubsetSearch::Entry>> entries;
    for (const int member : members_) {
      entries.emplace_back();
      for (const Roadmap::Goal& goal : goals_[member])
        if (graph.place(goal.node) >= 0) entries.back().push_back({graph.place(goal.node), goal.cost});
    }
    if (!joined(entries)) return Status::infeasible;
    check_memory(graph);
    weights_ = weights();
    SubsetSearch search(graph, entries, weights_);
    if (!search.measure_distances(context)) return *context.stop();
    if (!search.run(context)) return context.stop().value_or(Status::stalled);
    tree_.cost += search.cost();
    tree_.labels += search.labels();
    graph_ = &graph;
    search_ = &search;
    entries_ = &entries;
    const SubsetSearch::Entry& root = entries.back()[search.root_entry()];
    grow(search.others(), root.place, members_.back(), root.cost);
    return Status::solved;
  }

 private:
  bool joined(const std::vector<std::vector<SubsetSearch::Entry>>& entries) {
    const auto any_free = [this](int member) {
      const auto& goals = goals_[member];
      return std::any_of(goals.begin(), goals.end(), [this](const Roadmap::Goal& g) { return roadmap_.is_free(g.node); });
    };
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (!any_free(members_[i])) tree_.apart = {members_[i], members_[i]};
    for (std::size_t i = 0; i + 1 < members_.size() && tree_.apart[0] < 0; ++i)
      if (entries[i].empty()) tree_.apart = {members_.back(), members_[i]};
    return tree_.apart[0] < 0;
  }
  void check_memory(const PlaceGraph& graph) const {
    const double layers = std::pow(2.0, static_cast<double>(members_.size()) - 1) + static_cast<double>(members_.size());
    const double bytes = static_cast<double>(graph.bytes()) + layers * graph.size() * sizeof(float);
    require(bytes <= options_.memory, std::to_string(members_.size()) + " connections over " + std::to_string(graph.size()) +
                                          " free places need " + number_text(std::ceil(bytes / 1e6)) + " MB, at most " +
                                          number_text(options_.memory / 1e6) + " MB allowed; take a larger 'grid' or a box to 'keep_in'");
  }
  TreeWeights weights() const {
    TreeWeights weights;
    const auto place_of = [this](int c) { return static_cast<int>(std::find(members_.begin(), members_.end(), c) - members_.begin()); };
    for (const auto& [a, b] : wires_)
      if (place_of(a) < static_cast<int>(members_.size())) weights.wires.push_back({place_of(a), place_of(b)});
    weights.bundling = std::max(options_.bundling, least_bundling);
    return weights;
  }

  std::vector<int> wires_across(Subset s) const {
    std::vector<bool> inside(connections_, false);
    for (std::size_t i = 0; i < members_.size(); ++i) inside[members_[i]] = (s >> i) & 1;
    std::vector<int> across;
    for (std::size_t w = 0; w < wires_.size(); ++w)
      if (inside[wires_[w][0]] != inside[wires_[w][1]]) across.push_back(static_cast<int>(w));
    return across;
  }

  /// The branch below an end, and then what hangs behind it. `way`: m, of cost that the branch has before its first node.
  void grow(Subset s, int place, int end, double way) {
    TreeBranch branch;
    branch.from = end;
    branch.nodes.push_back(graph_->node(place));
    branch.wires = wires_across(s);
    branch.length = way;
    SubsetSearch::Origin origin = search_->origin(s, place);
    double cost = way;
    while (origin.kind == SubsetSearch::Origin::Kind::edge) {
      const Vec3 here = roadmap_.place(branch.nodes.back()), next = roadmap_.place(graph_->node(origin.place));
      for (const PlaceGraph::Edge* e = graph_->begin(origin.place); e != graph_->end(origin.place); ++e)
        if (e->to == place) cost += e->cost;
      branch.length += (next - here).norm();
      place = origin.place;
      branch.nodes.push_back(graph_->node(place));
      origin = search_->origin(s, place);
    }
    std::vector<Subset> behind;
    if (origin.kind == SubsetSearch::Origin::Kind::merge) {
      branch.to = connections_ + static_cast<int>(tree_.junctions.size());
      tree_.junctions.push_back(branch.nodes.back());
      split(s, place, behind);
    } else {
      const int member = static_cast<int>(std::countr_zero(s));
      const double last = (*entries_)[member][std::max(0, origin.entry)].cost;
      branch.to = members_[member];
      branch.length += last;
      cost += last;
    }
    branch.cost = weights_.factor(s) * cost;
    const int to = branch.to;
    tree_.length += branch.length;
    tree_.cable_length += branch.length * static_cast<double>(branch.wires.size());
    tree_.branches.push_back(std::move(branch));
    for (const Subset part : behind) grow(part, place, to, 0);
  }
  /// All branches that leave one place: parts that part again there belong to the same junction.
  void split(Subset s, int place, std::vector<Subset>& parts) const {
    const SubsetSearch::Origin origin = search_->origin(s, place);
    if (origin.kind != SubsetSearch::Origin::Kind::merge) return parts.push_back(s);
    split(origin.part, place, parts);
    split(s & ~origin.part, place, parts);
  }

  const Roadmap& roadmap_;
  const std::vector<std::vector<Roadmap::Goal>>& goals_;
  const std::vector<std::array<int, 2>>& wires_;
  const TreeOptions& options_;
  std::vector<int> members_;
  int connections_;
  HarnessTree& tree_;
  TreeWeights weights_;
  const PlaceGraph* graph_ = nullptr;
  const SubsetSearch* search_ = nullptr;
  const std::vector<std::vector<SubsetSearch::Entry>>* entries_ = nullptr;
};

}  // namespace

HarnessTree best_tree(const Roadmap& roadmap, const std::vector<std::vector<Roadmap::Goal>>& connections, const TreeOptions& options,
                      const RunContext& context) {
  const int count = static_cast<int>(connections.size());
  const std::vector<std::array<int, 2>> wires = checked_wires(count, options);
  for (const std::vector<Roadmap::Goal>& goals : connections)
    for (const Roadmap::Goal& goal : goals) {
      require(goal.node >= 0 && goal.node < roadmap.nodes(), "a connection enters the grid at a node that it does not have");
      require(std::isfinite(goal.cost) && goal.cost >= 0, "the way of a connection to the grid costs " + number_text(goal.cost) +
                                                              " m; a finite length of at least 0 expected");
    }
  HarnessTree tree;
  tree.status = Status::solved;
  for (const std::vector<int>& members : linked(count, wires)) {
    tree.status = GroupTree(roadmap, connections, wires, options, members, count, tree).solve(context);
    if (tree.status != Status::solved) break;
  }
  return tree;
}

}  // namespace tendril::routing
