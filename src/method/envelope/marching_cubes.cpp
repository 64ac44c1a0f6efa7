#include "method/envelope/marching_cubes.h"

#include <algorithm>
#include <atomic>

#include "base/huge_pages.h"
#include "base/parallel.h"
#include "method/envelope/cube_table.h"

namespace tendril::envelope {
namespace {

constexpr std::uint64_t column_0 = 0x0101010101010101ull, row_0 = 0xffull;

/// The cells of a layer that have corners on both sides, by their lowest corner.
std::uint64_t mixed_cells(const NodeBits& inside, int layer) {
  const auto any = [](std::uint64_t n) { return n | n >> 1 | n >> 8 | n >> 9; };
  const auto every = [](std::uint64_t n) { return n & n >> 1 & n >> 8 & n >> 9; };
  return (any(inside[layer]) | any(inside[layer + 1])) & ~(every(inside[layer]) & every(inside[layer + 1])) & owned_nodes;
}

int case_at(const NodeBits& inside, int layer, int cell) {
  const std::uint64_t low = inside[layer] >> cell, high = inside[layer + 1] >> cell;
  return static_cast<int>((low & 3) | (low >> 6 & 12) | (high & 3) << 4 | (high >> 2 & 0xc0));
}

/// The old contents are of no use; memory that is large enough is.
template <class T>
void resize_fresh(std::vector<T>& list, std::size_t size) {
  if (list.capacity() < size) {
    list = {};
    list.reserve(size);
    prefer_huge_pages(list.data(), size * sizeof(T));
  }
  list.resize(size);
}

template <class Work>
void in_chunks(int count, int chunk, const RunContext& context, const Work& work) {
  const int chunks = (count + chunk - 1) / chunk;
  std::atomic<int> next = 0;
  run_workers(std::max(1, std::min(thread_count(context.threads), chunks)), [&](int) {
    for (int c; (c = next++) < chunks && !context.stop();) work(c * chunk, std::min(count, (c + 1) * chunk));
  });
}

}  // namespace

void MarchingCubes::count_block(const FieldBlock& block, Numbers& numbers) {
  int vertices = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int layer = 0; layer < 7; ++layer) {
      numbers.before[axis][layer] = static_cast<std::uint16_t>(vertices);
      vertices += __builtin_popcountll(crossed_edges(block.solid, axis, layer));
    }
  numbers.vertices = static_cast<std::uint16_t>(vertices);
  const auto& table = cube_table();
  int triangles = 0;
  for (int layer = 0; layer < 7; ++layer)
    for (std::uint64_t cells = mixed_cells(block.solid, layer); cells; cells &= cells - 1)
      triangles += table[case_at(block.solid, layer, __builtin_ctzll(cells))].triangles;
  numbers.triangles = static_cast<std::uint32_t>(triangles);
}

void MarchingCubes::count(const Field& field, const RunContext& context) {
  numbers_.resize(field.size());
  in_chunks(field.size(), 64, context, [&](int first, int last) {
    for (int b = first; b < last; ++b) count_block(field[b], numbers_[b]);
  });
  vertices_ = triangles_ = 0;
  for (Numbers& numbers : numbers_) {
    numbers.first_vertex = static_cast<int>(vertices_);
    numbers.first_triangle = static_cast<int>(triangles_);
    vertices_ += numbers.vertices;
    triangles_ += numbers.triangles;
  }
}

/// Writes block after block.
class MarchingCubes::Writer {
 public:
  Writer(const MarchingCubes& cubes, const BlockMap& map, const Field& field, const Vec3& origin, Mesh& mesh)
      : cubes_(cubes), map_(map), field_(field), origin_(origin), mesh_(mesh) {
    for (int edge = 0; edge < 12; ++edge) {
      const int corner = edge_corner(edge);
      offset_[edge] = 512 * (edge / 4) + (corner & 1) + 8 * (corner >> 1 & 1) + 64 * (corner >> 2);
    }
  }

  void write(int block) {
    if (cubes_.numbers_[block].vertices > 0) write_vertices(block);
    if (cubes_.numbers_[block].triangles == 0) return;
    take_own(block);
    for (int side = 1; side < 7; ++side) take_from(block, side & 1, side >> 1 & 1, side >> 2);
    write_triangles(block);
  }

 private:
  // Crossings on the way into a filled cavity are left out.
  void write_vertices(int block) {
    const FieldBlock& b = field_[block];
    const double voxel = map_.grid().voxel;
    int at[3];
    map_.grid().place(map_.number(block), at);
    const float* crossing = field_.crossings(block);
    Vec3* out = &mesh_.vertices[cubes_.numbers_[block].first_vertex];
    for (int axis = 0; axis < 3; ++axis)
      for (int layer = 0; layer < 7; ++layer) {
        const std::uint64_t kept = crossed_edges(b.solid, axis, layer);
        for (std::uint64_t edges = crossed_edges(b.inside, axis, layer); edges; edges &= edges - 1, ++crossing) {
          const int node = __builtin_ctzll(edges);
          if (!(kept >> node & 1)) continue;
          const int corner[3] = {node % 8, node / 8, layer};
          Vec3 place;
          for (int k = 0; k < 3; ++k) place[k] = BlockGrid::cells * (map_.grid().low[k] + at[k]) + corner[k];
          place[axis] += *crossing;
          *out++ = origin_ + voxel * place;
        }
      }
  }

  void take_own(int block) {
    int vertex = cubes_.numbers_[block].first_vertex;
    for (int axis = 0; axis < 3; ++axis)
      for (int layer = 0; layer < 7; ++layer)
        for (std::uint64_t edges = crossed_edges(field_[block].solid, axis, layer); edges; edges &= edges - 1)
          vertex_[512 * axis + 64 * layer + __builtin_ctzll(edges)] = vertex++;
  }

  // The edges on the block's high sides belong to its neighbours there.
  void take_from(int block, int dx, int dy, int dz) {
    const BlockGrid& grid = map_.grid();
    int at[3];
    grid.place(map_.number(block), at);
    const std::size_t beside = grid.number(at[0] + dx, at[1] + dy, at[2] + dz);
    const int other = map_.at(beside);
    if (other < 0) return;
    const int moved[3] = {dx, dy, dz};
    const std::uint64_t side = (dx ? column_0 : ~0ull) & (dy ? row_0 : ~0ull);
    for (int axis = 0; axis < 3; ++axis) {
      if (moved[axis]) continue;
      for (int layer = 0; layer < (dz ? 1 : 7); ++layer) {
        const std::uint64_t all = crossed_edges(field_[other].solid, axis, layer);
        const int first = cubes_.numbers_[other].first_vertex + cubes_.numbers_[other].before[axis][layer];
        for (std::uint64_t edges = all & side; edges; edges &= edges - 1) {
          const int node = __builtin_ctzll(edges);
          vertex_[512 * axis + 64 * (dz ? 7 : layer) + node + (dx ? 7 : 0) + (dy ? 56 : 0)] =
              first + __builtin_popcountll(all & ((1ull << node) - 1));
        }
      }
    }
  }

  void write_triangles(int block) {
    const auto& table = cube_table();
    std::array<int, 3>* out = &mesh_.triangles[cubes_.numbers_[block].first_triangle];
    for (int layer = 0; layer < 7; ++layer)
      for (std::uint64_t cells = mixed_cells(field_[block].solid, layer); cells; cells &= cells - 1) {
        const int cell = __builtin_ctzll(cells);
        const CubeCase& found = table[case_at(field_[block].solid, layer, cell)];
        const int* const from = vertex_ + 64 * layer + cell;
        for (int i = 0; i < found.triangles; ++i, ++out)
          for (int k = 0; k < 3; ++k) (*out)[k] = from[offset_[found.edges[3 * i + k]]];
      }
  }

  const MarchingCubes& cubes_;
  const BlockMap& map_;
  const Field& field_;
  const Vec3 origin_;
  Mesh& mesh_;
  int offset_[12];
  int vertex_[3 * 512];  ///< of each edge by axis and lower node, where it is crossed
};

std::optional<Status> MarchingCubes::write(const BlockMap& map, const Field& field, const Vec3& origin, Mesh& mesh,
                                           const RunContext& context) const {
  resize_fresh(mesh.vertices, vertices_);
  resize_fresh(mesh.triangles, triangles_);
  in_chunks(field.size(), 32, context, [&](int first, int last) {
    Writer writer(*this, map, field, origin, mesh);
    for (int b = first; b < last; ++b) writer.write(b);
  });
  return context.stop();
}

double volume_of(const Mesh& mesh, const RunContext& context) {
  constexpr int chunk = 8192;
  const int triangles = static_cast<int>(mesh.triangles.size());
  if (triangles == 0) return 0;
  const Vec3 origin = mesh.vertices[mesh.triangles[0][0]];
  std::vector<double> parts((triangles + chunk - 1) / chunk, 0.0);
  in_chunks(triangles, chunk, context, [&](int first, int last) {
    double sum = 0;
    for (int t = first; t < last; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      sum += (mesh.vertices[a] - origin).cross(mesh.vertices[b] - origin).dot(mesh.vertices[c] - origin);
    }
    parts[first / chunk] = sum / 6;
  });
  double volume = 0;
  for (const double part : parts) volume += part;
  return volume;
}

}  // namespace tendril::envelope
