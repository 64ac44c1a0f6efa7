#include "method/envelope/field.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "base/parallel.h"

namespace tendril::envelope {
namespace {

/// Evaluates block after block. Memory is kept from block to block.
class Evaluator {
 public:
  Evaluator(const BlockMap& map, const std::vector<SweptHull>& hulls, float slack, const Kernel& kernel, std::vector<float>& rows)
      : map_(map), hulls_(hulls), slack_(slack), kernel_(kernel), rows_(rows) {
    for (const SweptHull& hull : hulls) room_ = std::max(room_, hull.planes().count);
    rows_.resize(std::max(rows_.size(), static_cast<std::size_t>(2 * plane_rows * room_)));
  }

  /// The lowest of all hulls' fields that can be the lowest somewhere in the block.
  void evaluate(int block, float* field) {
    int at[3];
    map_.grid().place(map_.number(block), at);
    cube_ = map_.grid().cube(at, 1);
    const NodeGrid nodes = map_.grid().nodes(at);
    const BlockMap::Entry* lowest = map_.begin(block);
    for (const auto* entry = lowest; entry != map_.end(block); ++entry)
      if (entry->high < lowest->high) lowest = entry;
    std::fill_n(field, 512, 1e30f);
    lower(*lowest, nodes, field);
    const PlaneArrays below = lowest->count > 0 ? gather(*lowest, 0) : PlaneArrays{};
    for (const auto* entry = map_.begin(block); entry != map_.end(block); ++entry)
      if (entry != lowest && entry->low <= lowest->high + slack_ && !is_above(*entry, below)) lower(*entry, nodes, field);
  }

 private:
  /// The entry's planes, in the rows number `where`.
  PlaneArrays gather(const BlockMap::Entry& entry, int where) {
    const int room = room_;
    const PlaneArrays all = hulls_[entry.hull].planes();
    const std::uint16_t* const numbers = map_.planes(entry);
    float* const to = &rows_[static_cast<std::size_t>(where) * plane_rows * room];
    int count = 0;
    for (; count < entry.count; ++count) {
      const int i = numbers[count];
      to[count] = all.x[i];
      to[count + room] = all.y[i];
      to[count + 2 * room] = all.z[i];
      to[count + 3 * room] = all.offset[i];
    }
    for (; count % 16; ++count) {
      to[count] = to[count + room] = to[count + 2 * room] = 0;
      to[count + 3 * room] = 1e30f;
    }
    return {to, to + room, to + 2 * room, to + 3 * room, to + 4 * room, count};
  }

  void lower(const BlockMap::Entry& entry, const NodeGrid& nodes, float* field) {
    if (entry.count == 0) kernel_.lower_by_capsule(hulls_[entry.hull].capsule(), nodes, field);
    else kernel_.lower_by_planes(gather(entry, 1), nodes, field);
  }

  /// One of the entry's planes is above all planes of another hull: its field is nowhere the lower one.
  bool is_above(const BlockMap::Entry& entry, const PlaneArrays& other) const {
    if (entry.count == 0 || other.count == 0) return false;
    const PlaneArrays all = hulls_[entry.hull].planes();
    const float top[4] = {all.x[entry.top], all.y[entry.top], all.z[entry.top], all.offset[entry.top]};
    return kernel_.all_below(other, top, cube_, slack_);
  }

  const BlockMap& map_;
  const std::vector<SweptHull>& hulls_;
  const float slack_;
  const Kernel& kernel_;
  std::vector<float>& rows_;
  int room_ = 16;  ///< for the planes of the largest hull
  Cube cube_{};
};

void append_crossings(const float* field, const NodeBits& inside, std::vector<float>& out) {
  constexpr float end = Field::nearest_to_end;
  constexpr int step[3] = {1, 8, 64};
  for (int axis = 0; axis < 3; ++axis)
    for (int layer = 0; layer < 7; ++layer)
      for (std::uint64_t edges = crossed_edges(inside, axis, layer); edges; edges &= edges - 1) {
        const float* const from = field + layer * 64 + __builtin_ctzll(edges);
        out.push_back(std::clamp(from[0] / (from[0] - from[step[axis]]), end, 1 - end));
      }
}

}  // namespace

std::optional<Status> Field::evaluate(const BlockMap& map, const std::vector<SweptHull>& hulls, float slack,
                                      const Kernel& kernel, const RunContext& context) {
  count_ = map.blocks();
  if (static_cast<int>(blocks_.size()) < count_) blocks_.resize(count_);
  constexpr int chunk = 16;
  const int chunks = (count_ + chunk - 1) / chunk, workers = std::max(1, std::min(thread_count(context.threads), chunks));
  crossings_.resize(std::max<std::size_t>(crossings_.size(), workers));
  planes_.resize(std::max<std::size_t>(planes_.size(), workers));
  std::atomic<int> next = 0;
  run_workers(workers, [&](int worker) {
    alignas(64) float field[512];
    std::vector<float>& crossings = crossings_[worker];
    crossings.clear();
    Evaluator evaluator(map, hulls, slack, kernel, planes_[worker]);
    for (int c; (c = next++) < chunks && !context.stop();)
      for (int b = c * chunk; b < std::min(count_, (c + 1) * chunk); ++b) {
        evaluator.evaluate(b, field);
        FieldBlock& block = blocks_[b];
        kernel.signs(field, block.inside);
        std::memcpy(block.solid, block.inside, sizeof block.solid);
        block.worker = worker;
        block.first_crossing = crossings.size();
        append_crossings(field, block.inside, crossings);
      }
  });
  return context.stop();
}

std::size_t Field::bytes() const {
  std::size_t bytes = blocks_.capacity() * sizeof(FieldBlock);
  for (const auto& list : crossings_) bytes += list.capacity() * sizeof(float);
  return bytes;
}

}  // namespace tendril::envelope
