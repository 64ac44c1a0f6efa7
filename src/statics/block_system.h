// The linear system of one Newton step: symmetric, made of 6x6 blocks, sparse as the rods hang together.
#pragma once

#include <vector>

#include "base/vectors.h"

namespace tendril {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Which nodes are coupled. Edge k has its block in BlockSystem::upper[k]: rows of node a, columns of node b. An edge with
/// a < 0 does not exist (between the last node of a rod and the first of the next one).
struct BlockPattern {
  struct Edge {
    int a = -1, b = -1;
  };
  int nodes = 0;
  std::vector<Edge> edges;

  /// One rod: node i is coupled with node i + 1.
  static BlockPattern chain(int nodes) {
    BlockPattern pattern;
    pattern.nodes = nodes;
    for (int i = 0; i + 1 < nodes; ++i) pattern.edges.push_back({i, i + 1});
    return pattern;
  }
};

/// Unknowns of node i: (position increment in world axes, m; rotation increment theta in the section's own axes, rad),
/// applied as r <- r + dr, R <- R exp([theta]). Arrays: gradient and diagonal by node, upper by edge of the pattern; within
/// one rod upper[i] couples rows of node i with columns of node i + 1.
struct BlockSystem {
  std::vector<Vec6> gradient;
  std::vector<Mat6> diagonal;  ///< both triangles are filled
  std::vector<Mat6> upper;

  void resize(int nodes, int edges) {
    gradient.resize(nodes);
    diagonal.resize(nodes);
    upper.resize(edges);
  }
  /// One rod.
  void resize(int vertices) { resize(vertices, vertices > 0 ? vertices - 1 : 0); }
  int vertices() const { return static_cast<int>(diagonal.size()); }
};

/// The part of a system that belongs to one rod, counted from the rod's first node.
struct BlockView {
  Vec6* gradient;
  Mat6* diagonal;
  Mat6* upper;

  BlockView(BlockSystem& system, int first = 0)  // NOLINT: a whole system is a view of its only rod
      : gradient(system.gradient.data() + first), diagonal(system.diagonal.data() + first), upper(system.upper.data() + first) {}
};

}  // namespace tendril
