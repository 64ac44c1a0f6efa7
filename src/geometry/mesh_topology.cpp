#include "geometry/mesh_topology.h"

#include <algorithm>

namespace tendril {

namespace {

// Items in buckets by their lowest vertex: a counting sort, so that only small buckets are left to sort.
template <class Item>
struct Buckets {
  std::vector<int> start;  ///< vertices + 1
  std::vector<Item> items;

  /// emit(sink) calls sink(vertex, item) for every item, the same ones both times it is called.
  template <class Emit>
  Buckets(int vertices, const Emit& emit) : start(vertices + 1, 0) {
    emit([&](int vertex, const Item&) { ++start[vertex + 1]; });
    for (int v = 0; v < vertices; ++v) start[v + 1] += start[v];
    items.resize(start[vertices]);
    std::vector<int> next(start.begin(), start.end() - 1);
    emit([&](int vertex, const Item& item) { items[next[vertex]++] = item; });
    for (int v = 0; v < vertices; ++v) std::sort(items.begin() + start[v], items.begin() + start[v + 1]);
  }
};

struct Corners {
  int middle, last, triangle;
  bool operator<(const Corners& o) const {
    if (middle != o.middle) return middle < o.middle;
    if (last != o.last) return last < o.last;
    return triangle < o.triangle;
  }
};

struct HalfEdge {
  int last, triangle, side;
  bool operator<(const HalfEdge& o) const {
    if (last != o.last) return last < o.last;
    return triangle < o.triangle;
  }
};

using Triangles = std::vector<std::array<int, 3>>;

Buckets<HalfEdge> half_edges(const Triangles& triangles, const std::vector<TriangleKind>& kinds, int vertices) {
  return {vertices, [&](const auto& sink) {
            for (std::size_t t = 0; t < triangles.size(); ++t) {
              if (kinds[t] != TriangleKind::regular) continue;
              for (int k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
                sink(low, HalfEdge{high, static_cast<int>(t), k});
              }
            }
          }};
}

// Gives each edge's weight to its first triangle and returns the sum of (n_e - 1) over the edges at each vertex.
std::vector<int> weigh_edges(const Buckets<HalfEdge>& edges, int vertices, MeshTopology& topology) {
  std::vector<int> excess(vertices, 0);
  for (int v = 0; v < vertices; ++v) {
    for (int i = edges.start[v]; i < edges.start[v + 1];) {
      int j = i;
      while (j < edges.start[v + 1] && edges.items[j].last == edges.items[i].last) ++j;
      const int more = j - i - 1;
      topology.boundary_edges += more == 0;
      topology.non_manifold_edges += more > 1;
      topology.weights[edges.items[i].triangle].edge[edges.items[i].side] = static_cast<float>(-more);
      excess[v] += more;
      excess[edges.items[i].last] += more;
      i = j;
    }
  }
  return excess;
}

void weigh_vertices(const Triangles& triangles, const std::vector<int>& excess, MeshTopology& topology) {
  std::vector<int> faces(excess.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (topology.weights[t].face != 0)
      for (int v : triangles[t]) ++faces[v];
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (topology.weights[t].face == 0) continue;
    for (int k = 0; k < 3; ++k) {
      int& count = faces[triangles[t][k]];
      if (count == 0) continue;  // given to an earlier triangle
      topology.weights[t].vertex[k] = static_cast<float>(1 - count + excess[triangles[t][k]]);
      count = 0;
    }
  }
}

}  // namespace

std::vector<TriangleKind> classify(const Triangles& triangles, int vertices) {
  std::vector<TriangleKind> kinds(triangles.size(), TriangleKind::regular);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) kinds[t] = TriangleKind::degenerate;
  }
  const Buckets<Corners> buckets(vertices, [&](const auto& sink) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (kinds[t] != TriangleKind::regular) continue;
      std::array<int, 3> corner = triangles[t];
      std::sort(corner.begin(), corner.end());
      sink(corner[0], Corners{corner[1], corner[2], static_cast<int>(t)});
    }
  });
  for (int v = 0; v < vertices; ++v)
    for (int i = buckets.start[v] + 1; i < buckets.start[v + 1]; ++i)
      if (buckets.items[i].middle == buckets.items[i - 1].middle && buckets.items[i].last == buckets.items[i - 1].last)
        kinds[buckets.items[i].triangle] = TriangleKind::repeated;
  return kinds;
}

MeshTopology topology_of(const Mesh& mesh, double tolerance) {
  const int vertices = static_cast<int>(mesh.vertices.size());
  const std::vector<int> map = weld_map(mesh.vertices, tolerance);
  Triangles triangles(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) triangles[t][k] = map[mesh.triangles[t][k]];

  MeshTopology topology;
  topology.weights.resize(triangles.size());
  const std::vector<TriangleKind> kinds = classify(triangles, vertices);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    topology.degenerate_triangles += kinds[t] == TriangleKind::degenerate;
    topology.repeated_triangles += kinds[t] == TriangleKind::repeated;
    if (kinds[t] == TriangleKind::regular) topology.weights[t].face = 1;
  }
  const std::vector<int> excess = weigh_edges(half_edges(triangles, kinds, vertices), vertices, topology);
  weigh_vertices(triangles, excess, topology);
  return topology;
}

}  // namespace tendril
