// What one state of a dress pack says to an engineer.
#pragma once

#include "method/dress_pack/pack_simulation.h"

namespace tendril::dress_pack {

/// Fills ends, rods and residual of a step from its state.
class PackReporter {
 public:
  explicit PackReporter(PackStatics& statics) : statics_(statics), rods_(statics.network().rods()) {}

  void report(PackStep& step);

  /// The same from a solution with contact.
  void report(const SystemEquilibrium& equilibrium, PackStep& step) const;

 private:
  PackStatics& statics_;
  std::vector<Equilibrium> rods_;
  std::vector<Vec6> gradient_;
};

}  // namespace tendril::dress_pack
