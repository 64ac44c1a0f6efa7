// A rigid motion that was measured or simulated elsewhere: frames of a body over time, as an engine on its mounts has them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/frame.h"

namespace tendril {

struct SampledMotion {
  std::vector<double> times;  ///< s, rising
  std::vector<Frame> frames;  ///< of the body, world axes

  /// Straight between the samples, turning evenly; held before the first and after the last.
  Frame at(double time) const;
  /// The frames of a place that moves with the body and is at `place` in the first sample.
  std::vector<Frame> carried(const Frame& place) const;
};

/// Comma- or semicolon-separated text with a head line that names its columns: t (s); x, y, z (lengths in `unit` metres);
/// and, unless the body does not turn, qw, qx, qy, qz (a quaternion) or rx, ry, rz (a rotation vector, rad). Other columns are left
/// out; lines that are empty or begin with # too. Throws UsageError naming `who` and the line for anything else.
SampledMotion parse_motion(std::string_view text, double unit, const std::string& who);

/// The same from a file.
SampledMotion read_motion(const std::string& path, double unit);

}  // namespace tendril
