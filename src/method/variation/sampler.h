// Points of the unit cube, one for each outcome: what the variables' distributions are drawn with.
#pragma once

#include <cstdint>

#include "method/variation/options.h"

namespace tendril::variation {

/// Outcome k is point k / replicates of the independent set k mod replicates.
class Sampler {
 public:
  /// Throws UsageError for more dimensions than Sobol' points have, and for replicates that are not positive or more than half
  /// of the outcomes.
  Sampler(Sampling sampling, std::uint64_t seed, int dimensions, int outcomes, int replicates);

  /// Sets of points that are independent of each other; 1: all points are.
  int replicates() const { return sampling_ == Sampling::random ? 1 : replicates_; }

  /// In (0, 1).
  double at(int outcome, int dimension) const;

 private:
  double latin(int replicate, int point, int dimension) const;

  Sampling sampling_;
  std::uint64_t seed_;
  int outcomes_, replicates_;
};

/// Place of `index` in a random order of `count` things, without making the whole order.
std::uint32_t shuffled(std::uint32_t index, std::uint32_t count, std::uint64_t seed);

}  // namespace tendril::variation
