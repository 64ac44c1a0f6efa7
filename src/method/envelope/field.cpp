#include "method/envelope/field.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "base/parallel.h"

namespace tendril::envelope {
namespace {

/// The lowest of all hulls' fields that can be the lowest somewhere in the block.
void evaluate_block(const BlockMap& map, int block, const std::vector<SweptHull>& hulls, float slack, const Kernel& kernel,
                    std::vector<float>& rows, float* field) {
  int at[3];
  map.grid().place(map.number(block), at);
  const Cube cube = map.grid().cube(at, 1);
  const NodeGrid nodes = map.grid().nodes(at);
  float least_high = map.begin(block)->high;
  for (const auto* entry = map.begin(block); entry != map.end(block); ++entry) least_high = std::min(least_high, entry->high);
  std::fill_n(field, 512, 1e30f);
  for (const auto* entry = map.begin(block); entry != map.end(block); ++entry) {
    if (entry->low > least_high + slack) continue;
    const SweptHull& hull = hulls[entry->hull];
    if (hull.is_capsule()) {
      kernel.lower_by_capsule(hull.capsule(), nodes, field);
      continue;
    }
    const PlaneArrays all = hull.planes();
    const int room = all.count;
    if (rows.size() < static_cast<std::size_t>(5 * room)) rows.resize(5 * room);
    const int count = kernel.relevant(all, cube, entry->low - slack, rows.data(), room);
    const float* row = rows.data();
    kernel.lower_by_planes({row, row + room, row + 2 * room, row + 3 * room, row + 4 * room, count}, nodes, field);
  }
}

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
    for (int c; (c = next++) < chunks && !context.stop();)
      for (int b = c * chunk; b < std::min(count_, (c + 1) * chunk); ++b) {
        evaluate_block(map, b, hulls, slack, kernel, planes_[worker], field);
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
