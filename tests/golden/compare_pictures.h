// Two pictures side by side, with a tolerance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tendril::golden {

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Throws UsageError for what is no PNG.
Pixels read_png(const std::string& bytes);
std::string write_png(const Pixels& pixels);

struct Difference {
  bool same_size = true;
  double mean = 0;   ///< of |difference| over all channels, 0 ... 255
  double share = 0;  ///< of pixels with a channel off by more than `visible`
  Pixels picture;    ///< the differences, five times as strong, on white

  static constexpr int visible = 24;
  /// Another processor may round a border pixel differently, but may not move a line or change a colour.
  bool fits() const { return same_size && mean <= 0.6 && share <= 0.003; }
};

Difference difference_of(const Pixels& wanted, const Pixels& got);

}  // namespace tendril::golden
