// Sections along a centre line that turn about its tangent no more than they must.
#pragma once

#include <vector>

#include "harness/centre_line.h"

namespace tendril {

/// Rotation-minimising frames by double reflection (Wang, Juettler, Zheng, Liu, Computation of rotation minimizing frames, 2008)
/// between 24 places of each of the line's pieces. The first is Frame::looking along the first tangent.
class LineFrames {
 public:
  explicit LineFrames(CentreLine line);

  const CentreLine& line() const { return line_; }
  /// At an arc length (m), within 0 ... the line's length.
  Frame at(double s) const;
  const Frame& start() const { return frames_.front(); }
  const Frame& finish() const { return frames_.back(); }

 private:
  CentreLine line_;
  std::vector<double> s_;
  std::vector<Frame> frames_;
};

}  // namespace tendril
