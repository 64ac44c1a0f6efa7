// The free places of a roadmap that can be reached from some of them, numbered without gaps, with their edges in one list.
#pragma once

#include <vector>

#include "base/run_context.h"
#include "method/free_space/roadmap.h"

namespace tendril::routing {

class PlaceGraph {
 public:
  struct Edge {
    int to;
    float cost;    ///< m, by FreeSpace::cost
  };

  /// What can be reached from `from` (nodes of the roadmap; those that are not free are left out). Empty when stopped.
  PlaceGraph(const Roadmap& roadmap, const std::vector<int>& from, const RunContext& context = {});

  int size() const { return static_cast<int>(nodes_.size()); }
  int node(int place) const { return nodes_[place]; }
  int place(int node) const { return places_[node]; }  ///< -1: not reached
  const Edge* begin(int place) const { return edges_.data() + first_[place]; }
  const Edge* end(int place) const { return edges_.data() + first_[place + 1]; }
  float cheapest() const { return cheapest_; }         ///< m, of all edges; 1 without any
  std::size_t bytes() const;

 private:
  std::vector<int> nodes_, places_;
  std::vector<long> first_{0};
  std::vector<Edge> edges_;
  float cheapest_ = 1;
};

}  // namespace tendril::routing
