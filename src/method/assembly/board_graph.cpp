#include "method/assembly/board_graph.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

struct Place {
  double at;
  int node;
};

/// Joined places and ends of each rod, by arc length; ends that no junction joins become nodes.
std::vector<std::vector<Place>> places_of(const SystemProblem& problem, BoardGraph& graph) {
  std::vector<std::vector<Place>> places(problem.rods.size());
  for (int b = 0; b < static_cast<int>(problem.branches.size()); ++b) {
    graph.nodes.push_back({b, -1, 0, {}});
    for (const JoinedSection& section : problem.branches[b].sections) places[section.rod].push_back({section.at, b});
  }
  for (int k = 0; k < static_cast<int>(problem.rods.size()); ++k) {
    const double length = problem.rods[k].rod.length;
    for (const double end : {0.0, length}) {
      const bool joined = std::any_of(places[k].begin(), places[k].end(), [&](const Place& p) { return std::abs(p.at - end) <= 1e-9 * length; });
      if (joined) continue;
      places[k].push_back({end, static_cast<int>(graph.nodes.size())});
      graph.nodes.push_back({-1, k, end, {}});
    }
    std::sort(places[k].begin(), places[k].end(), [](const Place& a, const Place& b) { return a.at < b.at; });
  }
  return places;
}

}  // namespace

BoardGraph board_graph(const SystemProblem& problem) {
  BoardGraph graph;
  const std::vector<std::vector<Place>> places = places_of(problem, graph);
  const std::size_t count = graph.nodes.size();
  graph.ways.assign(count, std::vector<double>(count, INFINITY));
  for (std::size_t i = 0; i < count; ++i) graph.ways[i][i] = 0;
  for (int k = 0; k < static_cast<int>(places.size()); ++k)
    for (std::size_t i = 0; i + 1 < places[k].size(); ++i) {
      const Place &a = places[k][i], &b = places[k][i + 1];
      const int piece = static_cast<int>(graph.pieces.size());
      graph.pieces.push_back({k, a.at, b.at, a.node, b.node});
      graph.nodes[a.node].pieces.push_back(piece);
      graph.nodes[b.node].pieces.push_back(piece);
      const double way = std::min(graph.ways[a.node][b.node], b.at - a.at);
      graph.ways[a.node][b.node] = graph.ways[b.node][a.node] = way;
    }
  for (std::size_t via = 0; via < count; ++via)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) graph.ways[i][j] = std::min(graph.ways[i][j], graph.ways[i][via] + graph.ways[via][j]);
  return graph;
}

int BoardGraph::middle() const {
  int best = 0;
  double shortest = INFINITY;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double longest = *std::max_element(ways[i].begin(), ways[i].end());
    if (longest < shortest * (1 - 1e-9)) {
      shortest = longest;
      best = static_cast<int>(i);
    }
  }
  return best;
}

double BoardGraph::way(int piece_a, double at_a, int piece_b, double at_b) const {
  const BoardPiece &a = pieces[piece_a], &b = pieces[piece_b];
  const double to_from = at_a - a.begin, to_to = a.end - at_a, from_b = at_b - b.begin, back_b = b.end - at_b;
  const double around = std::min({to_from + ways[a.from][b.from] + from_b, to_from + ways[a.from][b.to] + back_b,
                                  to_to + ways[a.to][b.from] + from_b, to_to + ways[a.to][b.to] + back_b});
  return piece_a == piece_b ? std::min(around, std::abs(at_a - at_b)) : around;
}

Vec3 place_of(const BoardNode& node, const SystemEquilibrium& state) {
  if (node.branch >= 0) return state.branches[node.branch].at;
  const Equilibrium& rod = state.rods[node.rod];
  return node.at <= 0 ? rod.points.front() : rod.points.back();
}

}  // namespace tendril::assembly
