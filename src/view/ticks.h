// Round numbers for scales: 1, 2, 2.5 or 5 times a power of ten.
#pragma once

#include <string>
#include <vector>

namespace tendril {

struct Ticks {
  double step = 1;
  std::vector<double> values;       ///< ascending, all within low ... high
  std::vector<std::string> labels;  ///< just the digits that the step needs
};

/// About `wanted` ticks within low ... high (finite, low < high): the step whose count comes nearest.
Ticks round_ticks(double low, double high, int wanted = 5);

/// The largest 1, 2 or 5 times a power of ten that is at most `largest` (> 0).
double round_length(double largest);

/// A length in the unit that reads best: "250 mm", "2 m", "0.5 mm", "20 µm".
std::string length_text(double metres);

}  // namespace tendril
