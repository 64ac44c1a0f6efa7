// The field of all swept hulls at the nodes of the blocks: which nodes are inside, and where edges cross the surface.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "method/envelope/blocks.h"

namespace tendril::envelope {

/// Bit j * 8 + i of word k is node (i, j, k) of a block, i along x.
using NodeBits = std::uint64_t[8];

/// A block owns the edges that start at its nodes 0 ... 6 along each axis; those at 7 belong to the next block.
constexpr std::uint64_t owned_nodes = 0x007f7f7f7f7f7f7full;

/// The owned edges along an axis, by their lower node, whose ends lie on both sides; `layer`: 0 ... 6.
inline std::uint64_t crossed_edges(const NodeBits& inside, int axis, int layer) {
  const std::uint64_t here = inside[layer];
  const std::uint64_t there = axis == 0 ? here >> 1 : axis == 1 ? here >> 8 : inside[layer + 1];
  return (here ^ there) & owned_nodes;
}

struct FieldBlock {
  NodeBits inside;  ///< by the field
  NodeBits solid;   ///< with cavities filled
  int worker = 0;
  std::size_t first_crossing = 0;  ///< among the worker's
};

class Field {
 public:
  /// Edges are crossed no nearer to their ends than this share of their length, so that vertices stay apart.
  static constexpr float nearest_to_end = 1.0f / 256;

  std::optional<Status> evaluate(const BlockMap& map, const std::vector<SweptHull>& hulls, float slack,
                                 const Kernel& kernel, const RunContext& context);

  int size() const { return count_; }
  FieldBlock& operator[](int block) { return blocks_[block]; }
  const FieldBlock& operator[](int block) const { return blocks_[block]; }
  /// Where the block's edges are crossed, as shares of their length: all along x, then y, then z; layer by layer; in the
  /// order of bits.
  const float* crossings(int block) const { return &crossings_[blocks_[block].worker][blocks_[block].first_crossing]; }
  std::size_t bytes() const;

 private:
  int count_ = 0;
  std::vector<FieldBlock> blocks_;
  std::vector<std::vector<float>> crossings_, planes_;  ///< by worker
};

}  // namespace tendril::envelope
