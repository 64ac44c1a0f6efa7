// Two circular arcs that join one place and tangent to another: what routes of the state lattice are made of.
//
// Of the one-parameter family the one with equal tangent lengths: from the start d along its tangent to the first vertex, 2 d to
// the second, d along the finish's tangent; the arcs fillet both vertices and meet in the middle between them.
#pragma once

#include <algorithm>
#include <optional>

#include "base/vectors.h"

namespace tendril::routing {

struct Biarc {
  Vec3 vertices[2];       ///< m
  double tangent = 0;     ///< d, m
  double turns[2] = {};   ///< rad
  double radii[2] = {};   ///< m; infinite without a turn
  double length = 0;      ///< m
  Vec3 finish_along = Vec3::Zero();  ///< unit

  double smallest_radius() const { return std::min(radii[0], radii[1]); }
  /// At a share 0 ... 1 of the length, from the start with that tangent.
  Vec3 at(double share, const Vec3& start, const Vec3& start_along) const;
};

/// Tangents are unit vectors. Nothing where the places coincide or an arc would turn by more than 150 degrees.
std::optional<Biarc> biarc(const Vec3& start, const Vec3& start_along, const Vec3& finish, const Vec3& finish_along);

}  // namespace tendril::routing
