#include "view/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tendril {
namespace {

std::string fixed_text(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Decimals that write `step` in full.
int decimals_of(double step) {
  for (int decimals = 0; decimals < 12; ++decimals) {
    const double scaled = step * std::pow(10.0, decimals);
    if (std::abs(scaled - std::round(scaled)) < 1e-6 * scaled) return decimals;
  }
  return 12;
}

std::string tick_text(double value, double step, double largest) {
  if (largest >= 1e5 || largest < 1e-3) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 0.5 * step ? 0.0 : value);
    return text;
  }
  return fixed_text(std::abs(value) < 0.5 * step ? 0.0 : value, decimals_of(step));
}

}  // namespace

Ticks round_ticks(double low, double high, int wanted) {
  Ticks best;
  int best_miss = std::numeric_limits<int>::max();
  const double raw = (high - low) / std::max(wanted, 2);
  const double decade = std::floor(std::log10(raw)) - 1;
  for (int power = 0; power < 4; ++power) {
    for (double digit : {1.0, 2.0, 2.5, 5.0}) {
      const double step = digit * std::pow(10.0, decade + power);
      const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
      if (last - first > 50) continue;
      const int count = static_cast<int>(last - first) + 1;
      if (std::abs(count - wanted) >= best_miss) continue;
      best_miss = std::abs(count - wanted);
      best.step = step;
      best.values.clear();
      for (int i = 0; i < count; ++i) best.values.push_back((first + i) * step);
    }
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  for (double& value : best.values) {
    if (std::abs(value) < 1e-9 * best.step) value = 0;
    best.labels.push_back(tick_text(value, best.step, largest));
    value = std::clamp(value, low, high);
  }
  return best;
}

double round_length(double largest) {
  const double decade = std::pow(10.0, std::floor(std::log10(largest) + 1e-12));
  for (double digit : {5.0, 2.0})
    if (digit * decade <= largest * (1 + 1e-12)) return digit * decade;
  return decade;
}

std::string length_text(double metres) {
  struct Unit {
    double size;
    const char* name;
  };
  static constexpr Unit units[] = {{1, "m"}, {1e-3, "mm"}, {1e-6, "µm"}};
  const double size = std::abs(metres);
  const Unit& unit = size >= 0.9999995 ? units[0] : size >= 0.9999995e-4 || size == 0 ? units[1] : units[2];
  char text[64];
  std::snprintf(text, sizeof text, "%.4g %s", metres / unit.size, unit.name);
  return text;
}

}  // namespace tendril
