// What is read off a rod of a batch without solving anything again: forces, curvatures and strains of its segments.
#pragma once

#include <vector>

#include "statics/batch.h"

namespace tendril::variation {

/// Reads the rods of one batch's outcomes, one outcome after the other. For one thread.
class RodReader {
 public:
  explicit RodReader(const Batch& batch);

  /// The outcome to read from now on, and its problem as the batch solved it.
  void stand_at(const BatchResults& results, int outcome, const SystemProblem& problem);

  /// A rod with arc lengths, points, rotations and reactions; `stress`: also forces, moments, strains and curvatures of its
  /// segments. Valid until the next outcome.
  const Equilibrium& rod(int rod, bool stress);

 private:
  void read_shape(int rod, Equilibrium& out);
  void read_stress(int rod, Equilibrium& out);

  const Batch& batch_;
  const BatchResults* results_ = nullptr;
  const SystemProblem* problem_ = nullptr;
  int outcome_ = 0;
  bool numbers_read_ = false;
  std::vector<double> numbers_;
  std::vector<std::vector<BatchLayout::SegmentPlace>> places_;  ///< by rod
  std::vector<Equilibrium> rods_;
  std::vector<char> has_shape_, has_stress_;
};

}  // namespace tendril::variation
