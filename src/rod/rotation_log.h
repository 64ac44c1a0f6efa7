// The logarithm of a relative rotation and the scalar functions of its angle that the rod elements need:
//   inverse left Jacobian   A(phi) = I - [phi]/2 + c [phi]^2,   c(u) = (1 - (t/2) cot(t/2)) / t^2,   u = t^2 = |phi|^2.
#pragma once

#include <cmath>

#include "rod/lanes.h"

namespace TENDRIL_LANES_NAMESPACE {

/// c and its first two derivatives with respect to u = t^2.
template <class T>
struct JacobianCoefficients {
  T c, c1, c2;
};

namespace detail {

// c(u) = sum |B_2k|/(2k)! u^(k-1): the Bernoulli numbers' series, used for u < 1 where it is exact to rounding.
inline constexpr double series[12] = {
    1.0 / 12,          1.0 / 720,           1.0 / 30240,          1.0 / 1209600,        1.0 / 47900160,
    691.0 / 1307674368000.0, 1.0 / 74724249600.0, 3617.0 / 10670622842880000.0, 43867.0 / 5109094217170944000.0,
    174611.0 / 802857662698291200000.0, 77683.0 / 14101100039391805440000.0, 236364091.0 / 1693824136731743669452800000.0};

template <class T>
inline JacobianCoefficients<T> jacobian_series(const T& u) {
  T c = filled<T>(series[11]), c1 = T{}, c2 = T{};
#pragma GCC unroll 11
  for (int k = 10; k >= 0; --k) {
    c2 = c2 * u + c1;
    c1 = c1 * u + c;
    c = c * u + series[k];
  }
  return {c, c1, c2 + c2};
}

/// For any angle above zero up to pi; half_cotangent = (t/2) cot(t/2).
inline JacobianCoefficients<double> jacobian_closed_form(double u, double half_cotangent) {
  const double h = half_cotangent;
  const double h1 = (h - h * h - 0.25 * u) / (2 * u);
  const double h2 = (h1 - 2 * h * h1 - 0.25) / (2 * u) - h1 / u;
  const double c = (1 - h) / u;
  const double c1 = (-h1 - c) / u;
  return {c, c1, (-h2 - 2 * c1) / u};
}

// atan(x)/x for |x| <= 0.26 as a series in x^2.
template <class T>
inline T arctangent_over_x(const T& xx) {
  T sum = filled<T>(-1.0 / 27);
#pragma GCC unroll 13
  for (int k = 12; k >= 0; --k) sum = sum * xx + (k % 2 == 0 ? 1.0 : -1.0) / (2 * k + 1);
  return sum;
}

}  // namespace detail

/// phi (rad, |phi| <= pi) with exp([phi]) = the rotation of the unit quaternion, and the coefficients at |phi|^2. What a
/// lane gets does not depend on the other lanes.
template <class T>
inline V3<T> rotation_log(Q4<T> p, JacobianCoefficients<T>& coefficients) {
  const T sign = p.w < 0 ? filled<T>(-1) : filled<T>(1);
  p.w *= sign;
  p.v = sign * p.v;
  const T sine_squared = dot(p.v, p.v);
  // By the tangent of a quarter of the angle: below 0.2553 (1 rad) both series are exact to rounding.
  const T over_one_more = filled<T>(1) / (filled<T>(1) + p.w);
  const T tangent_squared = sine_squared * over_one_more * over_one_more;
  constexpr double series_end = 0.0651;
  T scale = filled<T>(4) * over_one_more * detail::arctangent_over_x(tangent_squared);
  coefficients = detail::jacobian_series(scale * scale * sine_squared);
  if (largest_lane(tangent_squared) < series_end) return scale * p.v;
  for (int i = 0; i < lanes_of<T>; ++i) {
    if (!(lane(tangent_squared, i) >= series_end)) continue;
    const double sine = std::sqrt(lane(sine_squared, i)), w = lane(p.w, i);
    const double half = std::atan2(sine, w);
    lane(scale, i) = 2 * half / sine;
    const double u = 4 * half * half;
    const JacobianCoefficients<double> one =
        u < 1 ? detail::jacobian_series(u) : detail::jacobian_closed_form(u, half * w / sine);
    lane(coefficients.c, i) = one.c;
    lane(coefficients.c1, i) = one.c1;
    lane(coefficients.c2, i) = one.c2;
  }
  return scale * p.v;
}

/// A(phi) = I - [phi]/2 + c [phi]^2, the inverse left Jacobian; its transpose is the inverse right Jacobian.
template <class T>
inline M3<T> inverse_left_jacobian(const V3<T>& phi, const T& c) {
  const T half = filled<T>(0.5);
  const T diagonal = filled<T>(1) - c * dot(phi, phi);
  const V3<T> w = half * phi, s = c * phi;
  return {{diagonal + s.x * phi.x, s.x * phi.y + w.z, s.x * phi.z - w.y,
           s.x * phi.y - w.z, diagonal + s.y * phi.y, s.y * phi.z + w.x,
           s.x * phi.z + w.y, s.y * phi.z - w.x, diagonal + s.z * phi.z}};
}

/// The derivative with respect to phi of A(phi) a (sign = +1) or of A(phi)^T a (sign = -1) for a constant vector a.
template <class T>
inline M3<T> jacobian_derivative(const V3<T>& phi, const V3<T>& a, const JacobianCoefficients<T>& k, double sign) {
  const T along = dot(phi, a), u = dot(phi, phi), two = filled<T>(2);
  const V3<T> bend = along * phi - u * a;
  const V3<T> b = two * (k.c1 * bend - k.c * a);
  M3<T> d = plus_cross(outer(k.c * phi, a) + outer(b, phi), filled<T>(0.5 * sign) * a);
  add_to_diagonal(d, k.c * along);
  return d;
}

/// exp(-[t]) x: the components of a fixed vector after the axes have turned by t (|t| <= 1 rad, exact to 1e-14).
template <class T>
inline V3<T> turned_back(const V3<T>& t, const V3<T>& x) {
  const T u = dot(t, t);
  T sine = filled<T>(-1.0 / 39916800), cosine = filled<T>(1.0 / 479001600);  // of sin(t)/t and (1 - cos t)/t^2
  constexpr double sines[5] = {1, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880};
  constexpr double cosines[5] = {0.5, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800};
  cosine = -cosine;
#pragma GCC unroll 5
  for (int k = 4; k >= 0; --k) {
    sine = sine * u + sines[k];
    cosine = cosine * u + cosines[k];
  }
  const V3<T> once = cross(t, x);
  return x - sine * once + cosine * cross(t, once);
}

}  // namespace TENDRIL_LANES_NAMESPACE
