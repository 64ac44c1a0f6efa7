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
  std::vector<std::uint16_t>& numbers;
  std::vector<float>& rows;
  int hull = 0;
  Range range{};  ///< counted from the grid's first block

  bool is_interior(std::size_t number) const {
    return std::atomic_ref<std::uint8_t>(map.state_[number]).load(std::memory_order_relaxed) & 2;
  }
  void mark(std::size_t number, std::uint8_t bit) {
    const std::atomic_ref<std::uint8_t> state(map.state_[number]);
    if (!(state.load(std::memory_order_relaxed) & bit)) state.fetch_or(bit, std::memory_order_relaxed);
  }

  void mark_interior(const int* at, int width) {
    int last[3];
    for (int k = 0; k < 3; ++k) last[k] = std::min(at[k] + width, range.high[k] + 1);
    for (int z = at[2]; z < last[2]; ++z)
      for (int y = at[1]; y < last[1]; ++y)
        for (int x = at[0]; x < last[0]; ++x) mark(map.grid_.number(x, y, z), 2);
  }

  void append(const int* at, const Narrowed& field, const float* plane_numbers) {
    const std::size_t number = map.grid_.number(at[0], at[1], at[2]), first = numbers.size();
    mark(number, 1);
    for (int i = 0; i < field.count; ++i) numbers.push_back(static_cast<std::uint16_t>(plane_numbers[i]));
    found.push_back({number, {hull, field.bounds.low, field.bounds.high, static_cast<std::uint16_t>(field.top),
                              static_cast<std::uint16_t>(field.count), first}});
  }

  /// Whether the surface may pass through a cube; what is within it is marked.
  bool settled(const FieldBounds& field, const int* at, int width) {
    if (field.high < -slack) mark_interior(at, width);
    return field.high < -slack || field.low > slack;
  }

  template <class Next>
  void each_child(const int* at, int width, const Next& next) {
    const int half = width / 2;
    for (int child = 0; child < 8; ++child) {
      const int place[3] = {at[0] + (child & 1) * half, at[1] + (child >> 1 & 1) * half, at[2] + (child >> 2) * half};
      if (place[0] > range.high[0] || place[1] > range.high[1] || place[2] > range.high[2]) continue;
      // Nothing more is to be said of a block within another hull. Which hulls are that far already does not matter: in
      // the end such blocks have no entries.
      if (half == 1 && is_interior(map.grid_.number(place[0], place[1], place[2]))) continue;
      next(place, half);
    }
  }

  void descend_capsule(const SweptHull& swept, const int* at, int width) {
    const FieldBounds field = swept.capsule_bounds(map.grid_.cube(at, width));
    if (settled(field, at, width)) return;
    if (width == 1) return append(at, {field}, nullptr);
    each_child(at, width, [&](const int* place, int half) { descend_capsule(swept, place, half); });
  }

  /// The planes of this level and those below lie in `rows` from `level` on, `room` each.
  void descend(const PlaneArrays& planes, const int* at, int width, int level, int room) {
    float* const to = &rows[static_cast<std::size_t>(level) * plane_rows * room];
    const Narrowed field = kernel.narrow(planes, map.grid_.cube(at, width), slack, to, room);
    if (settled(field.bounds, at, width)) return;
    if (width == 1) {
      // Without what fills up the tail.
      Narrowed exact = field;
      while (exact.count > 0 && to[3 * room + exact.count - 1] > 1e29f) --exact.count;
      return append(at, exact, to + 4 * room);
    }
    const PlaneArrays fewer{to, to + room, to + 2 * room, to + 3 * room, to + 4 * room, field.count};
    each_child(at, width, [&](const int* place, int half) { descend(fewer, place, half, level + 1, room); });
  }

  void run(const SweptHull& swept, int index) {
    hull = index;
    range = range_of(swept, map.grid_.voxel);
    int widest = 1;
    for (int k = 0; k < 3; ++k) {
      range.low[k] = std::max(range.low[k] - map.grid_.low[k], 1);
      range.high[k] = std::min(range.high[k] - map.grid_.low[k], map.grid_.size[k] - 2);
      widest = std::max(widest, range.high[k] - range.low[k] + 1);
    }
    int width = 1, levels = 1;
    for (; width < widest; width *= 2) ++levels;
    if (swept.is_capsule()) return descend_capsule(swept, range.low, width);
    const PlaneArrays planes = swept.planes();
    rows.resize(std::max(rows.size(), static_cast<std::size_t>(levels) * plane_rows * planes.count));
    descend(planes, range.low, width, 0, planes.count);
  }
};

std::optional<Status> BlockMap::fill(const std::vector<SweptHull>& hulls, int count, float slack, double memory,
                                     const Kernel& kernel, const RunContext& context) {
  state_.assign(grid_.count(), 0);
  const int workers = std::min(thread_count(context.threads), count);
  found_.resize(std::max<std::size_t>(found_.size(), workers));
  numbers_.resize(std::max<std::size_t>(numbers_.size(), workers));
  planes_.resize(std::max<std::size_t>(planes_.size(), workers));
  shares_.assign(count, {});
  // Neighbours overlap: the first few find what is interior, and the rest have less to do.
  std::vector<int> order;
  for (const int first : {0, 2, 1, 3})
    for (int i = first; i < count; i += 4) order.push_back(i);
  std::atomic<int> next = 0;
  std::atomic<std::size_t> total = 0;
  std::atomic<bool> too_many = false;
  const double base = static_cast<double>(grid_.count()) * (sizeof(int) + 1);
  run_workers(workers, [&](int w) {
    found_[w].clear();
    numbers_[w].clear();
    Worker worker{*this, kernel, slack, found_[w], numbers_[w], planes_[w]};
    for (int turn; (turn = next++) < count && !too_many && !context.stop();) {
      const int i = order[turn];
      const std::size_t first = found_[w].size();
      worker.run(hulls[i], i);
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
        if (const int block = index_[found.number]; block >= 0) visit(block, found.entry);
      }
  };
  each([&](int block, const Entry&) { ++first_[block + 1]; });
  for (std::size_t b = 0; b < block_.size(); ++b) first_[b + 1] += first_[b];
  entries_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  each([&](int block, const Entry& entry) { entries_[next[block]++] = entry; });
}

std::size_t BlockMap::bytes() const {
  std::size_t bytes = state_.capacity() + index_.capacity() * sizeof(int) + entries_.capacity() * sizeof(Entry) +
                      (block_.capacity() + first_.capacity()) * sizeof(std::size_t);
  for (const auto& found : found_) bytes += found.capacity() * sizeof(Found);
  for (const auto& numbers : numbers_) bytes += numbers.capacity() * sizeof(std::uint16_t);
  return bytes;
}

}  // namespace tendril::envelope
