// How an SE(3) segment's gradient and wrench change with what the segment is: its length, flexibilities and reference
// rates. The ends' frames, and so xi, stay.
//
// From the element's energy E = h/2 e^T C^-1 e (se3_element.h), with U = ad_eps^T W = M eps and u = K^-1 U:
//     dE/d(1/K_i) = -h/2 (W_i^2 + q U_i^2),   dE/d eps0 = -h W,   dE/dh = W.(e/2 - eps);
// q ad_eps K^-1 ad_eps^T = ad_xi K^-1 ad_xi^T / 12 does not depend on h. Their derivatives along a step of the ends are
// those of the step's work, step . gradient: what an adjoint state asks for, in one pass for all parameters. The wrench
// obeys C dW = de - dC W, and a function F(W, eps) is pulled back by y = C^-1 dF/dW:
//     dF = (y + q (M_y u + M K^-1 M_y eps)) . deps - y . deps0 - sum_i (y_i W_i + q (M_y eps)_i U_i) d(1/K_i).
// Where the reference curvature varies along the segment, A^T W and A^T y stand for W and y in the terms with d(1/K_i); A
// depends on q times the curvature's slope alone, which is a turn: it stays too when the length changes.
#pragma once

#include "rod/se3_element.h"

namespace tendril {

/// Changes of a segment's parameters, or the derivatives by them.
template <class T>
struct Se3Parameters {
  T h;
  V3<T> flexibility_v, flexibility_phi;
  V3<T> rate_v, rate_phi;
};

/// A step of the segment's ends: dr = dr_b - dr_a in world axes, rotations in the sections' own axes.
template <class T>
struct Se3Step {
  V3<T> dr, theta_a, theta_b;
};

namespace detail {

template <class T>
inline Wrench<T> operator+(const Wrench<T>& a, const Wrench<T>& b) { return {a.n + b.n, a.m + b.m}; }
template <class T>
inline Wrench<T> operator-(const Wrench<T>& a, const Wrench<T>& b) { return {a.n - b.n, a.m - b.m}; }
template <class T>
inline Wrench<T> operator*(const T& s, const Wrench<T>& a) { return {s * a.n, s * a.m}; }
template <class T>
inline T dot(const Wrench<T>& a, const Wrench<T>& b) { return tendril::dot(a.n, b.n) + tendril::dot(a.m, b.m); }
template <class T>
inline Wrench<T> times(const Wrench<T>& a, const Wrench<T>& b) {
  return {tendril::times(a.n, b.n), tendril::times(a.m, b.m)};
}

/// M_w x = ad_x^T w; antisymmetric in its two 6-vectors' roles: y . M_w x = -x . M_w y.
template <class T>
inline Wrench<T> coadjoint(const Wrench<T>& w, const Wrench<T>& x) {
  return {cross(w.n, x.m), cross(w.n, x.n) + cross(w.m, x.m)};
}

/// ad_x y.
template <class T>
inline Wrench<T> adjoint(const Wrench<T>& x, const Wrench<T>& y) {
  return {cross(x.m, y.n) + cross(x.n, y.m), cross(x.m, y.m)};
}

}  // namespace detail

/// One segment at one state. All derivatives are exact.
template <class T>
class Se3Slopes {
 public:
  Se3Slopes(const Se3Segment<T>& s, const Se3Ends<T>& ends)
      : h_(s.h), q_(s.q), segment_(s), x_(s, ends), flexibility_{s.flexibility_v, s.flexibility_phi} {
    x_.g = jacobian_derivative(x_.phi, x_.d, x_.k, 1);
    w_ = x_.wrench(s);
    strained_ = strained_by(s, w_);
    rate_ = {x_.rate_v, x_.rate_phi};
    e_ = {x_.rate_v - s.rate_v, x_.rate_phi - s.rate_phi};
    U_ = detail::coadjoint(w_, rate_);
    u_ = detail::times(flexibility_, U_);
  }

  const Wrench<T>& wrench() const { return strained_; }  ///< K times the misfit's mean: A^T W
  const Wrench<T>& rate() const { return rate_; }        ///< eps: v and phi over h, e3 included
  Wrench<T> variation() const { return detail::coadjoint(strained_, rate_); }  ///< its change along the segment

  /// Gradient by the position of the far end: the internal force, in world axes.
  V3<T> force() const {
    return x_.axes * transposed_times(x_.a, w_.n + q_ * cross(w_.n, u_.m));
  }

  /// Derivatives of step . gradient by the parameters.
  Se3Parameters<T> of_work(const Se3Step<T>& step) const {
    using namespace detail;
    const Wrench<T> rate = change_of_rate(step);
    const Wrench<T> bent = adjoint(rate, u_) + adjoint(rate_, times(flexibility_, coadjoint(w_, rate)));
    const Wrench<T> w = inverse_c(rate - q_ * bent);
    const Wrench<T> U = coadjoint(w, rate_) + coadjoint(w_, rate);
    const Wrench<T> flexibility = times(strained_, strained_by(segment_, w)) + q_ * times(U_, U);
    const T half = filled<T>(0.5);
    return {dot(half * e_ - rate_, w) - half * dot(w_, rate), -(h_ * flexibility.n), -(h_ * flexibility.m),
            -(h_ * w.n), -(h_ * w.m)};
  }

  /// Change of the gradient (energy and wrench with it) to first order when the parameters change by `change`.
  SegmentGradient<T> change_of_gradient(const Se3Parameters<T>& change) const {
    using namespace detail;
    const Wrench<T> flexibility{change.flexibility_v, change.flexibility_phi}, reference{change.rate_v, change.rate_phi};
    const T growth = change.h / h_;
    const Wrench<T> kU = times(flexibility, U_);
    SegmentGradient<T> out;
    out.wrench = inverse_c(-growth * rate_ - reference - spread(times(flexibility, strained_)) - q_ * adjoint(rate_, kU));
    const Wrench<T> u = kU + times(flexibility_, coadjoint(out.wrench, rate_));
    out.energy = change.h * dot(filled<T>(0.5) * e_ - rate_, w_) - h_ * dot(reference, w_) -
                 filled<T>(0.5) * h_ * (dot(flexibility, times(strained_, strained_)) + q_ * dot(U_, kU));
    to_ends(out.wrench + q_ * (growth * coadjoint(w_, u_) + coadjoint(out.wrench, u_) + coadjoint(w_, u)), out);
    return out;
  }

  /// Of a function F(wrench(), eps) whose partial derivatives are given: the derivatives by the ends, and by the
  /// parameters through both.
  void pull_back(const Wrench<T>& by_wrench, const Wrench<T>& by_rate, SegmentGradient<T>& ends,
                 Se3Parameters<T>& parameters) const {
    using namespace detail;
    const Wrench<T> y = inverse_c(spread(by_wrench));
    const Wrench<T> U = coadjoint(y, rate_);
    const Wrench<T> turned = coadjoint(y, u_) + coadjoint(w_, times(flexibility_, U));
    const T per_length = filled<T>(1) / h_;
    to_ends(per_length * (y + q_ * turned + by_rate), ends);
    ends.energy = T{};
    ends.wrench = Wrench<T>{};
    const Wrench<T> flexibility = times(strained_by(segment_, y), strained_) + q_ * times(U, U_);
    parameters = {-(per_length * dot(y + by_rate, rate_)), -flexibility.n, -flexibility.m, -y.n, -y.m};
  }

 private:
  Wrench<T> inverse_c(const Wrench<T>& x) const {
    T c[6] = {x.n.x, x.n.y, x.n.z, x.m.x, x.m.y, x.m.z};
    detail::solve_lower(x_.l, c);
    detail::solve_upper(x_.l, c);
    return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
  }

  /// A x: what a misfit of the strain is in xi's rate where the reference curvature varies.
  Wrench<T> spread(const Wrench<T>& x) const {
    if (!segment_.varies) return x;
    return {x.n - q_ * cross(segment_.slope_phi, x.n), x.m - q_ * cross(segment_.slope_phi, x.m)};
  }

  Wrench<T> change_of_rate(const Se3Step<T>& step) const {
    const V3<T> dd = transposed_times(x_.axes, step.dr) + cross(x_.d, step.theta_a);
    const V3<T> dphi = transposed_times(x_.a, step.theta_b) - x_.a * step.theta_a;
    const T per_length = filled<T>(1) / h_;
    return {per_length * (x_.a * dd + x_.g * dphi), per_length * dphi};
  }

  /// What a force on xi is on the ends.
  void to_ends(const Wrench<T>& g, SegmentGradient<T>& out) const {
    const V3<T> f = transposed_times(x_.a, g.n);
    const V3<T> m = transposed_times(x_.g, g.n) + g.m;
    out.force = x_.axes * f;
    out.theta_a = -transposed_times(x_.a, m) - cross(x_.d, f);
    out.theta_b = x_.a * m;
  }

  T h_, q_;
  Se3Segment<T> segment_;
  detail::Se3Strain<T> x_;
  Wrench<T> flexibility_, w_, strained_, rate_, e_, U_, u_;
};

}  // namespace tendril
