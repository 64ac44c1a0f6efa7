// Eight floats at a time by the compiler's vector extension: AVX where the target has it, narrower registers elsewhere.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace tendril::simd {

using Float8 = float __attribute__((vector_size(32)));
using Int8 = int __attribute__((vector_size(32)));

inline Float8 all(float x) { return Float8{x, x, x, x, x, x, x, x}; }
inline Float8 larger(Float8 a, Float8 b) { return a > b ? a : b; }
inline Float8 smaller(Float8 a, Float8 b) { return a < b ? a : b; }

/// The smallest of the eight.
inline float smallest(Float8 a) {
  a = smaller(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
  a = smaller(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
  a = smaller(a, __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6));
  return a[0];
}

/// Bit i is set where lane i of a comparison holds.
inline unsigned bits(Int8 truth) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(truth)));
#else
  unsigned result = 0;
  for (int i = 0; i < 8; ++i) result |= static_cast<unsigned>(truth[i] & 1) << i;
  return result;
#endif
}

}  // namespace tendril::simd
