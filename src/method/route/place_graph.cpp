#include "method/route/place_graph.h"

#include <algorithm>

namespace tendril::routing {

PlaceGraph::PlaceGraph(const Roadmap& roadmap, const std::vector<int>& from, const RunContext& context)
    : places_(roadmap.nodes(), -1) {
  const auto number = [&](int node) {
    if (places_[node] >= 0) return places_[node];
    places_[node] = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    return places_[node];
  };
  for (const int node : from)
    if (roadmap.is_free(node)) number(node);
  first_.reserve(roadmap.free_nodes() + 1);
  edges_.reserve(Roadmap::neighbours().size() * roadmap.free_nodes());
  float cheapest = Roadmap::unreachable;
  for (int place = 0; place < size(); ++place) {  // grows on the way: breadth first
    if (place % 1024 == 0 && context.stop()) break;
    const int node = nodes_[place];
    const std::array<int, 3> here = roadmap.cell(node);
    for (const Roadmap::Neighbour& n : Roadmap::neighbours()) {
      const std::array<int, 3> there{here[0] + n.offset[0], here[1] + n.offset[1], here[2] + n.offset[2]};
      if (!roadmap.holds(there)) continue;
      const int other = roadmap.node(there);
      if (!roadmap.is_free(other) || !roadmap.passes(node, other)) continue;
      edges_.push_back({number(other), roadmap.cost_between(node, other, n.steps)});
      cheapest = std::min(cheapest, edges_.back().cost);
    }
    first_.push_back(static_cast<long>(edges_.size()));
  }
  if (first_.size() != nodes_.size() + 1) {
    std::fill(places_.begin(), places_.end(), -1);
    nodes_.clear();
    edges_.clear();
    first_ = {0};
  }
  if (!edges_.empty()) cheapest_ = cheapest;
}

std::size_t PlaceGraph::bytes() const {
  return nodes_.size() * sizeof(int) + places_.size() * sizeof(int) + first_.size() * sizeof(long) + edges_.size() * sizeof(Edge);
}

}  // namespace tendril::routing
