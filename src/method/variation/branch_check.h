// Whether an outcome's equilibrium belongs to the nominal one's branch: a first-order prediction to compare it with.
#pragma once

#include <span>
#include <vector>

#include "base/vectors.h"

namespace tendril::variation {

/// Positions of the vertices of one system's rods that are compared, one after the other.
using Positions = std::vector<Vec3>;

class BranchCheck {
 public:
  BranchCheck() = default;
  /// `by_unit`: by column, how far a unit of it moves the vertices; empty where that is not known: no move is expected then.
  /// `lengths`: of each vertex's rod, m.
  BranchCheck(Positions nominal, std::vector<double> nominal_values, std::vector<Positions> by_unit, std::vector<double> lengths);

  /// False when no vertex is farther from its prediction than a quarter of the largest predicted move plus 2 % of its rod's
  /// length: then the rods have not snapped, or by no more than that. `half_way`: where the vertices are with all columns half
  /// way from their nominal values, for a prediction of the second order.
  bool suspicious(std::span<const double> values, const Positions& at, const Positions* half_way = nullptr) const;

 private:
  Positions nominal_;
  std::vector<double> nominal_values_;
  std::vector<Positions> by_unit_;
  std::vector<double> lengths_;
};

}  // namespace tendril::variation
