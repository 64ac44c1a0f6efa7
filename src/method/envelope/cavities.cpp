#include "method/envelope/cavities.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tendril::envelope {
namespace {

constexpr std::uint64_t column_0 = 0x0101010101010101ull, column_7 = column_0 << 7, row_0 = 0xffull, row_7 = row_0 << 56;

/// Outside nodes of one block that are connected within it.
struct Region {
  NodeBits nodes;
};

/// Empty blocks side by side along x.
struct Run {
  int first, last;  ///< the last one included
};

class Sets {
 public:
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  int size() const { return static_cast<int>(parent_.size()); }

 private:
  std::vector<int> parent_;
};

/// Takes the nodes connected to the lowest one out of `left`.
Region take_region(NodeBits& left) {
  Region region{};
  int layer = 0;
  while (!left[layer]) ++layer;
  region.nodes[layer] = left[layer] & -left[layer];
  for (bool grown = true; grown;) {
    grown = false;
    for (int z = 0; z < 8; ++z) {
      const std::uint64_t n = region.nodes[z];
      std::uint64_t next = n | (n & ~column_7) << 1 | (n & ~column_0) >> 1 | n << 8 | n >> 8;
      if (z > 0) next |= region.nodes[z - 1];
      if (z < 7) next |= region.nodes[z + 1];
      next &= left[z];
      grown |= next != n;
      region.nodes[z] = next;
    }
  }
  for (int z = 0; z < 8; ++z) left[z] &= ~region.nodes[z];
  return region;
}

/// The nodes on a block's high side along an axis, moved to where the next block has them on its low side.
bool share_nodes(const Region& low, const Region& high, int axis) {
  if (axis == 2) return low.nodes[7] & high.nodes[0];
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t moved = axis == 0 ? (low.nodes[z] & column_7) >> 7 : (low.nodes[z] & row_7) >> 56;
    if (moved & high.nodes[z]) return true;
  }
  return false;
}

bool touches_side(const Region& region, int axis, bool high) {
  if (axis == 2) return region.nodes[high ? 7 : 0];
  const std::uint64_t side = axis == 0 ? (high ? column_7 : column_0) : (high ? row_7 : row_0);
  for (const std::uint64_t word : region.nodes)
    if (word & side) return true;
  return false;
}

class Outside {
 public:
  Outside(const BlockMap& map, const Field& field) : map_(map), grid_(map.grid()) {
    find_runs();
    find_regions(field);
    join_runs();
    for (int b = 0; b < map_.blocks(); ++b) join_block(b);
  }

  /// Regions that are not connected to the grid's border become solid. How many cavities those are.
  int fill(Field& field) {
    std::vector<char> seen(sets_.size(), 0);
    int cavities = 0;
    const int border = sets_.find(run_set(0));
    for (int b = 0; b < map_.blocks(); ++b)
      for (int r = first_region_[b]; r < first_region_[b + 1]; ++r) {
        const int set = sets_.find(region_set(r));
        if (set == border) continue;
        cavities += !seen[set];
        seen[set] = 1;
        for (int z = 0; z < 8; ++z) field[b].solid[z] |= regions_[r].nodes[z];
      }
    // Empty blocks within a cavity hold no surface: nothing to do for them.
    return cavities;
  }

 private:
  int run_set(int run) const { return run; }
  int region_set(int region) const { return static_cast<int>(runs_.size()) + region; }

  void find_runs() {
    const int rows = grid_.size[1] * grid_.size[2], width = grid_.size[0];
    first_run_.assign(rows + 1, 0);
    for (int row = 0; row < rows; ++row) {
      const std::size_t start = static_cast<std::size_t>(row) * width;
      for (int x = 0; x < width; ++x) {
        if (map_.at(start + x) != BlockMap::empty) continue;
        if (x > 0 && map_.at(start + x - 1) == BlockMap::empty) runs_.back().last = x;
        else runs_.push_back({x, x}), sets_.add();
      }
      first_run_[row + 1] = static_cast<int>(runs_.size());
    }
  }

  void find_regions(const Field& field) {
    first_region_.assign(map_.blocks() + 1, 0);
    for (int b = 0; b < map_.blocks(); ++b) {
      NodeBits left;
      std::uint64_t any = 0;
      for (int z = 0; z < 8; ++z) any |= left[z] = ~field[b].inside[z];
      while (any) {
        regions_.push_back(take_region(left));
        sets_.add();
        any = 0;
        for (const std::uint64_t word : left) any |= word;
      }
      first_region_[b + 1] = static_cast<int>(regions_.size());
    }
  }

  void join_rows(int a, int b) {
    for (int i = first_run_[a], j = first_run_[b]; i < first_run_[a + 1] && j < first_run_[b + 1];) {
      if (runs_[i].first <= runs_[j].last && runs_[j].first <= runs_[i].last) sets_.join(run_set(i), run_set(j));
      runs_[i].last < runs_[j].last ? ++i : ++j;
    }
  }

  void join_runs() {
    for (int z = 0; z < grid_.size[2]; ++z)
      for (int y = 0; y < grid_.size[1]; ++y) {
        const int row = z * grid_.size[1] + y;
        if (y > 0) join_rows(row - 1, row);
        if (z > 0) join_rows(row - grid_.size[1], row);
      }
  }

  int run_at(std::size_t number) const {
    const int row = static_cast<int>(number / grid_.size[0]), x = static_cast<int>(number % grid_.size[0]);
    const auto found = std::upper_bound(runs_.begin() + first_run_[row], runs_.begin() + first_run_[row + 1], x,
                                        [](int at, const Run& run) { return at < run.first; });
    return static_cast<int>(found - runs_.begin()) - 1;
  }

  // Neighbours share the nodes of their common side.
  void join_block(int b) {
    const std::size_t step[3] = {1, static_cast<std::size_t>(grid_.size[0]),
                                 static_cast<std::size_t>(grid_.size[0]) * grid_.size[1]};
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        const std::size_t beside = high ? map_.number(b) + step[axis] : map_.number(b) - step[axis];
        const int other = map_.at(beside);
        if (other == BlockMap::interior || (other >= 0 && !high)) continue;
        for (int r = first_region_[b]; r < first_region_[b + 1]; ++r) {
          if (other == BlockMap::empty) {
            if (touches_side(regions_[r], axis, high)) sets_.join(region_set(r), run_set(run_at(beside)));
            continue;
          }
          for (int q = first_region_[other]; q < first_region_[other + 1]; ++q)
            if (share_nodes(regions_[r], regions_[q], axis)) sets_.join(region_set(r), region_set(q));
        }
      }
  }

  const BlockMap& map_;
  const BlockGrid& grid_;
  std::vector<Run> runs_;
  std::vector<int> first_run_;  ///< by row of blocks along x
  std::vector<Region> regions_;
  std::vector<int> first_region_;  ///< by block
  Sets sets_;                      ///< runs, then regions
};

}  // namespace

int fill_cavities(const BlockMap& map, Field& field) {
  Outside outside(map, field);
  return outside.fill(field);
}

}  // namespace tendril::envelope
