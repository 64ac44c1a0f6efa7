// What one state of a dress pack says to an engineer.
#pragma once

#include <optional>

#include "method/dress_pack/pack_gaps.h"
#include "method/dress_pack/pack_simulation.h"
#include "method/dress_pack/robot_gaps.h"

namespace tendril::dress_pack {

/// Fills ends, rods and residual of a step.
class PackReporter {
 public:
  /// `links`: also says how far the robot's links are from the fixed bodies.
  PackReporter(const PackBodies& bodies, bool links) : bodies_(bodies) {
    if (links) links_.emplace(bodies);
  }

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
  std::optional<RobotGaps> links_;
  RobotGaps::Memory link_memory_;
  std::vector<Equilibrium> rods_;
  std::vector<Vec6> gradient_;
};

}  // namespace tendril::dress_pack
