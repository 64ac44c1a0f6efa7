// What one state of a dress pack says to an engineer.
#pragma once

#include <optional>

#include "method/dress_pack/pack_gaps.h"
#include "method/dress_pack/pack_simulation.h"

namespace tendril::dress_pack {

/// Fills ends, rods and residual of a step.
class PackReporter {
 public:
  explicit PackReporter(const PackBodies& bodies) : bodies_(bodies) {}

  /// From its state, of a pack that touches nothing.
  void report(PackStatics& statics, PackStep& step);

  /// From a solution with contact.
  void report(const SystemEquilibrium& equilibrium, PackStep& step);

 private:
  void add_clearances(const PackGaps& gaps, PackStep& step);

  const PackBodies& bodies_;
  std::optional<PackGaps> gaps_;
  PackGaps::Memory memory_;
  PackPlaces places_;
  std::vector<Equilibrium> rods_;
  std::vector<Vec6> gradient_;
};

}  // namespace tendril::dress_pack
