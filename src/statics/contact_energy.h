// The contact energy at one point of a rod.
//
// Model: phi(d) = weight * k * delta^(5/2), delta = reach - d, where d is the distance to a primitive of the
// surroundings and reach = radius + shift (a Hertz-like law per length, thesis (2.7d)); beyond delta = knee it goes on
// as a parabola with the same value, slope and curvature, so that a deep start does not give huge stiffnesses.
// The energy of a point is the inclusion-exclusion sum of phi over the primitives in range. No friction.
#pragma once

#include <limits>
#include <span>

#include "statics/contact_field.h"

namespace tendril {

/// Energy per length of rod as a function of the overlap delta.
struct ContactLaw {
  double stiffness = 0;                                    ///< k, N / m^2.5
  double knee = std::numeric_limits<double>::infinity();   ///< delta_c, m

  /// Value, first and second derivative by delta; zero for delta <= 0.
  struct Value {
    double energy = 0, slope = 0, curvature = 0;
  };
  Value at(double delta) const;

  /// The law whose overlap is `softness` * radius under `force_per_length` (N/m); the knee lies at four times that.
  static ContactLaw for_overlap(double force_per_length, double radius, double softness);
};

/// Energy of one point and its derivatives by the point's position.
struct PointContact {
  double energy = 0;                 ///< J
  Vec3 gradient = Vec3::Zero();      ///< N; minus the force on the rod
  Mat3 material = Mat3::Zero();      ///< sum of phi'' n n^T, N/m
  Mat3 curvature = Mat3::Zero();     ///< sum of phi' Hess d, N/m; the true Hessian is material + curvature
  double distance = std::numeric_limits<double>::infinity();  ///< m, to the nearest of the terms
  Vec3 normal = Vec3::Zero();        ///< gradient of that distance
  int obstacle = -1;                 ///< that of the nearest term
};

/// Sums the terms at one point that stands for `length` (m) of rod and touches at the distance `reach` (m).
PointContact contact_at(std::span<const DistanceTerm> terms, double reach, double length, const ContactLaw& law);

}  // namespace tendril
