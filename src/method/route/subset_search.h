// Dynamic programming over subsets of connections (Dreyfus and Wagner, 1971) on a graph of places, with edges that cost by what
// runs through them.
//
//   cost(S, v) = the least cost of a tree that joins the connections S with the place v
//              = min( cost(A, v) + cost(S \ A, v),  cost(S, u) + edge(u, v) * factor(S) )
//
// One connection, the root, is in no subset: the answer is cost(all others, root). Labels that cannot belong to a tree as good
// as one that is known are dropped: what the connections outside S still need at least is known from their distances (in the
// way of Hougardy, Silvanus and Vygen, "Dijkstra meets Steiner", 2017).
#pragma once

#include <functional>
#include <vector>

#include "method/route/place_graph.h"

namespace tendril::routing {

/// Subsets are sets of bits; bit i stands for the connection i of the group, from 0. The root has the highest bit.
using Subset = unsigned;

/// What a tree costs: the number of wires across a cut, and the weights of harness_tree.h.
struct TreeWeights {
  std::vector<std::array<int, 2>> wires;  ///< by connections of the group
  double bundling = 1;

  int crossing(Subset s) const;
  double factor(Subset s) const { return bundling + (1 - bundling) * crossing(s); }
};

class SubsetSearch {
 public:
  /// A place where a connection enters the graph, and what the way there costs for a factor of 1 (m).
  struct Entry {
    int place;
    double cost;
  };
  SubsetSearch(const PlaceGraph& graph, std::vector<std::vector<Entry>> entries, TreeWeights weights);

  /// Where the best tree comes from at one of its places.
  struct Origin {
    enum class Kind { entry, edge, merge, none };
    Kind kind = Kind::none;
    int place = -1;         ///< edge: the place before
    int entry = -1;         ///< entry: which
    Subset part = 0;        ///< merge: one of the two parts
  };

  /// Fills all layers; false when stopped. Before: every connection must be within reach.
  bool run(const RunContext& context);
  /// m; infinite where two connections are not joined. (By the connections' own distances, before run().)
  double distance(int a, int b) const { return between_[a * count_ + b]; }
  bool measure_distances(const RunContext& context);

  Subset others() const { return (Subset(1) << (count_ - 1)) - 1; }
  double cost() const { return cost_; }        ///< m, of the best tree
  int root_entry() const { return root_entry_; }
  Origin origin(Subset s, int place) const;
  long labels() const { return labels_; }

 private:
  using Layer = std::vector<float>;
  struct Queue;
  bool spread(Layer& layer, double factor, const std::function<bool(int, float)>& keep, Queue& queue, const RunContext& context) const;
  Layer start_of(Subset s) const;
  void merge(Subset s, Layer& layer) const;
  double known_cost() const;
  double least_more(Subset s, int place) const;
  void find_root_entry();
  void prepare_bounds();

  const PlaceGraph& graph_;
  std::vector<std::vector<Entry>> entries_;
  TreeWeights weights_;
  int count_;
  std::vector<Layer> layers_;          ///< by subset
  std::vector<float> distances_;       ///< by place, then connection; m, factor 1
  std::vector<double> between_;        ///< count x count
  struct Rest {                        ///< of what lies outside a subset
    std::vector<int> members;
    std::vector<int> across;           ///< wires from the subset to each member
    double tree = 0;                   ///< m, least spanning tree of the members' distances
    double wires = 0;                  ///< m, at least that length have the wires among the members
  };
  std::vector<Rest> rest_;             ///< by subset
  double bound_ = 0, cost_ = 0;
  int root_entry_ = -1;
  long labels_ = 0;
};

}  // namespace tendril::routing
