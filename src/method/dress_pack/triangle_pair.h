// The closest points of two triangles.
#pragma once

#include "base/vectors.h"

namespace tendril::dress_pack {

/// The nearest points; distance 0 where the triangles meet.
struct TrianglePair {
  double distance = 0;  ///< m
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
};
TrianglePair closest_of_triangles(const Vec3 (&a)[3], const Vec3 (&b)[3]);

}  // namespace tendril::dress_pack
