#include "view/histogram.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

constexpr double most_bins = 200;

/// Of sorted values, linear between neighbours.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), sorted.size() - 1),
                    next = std::min(i + 1, sorted.size() - 1);
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[next] - sorted[i]);
}

int chosen_bins(const std::vector<double>& sorted) {
  const double n = static_cast<double>(sorted.size()), range = sorted.back() - sorted.front();
  const double spread = quantile(sorted, 0.75) - quantile(sorted, 0.25);
  const double sturges = std::ceil(std::log2(n)) + 1;
  const double wanted = spread > 0 ? range / (2 * spread / std::cbrt(n)) : sturges;
  return static_cast<int>(std::clamp(std::ceil(wanted), 1.0, most_bins));
}

}  // namespace

Histogram histogram_of(std::vector<double> values, int bins) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  Histogram result;
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  const double low = values.front(), high = values.back();
  const double size = std::max(std::abs(low), std::abs(high));
  // Halves, so that a range up to the largest double does not overflow.
  if (!(0.5 * high - 0.5 * low > 1e-12 * size)) {
    const double half = size > 0 ? 0.05 * size : 0.5;
    result.edges = {low - half, high + half};
    result.counts = {values.size()};
    return result;
  }
  const int count = bins > 0 ? bins : std::isfinite(high - low) ? chosen_bins(values) : 1;
  result.counts.assign(static_cast<std::size_t>(count), 0);
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    result.edges.push_back((1 - t) * low + t * high);
  }
  for (double value : values) {
    const auto above = std::upper_bound(result.edges.begin() + 1, result.edges.end() - 1, value);
    ++result.counts[static_cast<std::size_t>(above - result.edges.begin()) - 1];
  }
  return result;
}

}  // namespace tendril
