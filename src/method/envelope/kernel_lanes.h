// As many floats as a register holds: 16 with AVX-512, 8 with AVX2, 8 in plain arrays elsewhere. Included only by the
// files that compile the kernel, each in a namespace of its own.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#else
#include <cmath>
#endif

namespace TENDRIL_LANES_NAMESPACE {

#if defined(__AVX512F__)

struct Floats {
  static constexpr int width = 16;
  using Mask = __mmask16;
  __m512 v;
};
inline Floats load(const float* p) { return {_mm512_loadu_ps(p)}; }
inline void store(float* p, Floats a) { _mm512_storeu_ps(p, a.v); }
inline Floats all(float x) { return {_mm512_set1_ps(x)}; }
inline Floats add(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Floats less(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Floats times(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Floats fma(Floats a, Floats b, Floats c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats root(Floats a) { return {_mm512_sqrt_ps(a.v)}; }
inline Floats size(Floats a) { return {_mm512_abs_ps(a.v)}; }
inline Floats::Mask above(Floats a, Floats b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ); }
inline Floats choose(Floats::Mask m, Floats yes, Floats no) { return {_mm512_mask_mov_ps(no.v, m, yes.v)}; }
inline std::uint32_t bits(Floats::Mask m) { return m; }
/// The chosen lanes, side by side. Writes a whole register.
inline void pack(float* to, Floats a, Floats::Mask m) { _mm512_storeu_ps(to, _mm512_maskz_compress_ps(m, a.v)); }

#elif defined(__AVX2__) && defined(__FMA__)

struct Floats {
  static constexpr int width = 8;
  using Mask = __m256;
  __m256 v;
};
inline Floats load(const float* p) { return {_mm256_loadu_ps(p)}; }
inline void store(float* p, Floats a) { _mm256_storeu_ps(p, a.v); }
inline Floats all(float x) { return {_mm256_set1_ps(x)}; }
inline Floats add(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Floats less(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Floats times(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Floats fma(Floats a, Floats b, Floats c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats root(Floats a) { return {_mm256_sqrt_ps(a.v)}; }
inline Floats size(Floats a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
inline Floats::Mask above(Floats a, Floats b) { return _mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ); }
inline Floats choose(Floats::Mask m, Floats yes, Floats no) { return {_mm256_blendv_ps(no.v, yes.v, m)}; }
inline std::uint32_t bits(Floats::Mask m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m)); }

#else

struct Floats {
  static constexpr int width = 8;
  struct Mask {
    bool m[width];
  };
  float v[width];
};
template <class F>
inline Floats each(F f) {
  Floats r;
  for (int i = 0; i < Floats::width; ++i) r.v[i] = f(i);
  return r;
}
inline Floats load(const float* p) { return each([&](int i) { return p[i]; }); }
inline void store(float* p, Floats a) {
  for (int i = 0; i < Floats::width; ++i) p[i] = a.v[i];
}
inline Floats all(float x) { return each([&](int) { return x; }); }
inline Floats add(Floats a, Floats b) { return each([&](int i) { return a.v[i] + b.v[i]; }); }
inline Floats less(Floats a, Floats b) { return each([&](int i) { return a.v[i] - b.v[i]; }); }
inline Floats times(Floats a, Floats b) { return each([&](int i) { return a.v[i] * b.v[i]; }); }
inline Floats fma(Floats a, Floats b, Floats c) { return each([&](int i) { return a.v[i] * b.v[i] + c.v[i]; }); }
inline Floats larger(Floats a, Floats b) { return each([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; }); }
inline Floats smaller(Floats a, Floats b) { return each([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; }); }
inline Floats root(Floats a) { return each([&](int i) { return std::sqrt(a.v[i]); }); }
inline Floats size(Floats a) { return each([&](int i) { return std::abs(a.v[i]); }); }
inline Floats::Mask above(Floats a, Floats b) {
  Floats::Mask m;
  for (int i = 0; i < Floats::width; ++i) m.m[i] = a.v[i] > b.v[i];
  return m;
}
inline Floats choose(Floats::Mask m, Floats yes, Floats no) {
  return each([&](int i) { return m.m[i] ? yes.v[i] : no.v[i]; });
}
inline std::uint32_t bits(Floats::Mask m) {
  std::uint32_t r = 0;
  for (int i = 0; i < Floats::width; ++i) r |= static_cast<std::uint32_t>(m.m[i]) << i;
  return r;
}

#endif

#if !defined(__AVX512F__)
inline void pack(float* to, Floats a, Floats::Mask m) {
  float lanes[Floats::width];
  store(lanes, a);
  for (std::uint32_t left = bits(m); left; left &= left - 1) *to++ = lanes[__builtin_ctz(left)];
}
#endif

inline float largest(Floats a) {
  float lanes[Floats::width];
  store(lanes, a);
  float best = lanes[0];
  for (int i = 1; i < Floats::width; ++i) best = lanes[i] > best ? lanes[i] : best;
  return best;
}

}  // namespace TENDRIL_LANES_NAMESPACE
