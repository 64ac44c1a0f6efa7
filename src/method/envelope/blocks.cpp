#include "method/envelope/blocks.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"

namespace tendril::envelope {
namespace {

int floor_divided(long long a, int b) { return static_cast<int>(a >= 0 ? a / b : -((-a + b - 1) / b)); }

/// The blocks that a hull may touch.
struct Range {
  int low[3], high[3];  // the last one included
};

Range range_of(const SweptHull& hull, double voxel) {
  Range range;
  for (int k = 0; k < 3; ++k) {
    range.low[k] = floor_divided(static_cast<long long>(std::floor(hull.low(k) / voxel)) - 1, BlockGrid::cells);
    range.high[k] = floor_divided(static_cast<long long>(std::ceil(hull.high(k) / voxel)) + 1, BlockGrid::cells);
  }
  return range;
}

[[noreturn]] void refuse(double voxel, double bytes, double memory, double power) {
  const double fits = voxel * std::pow(bytes / memory, 1 / power) * 1.1;
  throw UsageError("envelope: a voxel of " + number_text(1e3 * voxel) + " mm needs about " + number_text(bytes / 1e9) +
                   " GB, " + number_text(memory / 1e9) + " GB are allowed; take a voxel of at least " +
                   number_text(std::ceil(1e4 * fits) / 10) + " mm, or allow more memory");
}

}  // namespace

Cube BlockGrid::cube(const int* at, int width) const {
  Cube cube;
  for (int k = 0; k < 3; ++k) cube.middle[k] = (static_cast<float>(cells * (low[k] + at[k])) + 0.5f * cells * width) * voxel;
  cube.half = 0.5f * cells * width * voxel;
  return cube;
}

NodeGrid BlockGrid::nodes(const int* at) const {
  NodeGrid nodes;
  float* const rows[3] = {nodes.x, nodes.y, nodes.z};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 8; ++i) rows[k][i] = static_cast<float>(cells * (low[k] + at[k]) + i) * voxel;
  return nodes;
}

void BlockMap::plan(const std::vector<SweptHull>& hulls, int count, double wanted_voxel, double memory) {
  grid_.voxel = static_cast<float>(wanted_voxel);
  const double voxel = grid_.voxel;
  double low[3], high[3], blocks = 1;
  for (int k = 0; k < 3; ++k) {
    low[k] = INFINITY, high[k] = -INFINITY;
    for (int i = 0; i < count; ++i) {
      low[k] = std::min<double>(low[k], hulls[i].low(k));
      high[k] = std::max<double>(high[k], hulls[i].high(k));
    }
    blocks *= (high[k] - low[k]) / (voxel * BlockGrid::cells) + 4;
  }
  const double bytes = blocks * (sizeof(int) + 1);
  if (bytes > memory) refuse(voxel, bytes, memory, 3);
  for (int k = 0; k < 3; ++k) {
    grid_.low[k] = floor_divided(static_cast<long long>(std::floor(low[k] / voxel)) - 1, BlockGrid::cells) - 1;
    grid_.size[k] = floor_divided(static_cast<long long>(std::ceil(high[k] / voxel)) + 1, BlockGrid::cells) + 2 - grid_.low[k];
  }
}

/// Descends through cubes of blocks for one hull, with ever fewer planes.
struct BlockMap::Worker {
  BlockMap& map;
  const Kernel& kernel;
  float slack;
  std::vector<Found>& found;
  std::vector<float>& rows;

  void mark(std::size_t number, std::uint8_t bit) {
    std::atomic_ref<std::uint8_t>(map.state_[number]).fetch_or(bit, std::memory_order_relaxed);
  }

  void mark_interior(const Range& range, const int* at, int width) {
    int last[3];
    for (int k = 0; k < 3; ++k) last[k] = std::min(at[k] + width, range.high[k] + 1);
    for (int z = at[2]; z < last[2]; ++z)
      for (int y = at[1]; y < last[1]; ++y)
        for (int x = at[0]; x < last[0]; ++x) mark(map.grid_.number(x, y, z), 2);
  }

  /// `range` and `at` count from the grid's first block. The planes below this level lie in `rows` from `level` on.
  void descend(const SweptHull& hull, const PlaneArrays& planes, const Range& range, const int* at, int width, int level) {
    const Cube cube = map.grid_.cube(at, width);
    const FieldBounds field = hull.is_capsule() ? hull.bounds(kernel, cube) : kernel.bounds(planes, cube);
    if (field.low > slack) return;
    if (field.high < -slack) return mark_interior(range, at, width);
    if (width == 1) {
      const std::size_t number = map.grid_.number(at[0], at[1], at[2]);
      mark(number, 1);
      found.push_back({number, field.low, field.high});
      return;
    }
    PlaneArrays fewer = planes;
    if (!hull.is_capsule()) {
      const int room = hull.planes().count;
      float* const to = &rows[static_cast<std::size_t>(level) * 5 * room];
      fewer = {to, to + room, to + 2 * room, to + 3 * room, to + 4 * room,
               kernel.relevant(planes, cube, field.low - slack, to, room)};
    }
    const int half = width / 2;
    for (int child = 0; child < 8; ++child) {
      const int next[3] = {at[0] + (child & 1) * half, at[1] + (child >> 1 & 1) * half, at[2] + (child >> 2) * half};
      if (next[0] <= range.high[0] && next[1] <= range.high[1] && next[2] <= range.high[2])
        descend(hull, fewer, range, next, half, level + 1);
    }
  }

  void run(const SweptHull& hull) {
    Range range = range_of(hull, map.grid_.voxel);
    int widest = 1;
    for (int k = 0; k < 3; ++k) {
      range.low[k] = std::max(range.low[k] - map.grid_.low[k], 1);
      range.high[k] = std::min(range.high[k] - map.grid_.low[k], map.grid_.size[k] - 2);
      widest = std::max(widest, range.high[k] - range.low[k] + 1);
    }
    int width = 1, levels = 0;
    for (; width < widest; width *= 2) ++levels;
    if (!hull.is_capsule()) rows.resize(std::max(rows.size(), static_cast<std::size_t>(levels) * 5 * hull.planes().count));
    descend(hull, hull.is_capsule() ? PlaneArrays{} : hull.planes(), range, range.low, width, 0);
  }
};

std::optional<Status> BlockMap::fill(const std::vector<SweptHull>& hulls, int count, float slack, double memory,
                                     const Kernel& kernel, const RunContext& context) {
  state_.assign(grid_.count(), 0);
  const int workers = std::min(thread_count(context.threads), count);
  found_.resize(std::max<std::size_t>(found_.size(), workers));
  planes_.resize(std::max<std::size_t>(planes_.size(), workers));
  shares_.assign(count, {});
  std::atomic<int> next = 0;
  std::atomic<std::size_t> total = 0;
  std::atomic<bool> too_many = false;
  const double base = static_cast<double>(grid_.count()) * (sizeof(int) + 1);
  run_workers(workers, [&](int w) {
    found_[w].clear();
    Worker worker{*this, kernel, slack, found_[w], planes_[w]};
    for (int i; (i = next++) < count && !too_many && !context.stop();) {
      const std::size_t first = found_[w].size();
      worker.run(hulls[i]);
      shares_[i] = {w, first, found_[w].size()};
      const std::size_t all = total += found_[w].size() - first;
      if (base + static_cast<double>(all) * (sizeof(Found) + sizeof(Entry)) > memory) too_many = true;
    }
  });
  if (const auto stop = context.stop()) return stop;
  if (too_many) {
    const double done = std::clamp<double>(next.load(), 1, count);
    refuse(grid_.voxel, base + static_cast<double>(total) * count / done * (sizeof(Found) + sizeof(Entry)), memory, 2);
  }
  number_blocks();
  collect(count);
  return std::nullopt;
}

void BlockMap::number_blocks() {
  index_.resize(grid_.count());
  block_.clear();
  for (std::size_t i = 0; i < index_.size(); ++i) {
    const std::uint8_t state = state_[i];
    index_[i] = state == 0 ? empty : state & 2 ? interior : static_cast<int>(block_.size());
    if (state == 1) block_.push_back(i);
  }
}

// The entries of each block in the order of the hulls.
void BlockMap::collect(int hulls) {
  first_.assign(block_.size() + 1, 0);
  const auto each = [&](const auto& visit) {
    for (int i = 0; i < hulls; ++i)
      for (std::size_t k = shares_[i].first; k < shares_[i].last; ++k) {
        const Found& found = found_[shares_[i].worker][k];
        if (const int block = index_[found.number]; block >= 0) visit(i, block, found);
      }
  };
  each([&](int, int block, const Found&) { ++first_[block + 1]; });
  for (std::size_t b = 0; b < block_.size(); ++b) first_[b + 1] += first_[b];
  entries_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  each([&](int hull, int block, const Found& found) { entries_[next[block]++] = {hull, found.low, found.high}; });
}

std::size_t BlockMap::bytes() const {
  std::size_t bytes = state_.capacity() + index_.capacity() * sizeof(int) + entries_.capacity() * sizeof(Entry) +
                      (block_.capacity() + first_.capacity()) * sizeof(std::size_t);
  for (const auto& found : found_) bytes += found.capacity() * sizeof(Found);
  return bytes;
}

}  // namespace tendril::envelope
