#include "method/variation/spreads.h"

#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "method/variation/distributions.h"

namespace tendril::variation {
namespace {

constexpr int quadrature_points = 512;

/// Mean of f over (0, 1).
template <class F>
double mean_of(const F& f) {
  double sum = 0;
  for (int i = 0; i < quadrature_points; ++i) sum += f((i + 0.5) / quadrature_points);
  return sum / quadrature_points;
}

/// Angle from the axis below which a share u of the cap's directions lies.
double angle_in_cap(double half_angle, double u) {
  const double sine = std::sin(0.5 * half_angle) * std::sqrt(u);  // 1 - cos = 2 sin^2 of the half
  return 2 * std::asin(std::min(1.0, sine));
}

}  // namespace

double ComponentSpread::at(double u) const {
  switch (kind) {
    case Spread::normal: return sigma * normal_quantile(u);
    case Spread::uniform: return tolerance * (2 * u - 1);
    case Spread::triangular: return tolerance * (u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)));
    case Spread::function: {
      const double value = (*inverse)(u);
      if (!std::isfinite(value))
        throw UsageError("method.variation: '" + name + "': the inverse distribution gave " + number_text(value) + " at " +
                         number_text(u) + ", expected a finite number");
      return scale * value;
    }
  }
  return 0;
}

double ComponentSpread::variance() const {
  switch (kind) {
    case Spread::normal: return sigma * sigma;
    case Spread::uniform: return tolerance * tolerance / 3;
    case Spread::triangular: return tolerance * tolerance / 6;
    case Spread::function: {
      double sum = 0, squares = 0;
      mean_of([&](double u) {
        const double x = at(u);
        sum += x;
        squares += x * x;
        return x;
      });
      const double mean = sum / quadrature_points;
      return std::max(0.0, squares / quadrature_points - mean * mean);
    }
  }
  return 0;
}

Vec3 in_ball(const ComponentSpread& spread, double u0, double u1, double u2) {
  if (spread.kind == Spread::normal) return {spread.at(u0), spread.at(u1), spread.at(u2)};
  const double radius = spread.tolerance * std::cbrt(u0), z = 2 * u1 - 1, turn = 2 * units::pi * u2;
  const double flat = std::sqrt(std::max(0.0, 1 - z * z));
  return radius * Vec3(flat * std::cos(turn), flat * std::sin(turn), z);
}

double ball_variance(const ComponentSpread& spread) {
  return spread.kind == Spread::normal ? spread.variance() : spread.tolerance * spread.tolerance / 5;
}

Eigen::Vector2d in_cone(const ComponentSpread& spread, double u0, double u1) {
  if (spread.kind == Spread::normal) return {spread.at(u0), spread.at(u1)};
  const double angle = angle_in_cap(spread.tolerance, u0), turn = 2 * units::pi * u1;
  return {angle * std::cos(turn), angle * std::sin(turn)};
}

double cone_variance(const ComponentSpread& spread) {
  if (spread.kind == Spread::normal) return spread.variance();
  return 0.5 * mean_of([&](double u) { return std::pow(angle_in_cap(spread.tolerance, u), 2); });
}

}  // namespace tendril::variation
