// Box, sphere, cylinder and half-space by exact formulas: signed distance with two derivatives, and rays.
//
// A solid is given in its own axes; whoever places it turns points into them. The distance is negative inside, where
// its gradient points the shortest way out. Outside it is continuously differentiable, as for any convex body; inside it
// has kinks where two ways out are equally short.
#pragma once

#include <optional>
#include <variant>

#include "base/vectors.h"

namespace tendril {

struct Box {
  Vec3 size;  ///< m, edge lengths; centred on the origin
};
struct Sphere {
  double radius;  ///< m; centred on the origin
};
struct Cylinder {
  double radius, length;  ///< m; along z, centred on the origin, with flat ends
};
/// Everything at z <= 0.
struct HalfSpace {};

using Solid = std::variant<Box, Sphere, Cylinder, HalfSpace>;

/// Throws UsageError, opening with `who`, for lengths that are not finite and positive.
void check(const Solid& solid, const char* who);

/// Signed distance (m), its gradient (unit, outwards), the surface point it is measured to, and its Hessian (1/m).
/// Where the gradient is not unique (the centre of a sphere, an axis) one direction is taken and the Hessian there is
/// zero.
struct SolidDistance {
  double distance;
  Vec3 normal;
  Vec3 point;
  Mat3 hessian;
};
SolidDistance distance_to(const Solid& solid, const Vec3& p);

/// Where the path a-b first enters the solid from outside: share 0 ... 1 of the way and the outward normal there.
/// A path that starts inside and leaves does not count.
struct SolidHit {
  double share;
  Vec3 normal;
};
std::optional<SolidHit> entry_into(const Solid& solid, const Vec3& a, const Vec3& b);

/// The box around the solid, m; infinite for a half-space.
Eigen::AlignedBox3d box_of(const Solid& solid);

}  // namespace tendril
