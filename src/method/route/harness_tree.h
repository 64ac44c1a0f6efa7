// The best tree between several connections through the free places of a grid: which branches there are and where they part.
//
// Dreyfus and Wagner's dynamic programming over subsets of connections, with one layer of places for each subset, extended by
// edges that cost by what runs through them. An edge behind which the connections S hang, of length l, costs
//
//   l * FreeSpace::cost * (bundling + (1 - bundling) * crossing(S)),    crossing(S): wires with exactly one end in S
//
// bundling = 1: the least length of harness (a Steiner tree); 0: the least length of wires, where all wires begin at one
// connection each of them its shortest way; between: length that is shared is rewarded. Exact on the grid. (crossing is
// submodular: to join two parts earlier never costs more, so that the best is a tree.)
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/free_space/roadmap.h"

namespace tendril::routing {

struct TreeOptions {
  /// Pairs of connections, counted from 0. Empty: from the first connection to every other. Connections that no chain of wires
  /// links stay apart, each group with its own tree: length shared by two groups is not rewarded.
  std::vector<std::array<int, 2>> wires;
  double bundling = 0.5;       ///< 0 ... 1. Of trees that cost the same the one of least length: 0 counts as 1e-4
  double memory = 1e9;         ///< bytes, at most
};

/// Branches are numbered from 0. An end below the number of connections is a connection, above it is connections + junction.
struct TreeBranch {
  int from = 0, to = 0;        ///< from the end nearer to the first connection of its group
  std::vector<int> nodes;      ///< of the roadmap, from end to end; at a connection the first one is one of its goals
  std::vector<int> wires;      ///< numbers of those that run through it, rising
  double length = 0;           ///< m, with the ways from connections to their goals
  double cost = 0;             ///< m, by the formula above
};

struct HarnessTree {
  Status status = Status::infeasible;       ///< solved, infeasible, cancelled, timeout
  std::vector<TreeBranch> branches;
  std::vector<int> junctions;               ///< nodes of the roadmap
  double cost = 0;                          ///< m, of all branches
  double length = 0;                        ///< m, of all branches
  double cable_length = 0;                  ///< m, along the tree, over all wires
  /// Of an infeasible one: a connection and another that it shall be joined with but cannot reach, or twice the same one that has
  /// no free goal.
  std::array<int, 2> apart = {-1, -1};
  long labels = 0;                          ///< places reached, summed over the subsets
};

/// `connections`: for each one the nodes where the grid can be entered, with what the way there costs (m). The same bits for any
/// number of threads. Throws UsageError for other than 2 to 9 connections, wires that name none, join one with itself or leave
/// one without a wire, numbers that make no sense, and more memory than allowed.
HarnessTree best_tree(const Roadmap& roadmap, const std::vector<std::vector<Roadmap::Goal>>& connections,
                      const TreeOptions& options = {}, const RunContext& context = {});

}  // namespace tendril::routing
