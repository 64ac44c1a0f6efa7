// How numbers and small vectors spread about zero, drawn from uniform numbers.
#pragma once

#include <functional>

#include "base/vectors.h"
#include "method/variation/options.h"

namespace tendril::variation {

/// The spread of one component.
struct ComponentSpread {
  Spread kind = Spread::normal;
  double tolerance = 0, sigma = 0;
  double scale = 1;                               ///< of the function's values
  const std::function<double(double)>* inverse = nullptr;
  std::string name;                               ///< for messages

  /// Deviation from the nominal value below which a share u of all outcomes lies. Throws UsageError where a function's value is
  /// not a finite number.
  double at(double u) const;
  double variance() const;
};

/// Uniform in a ball, or normal in each component.
Vec3 in_ball(const ComponentSpread& spread, double u0, double u1, double u2);
double ball_variance(const ComponentSpread& spread);  ///< of each component

/// A tilt (two components of a rotation vector, rad): directions uniform over the cap of the half angle `tolerance`, or normal in
/// each component.
Eigen::Vector2d in_cone(const ComponentSpread& spread, double u0, double u1);
double cone_variance(const ComponentSpread& spread);

}  // namespace tendril::variation
