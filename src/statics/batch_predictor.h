// Where an outcome's equilibrium will be, to first order: the nominal equilibrium's derivatives by every number of the
// problem, from the kernel's own linearised step for a tiny change of that number.
#pragma once

#include <vector>

#include "statics/batch_layout.h"

namespace tendril {

class BatchPredictor {
 public:
  BatchPredictor() = default;

  /// From the nominal equilibrium: numbers, node frames, wrenches. `varies`: which of the numbers do; empty: all of them. A
  /// change of another number is not seen.
  BatchPredictor(const BatchLayout& layout, const BatchKernel& kernel, const std::vector<double>& parameters,
                 const std::vector<double>& frames, const std::vector<double>& wrenches,
                 const std::vector<char>& varies = {});

  /// Frames and wrenches for an outcome's numbers. `scratch` is kept from call to call. Returns the largest rotation (rad)
  /// or move over the length; where that is more than `too_far` the nominal state stays.
  double predict(const std::vector<double>& parameters, std::vector<double>& frames, std::vector<double>& wrenches,
                 std::vector<double>& scratch) const;

  static constexpr double too_far = 1;

 private:
  /// One column: the change of node frames (position, rotation vector) and wrenches by a unit of one number.
  struct Column {
    int offset;  ///< of the number, or of the quaternion
    int axis;    ///< of a rotation, in the frame's own axes; -1: a plain number
  };

  int nodes_ = 0, rows_ = 0;
  double length_ = 1;
  std::vector<double> parameters_, frames_, wrenches_;  ///< nominal
  std::vector<Column> columns_;
  std::vector<double> slopes_;  ///< rows_ numbers a column
};

}  // namespace tendril
