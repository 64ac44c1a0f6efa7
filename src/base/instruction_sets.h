// Which of the levels of x86-64 this machine runs, for code that is there once for each.
#pragma once

namespace tendril {

#if defined(__x86_64__)
/// AVX2, FMA and what comes with them.
inline bool runs_x86_64_v3() {
#if defined(__clang__)  // knows the features by their own names only
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#else
  return __builtin_cpu_supports("x86-64-v3");
#endif
}

/// AVX-512 in the extent that servers have.
inline bool runs_x86_64_v4() {
#if defined(__clang__)
  return runs_x86_64_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return __builtin_cpu_supports("x86-64-v4");
#endif
}
#endif

}  // namespace tendril
