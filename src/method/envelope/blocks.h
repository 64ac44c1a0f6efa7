// Space in blocks of 7 x 7 x 7 cells, and which swept hulls have their surface in which block.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/run_context.h"
#include "method/envelope/hulls.h"

namespace tendril::envelope {

/// Where blocks lie. Node n of the whole grid is at n * voxel from the origin; block b has the nodes 7 b ... 7 b + 7, so
/// that neighbours share a layer of nodes. The outermost blocks hold nothing.
struct BlockGrid {
  static constexpr int cells = 7;
  float voxel = 0;          ///< m
  int low[3] = {0, 0, 0};   ///< the first block
  int size[3] = {0, 0, 0};  ///< blocks

  std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
  std::size_t number(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size[1] + y) * size[0] + x;  // counted from `low`
  }
  void place(std::size_t number, int* at) const {
    at[0] = static_cast<int>(number % size[0]);
    at[1] = static_cast<int>(number / size[0] % size[1]);
    at[2] = static_cast<int>(number / size[0] / size[1]);
  }
  /// A cube of `width` blocks from block `at` on.
  Cube cube(const int* at, int width) const;
  NodeGrid nodes(const int* at) const;
};

class BlockMap {
 public:
  /// A hull whose surface may pass through a block, its field's bounds there, and which of its planes count there.
  struct Entry {
    int hull;
    float low, high;
    std::uint16_t top, count;  ///< the plane that is the highest at the block's middle; planes, 0 for a capsule
    std::size_t first;         ///< see planes()
  };
  static constexpr int empty = -1, interior = -2;

  /// The grid for these hulls. Throws UsageError when its blocks alone need more than `memory` bytes or their numbers are
  /// beyond what single precision resolves.
  void plan(const std::vector<SweptHull>& hulls, int count, double voxel, double memory);

  /// Finds for each block the hulls whose surface may pass through it; blocks wholly within some hull are interior.
  /// `slack` (m) is above the rounding of a field value. Nothing, or why it stopped.
  std::optional<Status> fill(const std::vector<SweptHull>& hulls, int count, float slack, double memory,
                             const Kernel& kernel, const RunContext& context);

  const BlockGrid& grid() const { return grid_; }
  int blocks() const { return static_cast<int>(block_.size()); }
  std::size_t number(int block) const { return block_[block]; }  ///< in the grid
  /// The block at a place of the grid, or `empty` or `interior`.
  int at(std::size_t number) const { return index_[number]; }
  const Entry* begin(int block) const { return &entries_[first_[block]]; }
  const Entry* end(int block) const { return &entries_[0] + first_[block + 1]; }
  /// The numbers of the entry's planes in its hull.
  const std::uint16_t* planes(const Entry& entry) const { return &numbers_[shares_[entry.hull].worker][entry.first]; }
  std::size_t bytes() const;

 private:
  struct Worker;
  struct Found {
    std::size_t number;
    Entry entry;
  };
  struct Share {
    int worker = 0;
    std::size_t first = 0, last = 0;
  };
  void number_blocks();
  void collect(int hulls);

  BlockGrid grid_;
  std::vector<std::uint8_t> state_;  ///< by place: 1 a surface may pass, 2 wholly within a hull
  std::vector<int> index_;           ///< by place
  std::vector<std::size_t> block_;   ///< by block: its place
  std::vector<std::size_t> first_;   ///< by block: its first entry
  std::vector<Entry> entries_;
  std::vector<Share> shares_;        ///< by hull: where its blocks are found
  std::vector<std::vector<Found>> found_;  ///< by worker
  std::vector<std::vector<std::uint16_t>> numbers_;  ///< by worker: planes of its entries
  std::vector<std::vector<float>> planes_;  ///< by worker: the planes of each level of descent
};

}  // namespace tendril::envelope
