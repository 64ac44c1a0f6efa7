#include "geometry/distance_transform.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/huge_pages.h"
#include "base/parallel.h"

namespace tendril {
namespace {

constexpr float none = std::numeric_limits<float>::infinity();
/// Columns along y or z are taken in bundles, as many as share a line of memory.
constexpr int bundle = 16;

void along_x(const std::uint8_t* marks, int n, float* out) {
  float steps = none;
  for (int i = 0; i < n; ++i) {
    steps = marks[i] ? 0 : steps + 1;
    out[i] = steps;
  }
  steps = none;
  for (int i = n - 1; i >= 0; --i) {
    steps = marks[i] ? 0 : steps + 1;
    const float least = std::min(out[i], steps);
    out[i] = least * least;
  }
}

/// The lower envelope of the parabolas f(v) + (q - v)^2 at q = 0 ... n - 1. Memory is kept from column to column.
class Envelope {
 public:
  explicit Envelope(int n) : n_(n), inverse_(n + 1), from_(n + 1), at_(n), height_(n) {
    for (int k = 1; k <= n; ++k) inverse_[k] = 0.5f / static_cast<float>(k);
  }

  /// Takes and gives a column of numbers.
  void lower(float* f) {
    int count = 0;
    for (int q = 0; q < n_; ++q) {
      if (f[q] == none) continue;
      const float raised = f[q] + static_cast<float>(q) * static_cast<float>(q);
      float from = -none;
      for (; count > 0; --count) {
        const int v = at_[count - 1];
        from = (raised - (height_[count - 1] + static_cast<float>(v) * static_cast<float>(v))) * inverse_[q - v];
        if (from > from_[count - 1]) break;
        from = -none;
      }
      at_[count] = q;
      height_[count] = f[q];
      from_[count] = from;
      ++count;
    }
    if (count == 0) return;
    from_[count] = none;
    for (int q = 0, k = 0; q < n_; ++q) {
      while (from_[k + 1] < static_cast<float>(q)) ++k;
      const float way = static_cast<float>(q - at_[k]);
      f[q] = way * way + height_[k];
    }
  }

 private:
  int n_;
  std::vector<float> inverse_, from_;  ///< half of 1/k; where a parabola begins to be the lowest
  std::vector<int> at_;
  std::vector<float> height_;
};

/// All columns along one axis (stride apart) that begin at first ... first + width - 1.
void lower_bundle(float* first, int width, std::size_t stride, int n, std::vector<float>& columns, Envelope& envelope) {
  for (int q = 0; q < n; ++q)
    for (int x = 0; x < width; ++x) columns[static_cast<std::size_t>(x) * n + q] = first[q * stride + x];
  for (int x = 0; x < width; ++x) envelope.lower(&columns[static_cast<std::size_t>(x) * n]);
  for (int q = 0; q < n; ++q)
    for (int x = 0; x < width; ++x) first[q * stride + x] = columns[static_cast<std::size_t>(x) * n + q];
}

/// Runs slice(worker's own state, i) for all i below `count`.
template <class State, class Slice>
void for_slices(int count, const RunContext& context, const State& state, const Slice& slice) {
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), std::max(1, count)), [&](int) {
    auto own = state();
    for (int i; (i = next++) < count && !context.stop();) slice(own, i);
  });
}

struct Columns {
  explicit Columns(int n) : envelope(n), values(static_cast<std::size_t>(n) * bundle) {}
  Envelope envelope;
  std::vector<float> values;
};

}  // namespace

std::vector<float> squared_distances(const std::vector<std::uint8_t>& marks, const Eigen::Array3i& size, const RunContext& context) {
  const std::size_t row = size.x(), layer = row * size.y();
  std::vector<float> squared;
  squared.reserve(marks.size());
  prefer_huge_pages(squared.data(), marks.size() * sizeof(float));
  squared.resize(marks.size());
  for_slices(size.z(), context, [&] { return Columns(size.y()); }, [&](Columns& own, int k) {
    for (int j = 0; j < size.y(); ++j) along_x(&marks[k * layer + j * row], size.x(), &squared[k * layer + j * row]);
    for (int i = 0; i < size.x(); i += bundle)
      lower_bundle(&squared[k * layer + i], std::min(bundle, size.x() - i), row, size.y(), own.values, own.envelope);
  });
  for_slices(size.y(), context, [&] { return Columns(size.z()); }, [&](Columns& own, int j) {
    for (int i = 0; i < size.x(); i += bundle)
      lower_bundle(&squared[j * row + i], std::min(bundle, size.x() - i), layer, size.z(), own.values, own.envelope);
  });
  return squared;
}

}  // namespace tendril
