// The fourth-order rod element between two section frames (r_a, R_a) and (r_b, R_b).
//
// Model. xi = (v, phi) = log of the relative motion, eps = xi/h its strain and curvature rates (e3 included). Along a
// segment without load the internal wrench is constant in space, so in the section's axes it changes by ad_eps^T W. To
// the order h^4 the energy of the true (not helical) path between the frames is
//     E = h/2 e^T C^-1 e,   e = eps - eps0,   C = K^-1 + q ad_eps K^-1 ad_eps^T,   q = h^2/12,
// which follows from minimising the energy over a linear variation of the strain with xi's Magnus expansion as the
// constraint; W = C^-1 e is the wrench at mid-segment. q = 0 gives the second-order element with constant strain.
// Where the reference rates vary by eps0' ds along the segment, e = A delta + q ad_eps delta' for the misfit's mean delta and
// slope delta', A = I - q ad_eps0', and K^-1 above becomes A K^-1 A^T, a constant of the segment. (At rest r' = d3, so eps0'
// is a change of the curvature alone.) Gradient and second derivative are exact. With M x = ad_x^T W, u = K^-1 M eps and J = q (ad_eps K^-1 M - ad_u):
//     dE/dxi = W + q M u,     d2E/dxi2 = ((I - J)^T C^-1 (I - J) + q M K^-1 M)/h.
// Not done: distributed load inside a segment (the weight's effect on stretch; relative size wL/EA), jumps of the
// reference strain or of its slope inside a segment.
//
// "Stress of the geometric terms": every term of the second derivative that is linear in W takes a wrench of its own, as
// mixed-stress Newton wants; with the true wrench the second derivative is that of E.
#pragma once

#include "rod/rotation_log.h"

namespace TENDRIL_LANES_NAMESPACE {

/// What a segment is: length h (m), q = h^2/12 or 0, flexibilities K^-1 by component, reference rates eps0 with e3.
template <class T>
struct Se3Segment {
  T h, q;
  V3<T> flexibility_v, flexibility_phi;  ///< 1/(GA1, GA2, EA) and 1/(EI1, EI2, GJ)
  V3<T> rate_v, rate_phi;
  V3<T> slope_phi{};    ///< d(reference curvature)/ds, 1/m^2; read only where `varies`
  bool varies = false;  ///< the reference curvature changes along the segment
};

/// Force-like pair: n (N) and m (N m), in the section's axes.
template <class T>
struct Wrench {
  V3<T> n, m;
};

template <class T>
struct Se3Ends {
  Q4<T> qa, qb;
  V3<T> ra, rb;
};

/// Gradient of the segment's energy: position of b (that of a is the opposite; world axes), rotations of a and b.
template <class T>
struct SegmentGradient {
  T energy;
  V3<T> force, theta_a, theta_b;
  Wrench<T> wrench;  ///< true wrench at mid-segment; where the reference varies, see strained_by
};

/// The wrench K delta that belongs to the misfit's mean delta = K^-1 A^T W: differs from the element's W where the
/// reference varies.
template <class T>
inline Wrench<T> strained_by(const Se3Segment<T>& s, const Wrench<T>& w) {
  if (!s.varies) return w;
  return {w.n + s.q * cross(s.slope_phi, w.n), w.m + s.q * cross(s.slope_phi, w.m)};
}

/// Second derivative in (d = r_b - r_a world axes, theta_a, theta_b); db: rows d, columns theta_b.
template <class T>
struct SegmentHessian {
  M3<T> dd, da, db, aa, ab, bb;
  V3<T> geometric_force;  ///< on d by the wrench of the geometric terms, world axes
};

namespace detail {

/// 6x6 in (v, phi) ordering.
template <class T>
struct M6 {
  T e[6][6];
  void set(int i, int j, const M3<T>& b) {
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) e[3 * i + r][3 * j + c] = b(r, c);
  }
  M3<T> get(int i, int j) const {
    M3<T> b;
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) b(r, c) = e[3 * i + r][3 * j + c];
    return b;
  }
};

/// L D L^T of a symmetric positive matrix, in place: unit lower triangle, the diagonal holds 1/D.
template <class T>
inline void factor(M6<T>& c) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    c.e[j][j] = filled<T>(1) / c.e[j][j];
    T column[6];
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      column[i] = c.e[i][j];
      c.e[i][j] *= c.e[j][j];
    }
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i)
#pragma GCC unroll 6
      for (int k = j + 1; k <= i; ++k) c.e[i][k] -= c.e[i][j] * column[k];
  }
}

/// L x = given.
template <class T>
inline void solve_lower(const M6<T>& l, T (&x)[6]) {
#pragma GCC unroll 6
  for (int i = 1; i < 6; ++i)
#pragma GCC unroll 6
    for (int k = 0; k < i; ++k) x[i] -= l.e[i][k] * x[k];
}

/// D L^T x = given.
template <class T>
inline void solve_upper(const M6<T>& l, T (&x)[6]) {
#pragma GCC unroll 6
  for (int i = 5; i >= 0; --i) {
    x[i] *= l.e[i][i];
#pragma GCC unroll 6
    for (int k = i + 1; k < 6; ++k) x[i] -= l.e[k][i] * x[k];
  }
}

/// B diag(flexibility) B^T with B = I - q [slope_phi]: one half of A K^-1 A^T.
template <class T>
inline M3<T> varied_flexibility(const Se3Segment<T>& s, const V3<T>& flexibility) {
  const M3<T> k = diagonal_matrix(flexibility), c = cross_matrix_of(s.slope_phi);
  const M3<T> kc = k * c;
  return k + s.q * (kc + transposed(kc)) - s.q * s.q * (c * kc);  // [x]^T = -[x]
}

}  // namespace detail

/// What turns a step into the linearised change of the wrench: C^-1 (I - J)/h dxi.
template <class T>
struct WrenchRate {
  M3<T> axes, a, g;      ///< R_a; A(phi); d(A d)/dphi
  V3<T> d;               ///< R_a^T (r_b - r_a)
  T per_length;          ///< 1/h
  detail::M6<T> l;       ///< factor of C
  detail::M6<T> reduced; ///< L^-1 (I - J)

  Wrench<T> change(const V3<T>& dr, const V3<T>& theta_a, const V3<T>& theta_b) const {
    const V3<T> dd = transposed_times(axes, dr) + cross(d, theta_a);
    const V3<T> dphi = transposed_times(a, theta_b) - a * theta_a;
    const V3<T> dv = a * dd + g * dphi;
    const T x[6] = {dv.x, dv.y, dv.z, dphi.x, dphi.y, dphi.z};
    T w[6];
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      T sum = reduced.e[i][0] * x[0];
#pragma GCC unroll 6
      for (int j = 1; j < 6; ++j) sum += reduced.e[i][j] * x[j];
      w[i] = per_length * sum;
    }
    solve_upper(l, w);
    return {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  }
};

namespace detail {

/// Strain state shared by gradient and second derivative.
template <class T>
struct Se3Strain {
  M3<T> axes, a, g;
  JacobianCoefficients<T> k;
  V3<T> phi, d, rate_v, rate_phi;
  M6<T> l;  ///< factor of C

  Se3Strain(const Se3Segment<T>& s, const Se3Ends<T>& x) {
    phi = rotation_log(conjugate_times(x.qa, x.qb), k);
    axes = rotation_matrix(x.qa);
    d = transposed_times(axes, x.rb - x.ra);
    a = inverse_left_jacobian(phi, k.c);
    const T per_length = filled<T>(1) / s.h;
    rate_v = per_length * (a * d);
    rate_phi = per_length * phi;
    // C = K^-1 - q [Phi kv Phi + V kp V, V kp Phi; Phi kp V, Phi kp Phi]: the cross matrices are antisymmetric.
    const M3<T> rest_v = s.varies ? varied_flexibility(s, s.flexibility_v) : diagonal_matrix(s.flexibility_v);
    const M3<T> rest_phi = s.varies ? varied_flexibility(s, s.flexibility_phi) : diagonal_matrix(s.flexibility_phi);
    const V3<T> kv = s.q * s.flexibility_v, kp = s.q * s.flexibility_phi;
    l.set(0, 0, rest_v - cross_diagonal_cross(rate_phi, kv, rate_phi) - cross_diagonal_cross(rate_v, kp, rate_v));
    l.set(1, 0, -cross_diagonal_cross(rate_phi, kp, rate_v));
    l.set(1, 1, rest_phi - cross_diagonal_cross(rate_phi, kp, rate_phi));
    factor(l);
  }

  Wrench<T> wrench(const Se3Segment<T>& s) const {
    const V3<T> ev = rate_v - s.rate_v, ep = rate_phi - s.rate_phi;
    T w[6] = {ev.x, ev.y, ev.z, ep.x, ep.y, ep.z};
    solve_lower(l, w);
    solve_upper(l, w);
    return {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  }
};

/// dE/dxi = W + q M u for a wrench W; also returns u.
template <class T>
inline Wrench<T> force_on_xi(const Se3Segment<T>& s, const T& q, const Se3Strain<T>& x, const Wrench<T>& w,
                             Wrench<T>& u) {
  u.n = times(s.flexibility_v, cross(w.n, x.rate_phi));
  u.m = times(s.flexibility_phi, cross(w.n, x.rate_v) + cross(w.m, x.rate_phi));
  return {w.n + q * cross(w.n, u.m), w.m + q * (cross(w.n, u.n) + cross(w.m, u.m))};
}

}  // namespace detail

/// Energy and gradient alone.
template <class T>
inline SegmentGradient<T> se3_gradient_of(const Se3Segment<T>& s, const detail::Se3Strain<T>& x) {
  SegmentGradient<T> out;
  const Wrench<T> w = out.wrench = x.wrench(s);
  const V3<T> ev = x.rate_v - s.rate_v, ep = x.rate_phi - s.rate_phi;
  out.energy = filled<T>(0.5) * s.h * (dot(ev, w.n) + dot(ep, w.m));
  Wrench<T> u;
  const Wrench<T> g = detail::force_on_xi(s, s.q, x, w, u);
  const V3<T> f = transposed_times(x.a, g.n);
  const V3<T> m = transposed_times(x.g, g.n) + g.m;
  out.force = x.axes * f;
  out.theta_a = -transposed_times(x.a, m) - cross(x.d, f);
  out.theta_b = x.a * m;
  return out;
}

template <class T>
inline SegmentGradient<T> se3_gradient(const Se3Segment<T>& s, const Se3Ends<T>& ends) {
  detail::Se3Strain<T> x(s, ends);
  x.g = jacobian_derivative(x.phi, x.d, x.k, 1);
  return se3_gradient_of(s, x);
}

/// The second derivative in (v, phi), and L^-1 (I - J), with the geometric terms' wrench w.
template <class T>
inline void se3_curvature_on_xi(const Se3Segment<T>& s, const detail::Se3Strain<T>& x, const Wrench<T>& w,
                                const Wrench<T>& u, detail::M6<T>& hessian, detail::M6<T>& z) {
  using namespace detail;
  const V3<T> kv = s.q * s.flexibility_v, kp = s.q * s.flexibility_phi, un = s.q * u.n, um = s.q * u.m;
  // J = q (ad_eps K^-1 M - ad_u) with M = [0 n; n m], ad = [Phi V; 0 Phi].
  const M3<T> one = diagonal_matrix(V3<T>{filled<T>(1), filled<T>(1), filled<T>(1)});
  z.set(0, 0, plus_cross(one - cross_diagonal_cross(x.rate_v, kp, w.n), um));
  z.set(0, 1, plus_cross(-(cross_diagonal_cross(x.rate_phi, kv, w.n) + cross_diagonal_cross(x.rate_v, kp, w.m)), un));
  z.set(1, 0, -cross_diagonal_cross(x.rate_phi, kp, w.n));
  z.set(1, 1, plus_cross(one - cross_diagonal_cross(x.rate_phi, kp, w.m), um));
  const T per_length = filled<T>(1) / s.h;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    T column[6];
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) column[i] = z.e[i][j];
    solve_lower(x.l, column);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) z.e[i][j] = column[i];
  }
  const V3<T> hv = per_length * kv, hp = per_length * kp;
  hessian.set(0, 0, cross_diagonal_cross(w.n, hp, w.n));
  hessian.set(1, 0, transposed(cross_diagonal_cross(w.n, hp, w.m)));
  hessian.set(1, 1, cross_diagonal_cross(w.n, hv, w.n) + cross_diagonal_cross(w.m, hp, w.m));
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const T weight = per_length * x.l.e[k][k];
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      const T scaled = weight * z.e[k][i];
#pragma GCC unroll 6
      for (int j = 0; j <= i; ++j) hessian.e[i][j] += scaled * z.e[k][j];
    }
  }
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i)
#pragma GCC unroll 6
    for (int j = 0; j < i; ++j) hessian.e[j][i] = hessian.e[i][j];
}

/// Second derivatives of v = A(phi) d contracted with a force g, in (d, phi): rows d columns phi, and phi phi.
template <class T>
inline M3<T> second_derivative_of_v(const V3<T>& phi, const V3<T>& d, const V3<T>& g, const JacobianCoefficients<T>& k) {
  const T two = filled<T>(2);
  const T pd = dot(phi, d), pg = dot(phi, g), dg = dot(d, g), u = dot(phi, phi);
  const T value = pd * pg - u * dg;
  const V3<T> slope = pg * d + pd * g - two * dg * phi;
  const V3<T> t = two * (k.c1 * slope + k.c2 * value * phi), e = k.c * d;
  M3<T> f = outer(phi, t) + outer(e, g);
  f = f + transposed(f);
  add_to_diagonal(f, two * (k.c1 * value - k.c * dg));
  return f;
}

/// The second-order element's gradient with the fourth-order correction taken from a wrench w that is given: a change of
/// the reference rates by q ad_eps u and a force q M u. With w the segment's own wrench this is the fourth-order gradient.
template <class T>
inline SegmentGradient<T> se3_deferred_gradient(const Se3Segment<T>& s, const T& q, const detail::Se3Strain<T>& x,
                                                const Wrench<T>& w) {
  Wrench<T> u;
  const Wrench<T> with_w = detail::force_on_xi(s, q, x, w, u);
  Se3Segment<T> shifted = s;
  shifted.rate_v = s.rate_v + q * (cross(x.rate_phi, u.n) + cross(x.rate_v, u.m));
  shifted.rate_phi = s.rate_phi + q * cross(x.rate_phi, u.m);
  if (s.varies) {
    Se3Segment<T> corrected = s;
    corrected.q = q;
    const M3<T> v = detail::varied_flexibility(corrected, s.flexibility_v) - diagonal_matrix(s.flexibility_v);
    const M3<T> phi = detail::varied_flexibility(corrected, s.flexibility_phi) - diagonal_matrix(s.flexibility_phi);
    shifted.rate_v = shifted.rate_v + v * w.n;
    shifted.rate_phi = shifted.rate_phi + phi * w.m;
  }
  SegmentGradient<T> out = se3_gradient_of(shifted, x);
  const V3<T> n = with_w.n - w.n;
  const V3<T> f = transposed_times(x.a, n);
  const V3<T> m = transposed_times(x.g, n) + (with_w.m - w.m);
  out.force = out.force + x.axes * f;
  out.theta_a = out.theta_a - transposed_times(x.a, m) - cross(x.d, f);
  out.theta_b = out.theta_b + x.a * m;
  return out;
}

/// Energy, gradient, second derivative and wrench rate. `stress`: the wrench of the geometric terms. `deferred`: null, or
/// the q of a correction that is taken from `stress` and not differentiated; s.q is then zero and the energy is not used.
template <class T>
inline SegmentGradient<T> se3_element(const Se3Segment<T>& s, const Se3Ends<T>& ends, const Wrench<T>* stress,
                                      SegmentHessian<T>& out, WrenchRate<T>& rate, const T* deferred = nullptr) {
  detail::Se3Strain<T> x(s, ends);
  x.g = jacobian_derivative(x.phi, x.d, x.k, 1);
  const SegmentGradient<T> gradient =
      deferred ? se3_deferred_gradient(s, *deferred, x, *stress) : se3_gradient_of(s, x);
  const Wrench<T> w = stress ? *stress : gradient.wrench;
  Wrench<T> u;
  const Wrench<T> g = detail::force_on_xi(s, s.q, x, w, u);
  const V3<T> f = transposed_times(x.a, g.n);
  const V3<T> m = transposed_times(x.g, g.n) + g.m;
  rate.axes = x.axes;
  rate.a = x.a;
  rate.g = x.g;
  rate.d = x.d;
  rate.per_length = filled<T>(1) / s.h;
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i)
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j) rate.l.e[i][j] = x.l.e[i][j];
  detail::M6<T> xi;
  se3_curvature_on_xi(s, x, w, u, xi, rate.reduced);

  // From (v, phi) to (d, phi).
  const M3<T> vv = xi.get(0, 0), vp = xi.get(0, 1), pp = xi.get(1, 1);
  const M3<T> vvg = vv * x.g + vp;
  const M3<T> h_dd = symmetric_product(x.a, vv * x.a);
  const M3<T> h_dp = transposed_times(x.a, vvg) + jacobian_derivative(x.phi, g.n, x.k, -1);
  const M3<T> h_pp = transposed_times(x.g, vvg) + transposed_times(vp, x.g) + pp +
                     second_derivative_of_v(x.phi, x.d, g.n, x.k);

  // From (d, phi) to the ends: dd = R_a^T (dr_b - dr_a) + [d] theta_a, dphi = A^T theta_b - A theta_a; A^T = A + [phi].
  const M3<T> h_dp_a = h_dp * x.a, h_dp_b = h_dp_a + times_cross(h_dp, x.phi);
  const M3<T> h_pp_a = h_pp * x.a, h_pp_b = h_pp_a + times_cross(h_pp, x.phi);
  const M3<T> derivative_a = jacobian_derivative(x.phi, m, x.k, 1) * x.a;
  const M3<T> derivative_b = derivative_a + times_cross(jacobian_derivative(x.phi, m, x.k, 1), x.phi);
  const M3<T> dd_d = times_cross(h_dd, x.d);
  const M3<T> h_da = plus_cross(dd_d - h_dp_a, -f);
  const M3<T> d_dp_a = cross_times(x.d, h_dp_a - filled<T>(0.5) * dd_d);  // [d]^T = -[d]
  const T fd = dot(f, x.d);
  M3<T> aa = d_dp_a + d_dp_a + outer(f, x.d) + derivative_a - cross_times(m, x.a);
  add_to_diagonal(aa, -fd);
  out.aa = symmetric_product(x.a, h_pp_a) + symmetric_part(aa);
  out.ab = -cross_times(x.d, h_dp_b) - transposed_times(x.a, h_pp_b) - transposed(derivative_a);
  out.bb = symmetric_product(transposed(x.a), h_pp_b) + symmetric_part(derivative_b);
  const M3<T> axes_t = transposed(x.axes);
  out.dd = symmetric_product(axes_t, h_dd * axes_t);
  out.da = x.axes * h_da;
  out.db = x.axes * h_dp_b;
  out.geometric_force = x.axes * f;
  return gradient;
}

}  // namespace TENDRIL_LANES_NAMESPACE
