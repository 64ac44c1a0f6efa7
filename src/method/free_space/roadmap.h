// A uniform grid over free space whose nodes have up to 26 neighbours: where both routing methods look for passages.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/run_context.h"
#include "method/free_space/free_space.h"

namespace tendril::routing {

/// Nodes are numbered x fastest. Immutable, safe from several threads.
class Roadmap {
 public:
  /// Nodes `step` (m) apart over space.region(), from its lower corner on. Throws UsageError for more than 30 million. When stopped
  /// by `context` no more nodes become free.
  Roadmap(const FreeSpace& space, double step, const RunContext& context = {});

  double step() const { return step_; }
  const std::array<int, 3>& size() const { return size_; }
  long nodes() const { return static_cast<long>(free_.size()); }
  long free_nodes() const { return free_nodes_; }

  Vec3 place(int node) const;                               ///< m
  std::array<int, 3> cell(int node) const;
  int node(const std::array<int, 3>& cell) const { return cell[0] + size_[0] * (cell[1] + size_[1] * cell[2]); }
  bool holds(const std::array<int, 3>& cell) const;         ///< within the grid
  std::array<int, 3> nearest(const Vec3& p) const;          ///< a cell within the grid
  bool is_free(int node) const { return free_[node]; }
  /// Per metre, by FreeSpace::cost; where the node is not free the most that it can be.
  float cost(int node) const { return costs_.empty() ? 1.0f : costs_[node]; }

  /// A way on from a node: its neighbour and the distance there in steps.
  struct Neighbour {
    std::array<int, 3> offset;
    float steps;
  };
  static const std::array<Neighbour, 26>& neighbours();
  /// Calls visit(node, steps) for every neighbour within the grid that is free.
  template <class Visit>
  void visit_free_neighbours(int node, const Visit& visit) const;
  /// Between two free neighbours. Where the step is at most 1.15 times what is kept clear of, both ends being free is enough: no
  /// surface lies between. Else the straight between them keeps what is demanded.
  bool passes(int from, int to) const;
  /// What the way between two free neighbours costs (m, by FreeSpace::cost), `steps` as in Neighbour.
  float cost_between(int from, int to, float steps) const;

  /// What it costs to get to the goals from each node (m, by FreeSpace::cost), each goal beginning with a cost of its own; infinite
  /// where no way leads.
  struct Goal {
    int node = 0;
    double cost = 0;
  };
  static constexpr float unreachable = std::numeric_limits<float>::infinity();
  std::vector<float> costs_to(const std::vector<Goal>& goals) const;

 private:
  void classify(const RunContext& context);
  void test_edges(const RunContext& context);

  const FreeSpace& space_;
  double step_;
  bool edges_are_free_;
  Vec3 corner_;
  std::array<int, 3> size_ = {1, 1, 1};
  std::array<int, 26> strides_ = {};  ///< from a node to its neighbours
  std::vector<char> free_;
  std::vector<std::uint16_t> open_;  ///< by node a bit for each of the last thirteen neighbours; empty where edges_are_free_
  std::vector<float> costs_;  ///< per metre, by node; empty where nothing is preferred
  long free_nodes_ = 0;
};

template <class Visit>
void Roadmap::visit_free_neighbours(int node, const Visit& visit) const {
  const std::array<int, 3> here = cell(node);
  bool within = true;
  for (int k = 0; k < 3; ++k) within = within && here[k] > 0 && here[k] < size_[k] - 1;
  const auto& all = neighbours();
  for (int n = 0; n < 26; ++n) {
    const std::array<int, 3>& by = all[n].offset;
    if (!within && !holds({here[0] + by[0], here[1] + by[1], here[2] + by[2]})) continue;
    if (free_[node + strides_[n]]) visit(node + strides_[n], all[n].steps);
  }
}

}  // namespace tendril::routing
