// How finely curved and flat faces are cut into triangles.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril::engine_bay {

struct Detail {
  double edge;   ///< mm: longest edge of a triangle's side along a face
  double turn;   ///< rad: largest turn from one facet of a fillet or circle to the next
  bool texture;  ///< fins, corrugations, dimples, knurls and small fillets are modelled, not only their envelope

  /// Equal pieces of a straight line.
  int steps(double length) const { return std::max(1, static_cast<int>(std::ceil(length / edge - 1e-9))); }

  /// Equal pieces of an arc.
  int steps(double radius, double angle) const {
    return std::max(static_cast<int>(std::ceil(std::abs(angle) / turn - 1e-9)), steps(radius * std::abs(angle)));
  }

  /// A full circle: at least six pieces, an even number; four for thin bars where texture is left out.
  int around(double radius) const {
    if (!texture && radius < 8) return 4;
    const int n = std::max(6, steps(radius, 2 * units::pi));
    return n + n % 2;
  }

  /// What a fillet of `radius` is in this detail: small ones stay sharp where texture is left out.
  double fillet(double radius) const { return texture || radius >= 10 ? radius : 0; }

  /// The same with edges of another length.
  Detail with_edge(double other) const { return {other, turn, texture}; }
};

/// About 1.2 million triangles in all, and about 20,000.
inline Detail fine() { return {10.0, 18 * units::deg, true}; }
inline Detail light() { return {150.0, 60 * units::deg, false}; }

}  // namespace tendril::engine_bay
