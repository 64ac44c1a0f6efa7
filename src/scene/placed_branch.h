// A rigid branch point of a harness: sections of several rods that move as one body.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"

namespace tendril {

class PlacedRod;

/// A section that belongs to a branch point. `relative`: its frame seen from the branch point's.
struct JoinedPlace {
  std::string rod;
  double at = 0;  ///< arc length, m
  Frame relative;
};

struct PlacedBranch {
  std::string name;
  std::vector<JoinedPlace> places;
  Frame frame;               ///< where it is held, or was drawn; the first place's section when nothing else is known
  bool position = false;     ///< held
  bool orientation = false;  ///< held

  bool joins(const std::string& rod, double at, double tolerance) const;
};

/// One place of a branch point as a user gives it; without `relative` that follows from the design.
struct BranchPlace {
  PlacedRod* rod = nullptr;
  double at = 0;
  std::optional<Frame> relative;
};

/// Makes the branch point. The relative frames are kept from the design: from where the rods are held at the joined places
/// now (those holds then end, the branch point takes their place). Where a section is not held, it carries on the first
/// section's direction when one of them ends and the other begins there, and meets it head-on otherwise.
/// Throws UsageError for fewer than one place, one named twice, and places outside their rods.
PlacedBranch make_branch(std::string name, const std::vector<BranchPlace>& places, const std::optional<Frame>& held);

}  // namespace tendril
