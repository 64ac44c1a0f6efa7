// Small fixed-size algebra over a scalar type T that is either one double or a SIMD pack of doubles, so that one element
// formula serves single segments and several segments at once.
#pragma once

#include <cmath>

// Code that is compiled for another instruction set than the rest of the program takes these headers into a namespace of
// its own: else the linker might keep that code's copy of an inline function for all.
#ifndef TENDRIL_LANES_NAMESPACE
#define TENDRIL_LANES_NAMESPACE tendril
#endif

namespace TENDRIL_LANES_NAMESPACE {

/// Four doubles, or eight, that are worked on at once.
using Pack = double __attribute__((vector_size(32)));
using WidePack = double __attribute__((vector_size(64)));

template <class T>
inline constexpr int lanes_of = sizeof(T) / sizeof(double);

inline double& lane(double& value, int) { return value; }
inline double lane(const double& value, int) { return value; }
inline double& lane(Pack& value, int i) { return reinterpret_cast<double*>(&value)[i]; }
inline double lane(const Pack& value, int i) { return value[i]; }
inline double& lane(WidePack& value, int i) { return reinterpret_cast<double*>(&value)[i]; }
inline double lane(const WidePack& value, int i) { return value[i]; }

template <class T>
inline T filled(double value) {
  return T{} + value;
}

template <class T>
inline double largest_lane(const T& value) {
  double largest = lane(value, 0);
  for (int i = 1; i < lanes_of<T>; ++i) largest = lane(value, i) > largest ? lane(value, i) : largest;
  return largest;
}

template <class T>
struct V3 {
  T x, y, z;
  T& operator[](int i) { return (&x)[i]; }
  const T& operator[](int i) const { return (&x)[i]; }
};

template <class T>
inline V3<T> operator+(const V3<T>& a, const V3<T>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T>
inline V3<T> operator-(const V3<T>& a, const V3<T>& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T>
inline V3<T> operator*(const T& s, const V3<T>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <class T>
inline V3<T> operator-(const V3<T>& a) { return {-a.x, -a.y, -a.z}; }
template <class T>
inline T dot(const V3<T>& a, const V3<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
inline V3<T> cross(const V3<T>& a, const V3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Entry by entry.
template <class T>
inline V3<T> times(const V3<T>& a, const V3<T>& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// 3x3, row by row.
template <class T>
struct M3 {
  T e[9];
  T& operator()(int i, int j) { return e[3 * i + j]; }
  const T& operator()(int i, int j) const { return e[3 * i + j]; }
};

template <class T>
inline M3<T> operator+(const M3<T>& a, const M3<T>& b) {
  M3<T> r;
#pragma GCC unroll 9
  for (int i = 0; i < 9; ++i) r.e[i] = a.e[i] + b.e[i];
  return r;
}
template <class T>
inline M3<T> operator-(const M3<T>& a, const M3<T>& b) {
  M3<T> r;
#pragma GCC unroll 9
  for (int i = 0; i < 9; ++i) r.e[i] = a.e[i] - b.e[i];
  return r;
}
template <class T>
inline M3<T> operator-(const M3<T>& a) {
  M3<T> r;
#pragma GCC unroll 9
  for (int i = 0; i < 9; ++i) r.e[i] = -a.e[i];
  return r;
}
template <class T>
inline M3<T> operator*(const T& s, const M3<T>& a) {
  M3<T> r;
#pragma GCC unroll 9
  for (int i = 0; i < 9; ++i) r.e[i] = s * a.e[i];
  return r;
}
template <class T>
inline M3<T> operator*(const M3<T>& a, const M3<T>& b) {
  M3<T> r;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return r;
}
template <class T>
inline V3<T> operator*(const M3<T>& a, const V3<T>& v) {
  return {a(0, 0) * v.x + a(0, 1) * v.y + a(0, 2) * v.z, a(1, 0) * v.x + a(1, 1) * v.y + a(1, 2) * v.z,
          a(2, 0) * v.x + a(2, 1) * v.y + a(2, 2) * v.z};
}
template <class T>
inline M3<T> transposed(const M3<T>& a) {
  return {{a.e[0], a.e[3], a.e[6], a.e[1], a.e[4], a.e[7], a.e[2], a.e[5], a.e[8]}};
}
template <class T>
inline V3<T> transposed_times(const M3<T>& a, const V3<T>& v) {
  return {a(0, 0) * v.x + a(1, 0) * v.y + a(2, 0) * v.z, a(0, 1) * v.x + a(1, 1) * v.y + a(2, 1) * v.z,
          a(0, 2) * v.x + a(1, 2) * v.y + a(2, 2) * v.z};
}
template <class T>
inline M3<T> outer(const V3<T>& a, const V3<T>& b) {
  return {{a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y, a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z}};
}
template <class T>
inline M3<T> cross_matrix_of(const V3<T>& v) {
  const T o{};
  return {{o, -v.z, v.y, v.z, o, -v.x, -v.y, v.x, o}};
}
template <class T>
inline M3<T> symmetric_part(const M3<T>& a) {
  const T half = filled<T>(0.5);
  const T yx = half * (a.e[3] + a.e[1]), zx = half * (a.e[6] + a.e[2]), zy = half * (a.e[7] + a.e[5]);
  return {{a.e[0], yx, zx, yx, a.e[4], zy, zx, zy, a.e[8]}};
}
template <class T>
inline void add_to_diagonal(M3<T>& a, const T& s) {
  a.e[0] += s;
  a.e[4] += s;
  a.e[8] += s;
}
template <class T>
inline M3<T> diagonal_matrix(const V3<T>& d) {
  const T o{};
  return {{d.x, o, o, o, d.y, o, o, o, d.z}};
}

/// [v] m and m [v], without the products that are zero.
template <class T>
inline M3<T> cross_times(const V3<T>& v, const M3<T>& m) {
  M3<T> r;
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    r(0, j) = v.y * m(2, j) - v.z * m(1, j);
    r(1, j) = v.z * m(0, j) - v.x * m(2, j);
    r(2, j) = v.x * m(1, j) - v.y * m(0, j);
  }
  return r;
}
template <class T>
inline M3<T> times_cross(const M3<T>& m, const V3<T>& v) {
  M3<T> r;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    r(i, 0) = m(i, 1) * v.z - m(i, 2) * v.y;
    r(i, 1) = m(i, 2) * v.x - m(i, 0) * v.z;
    r(i, 2) = m(i, 0) * v.y - m(i, 1) * v.x;
  }
  return r;
}

/// [a] diag(k) [b].
template <class T>
inline M3<T> cross_diagonal_cross(const V3<T>& a, const V3<T>& k, const V3<T>& b) {
  const T xy = k.x * b.y, xz = k.x * b.z, yx = k.y * b.x, yz = k.y * b.z, zx = k.z * b.x, zy = k.z * b.y;
  return {{-(a.z * yz + a.y * zy), a.y * zx, a.z * yx,
           a.x * zy, -(a.z * xz + a.x * zx), a.z * xy,
           a.x * yz, a.y * xz, -(a.y * xy + a.x * yx)}};
}

/// m + [v].
template <class T>
inline M3<T> plus_cross(const M3<T>& m, const V3<T>& v) {
  return {{m.e[0], m.e[1] - v.z, m.e[2] + v.y, m.e[3] + v.z, m.e[4], m.e[5] - v.x, m.e[6] - v.y, m.e[7] + v.x, m.e[8]}};
}

/// a^T b where that is known to be symmetric: six products of the nine.
template <class T>
inline M3<T> symmetric_product(const M3<T>& a, const M3<T>& b) {
  M3<T> r;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j <= i; ++j) {
      r(i, j) = a(0, i) * b(0, j) + a(1, i) * b(1, j) + a(2, i) * b(2, j);
      r(j, i) = r(i, j);
    }
  return r;
}
template <class T>
inline M3<T> transposed_times(const M3<T>& a, const M3<T>& b) {
  M3<T> r;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) r(i, j) = a(0, i) * b(0, j) + a(1, i) * b(1, j) + a(2, i) * b(2, j);
  return r;
}

/// Unit quaternion w + (x, y, z).
template <class T>
struct Q4 {
  T w;
  V3<T> v;
};

template <class T>
inline Q4<T> conjugate_times(const Q4<T>& a, const Q4<T>& b) {
  const V3<T> c = cross(a.v, b.v);
  return {a.w * b.w + dot(a.v, b.v), a.w * b.v - b.w * a.v - c};
}

template <class T>
inline M3<T> rotation_matrix(const Q4<T>& q) {
  const T two = filled<T>(2), one = filled<T>(1);
  const T x = q.v.x, y = q.v.y, z = q.v.z, w = q.w;
  return {{one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y),
           two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x),
           two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)}};
}

}  // namespace TENDRIL_LANES_NAMESPACE
