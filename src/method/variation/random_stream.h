// Random numbers by counting: each is a function of what it is for, so that outcomes can be drawn in any order.
#pragma once

#include <cstdint>

namespace tendril::variation {

/// A bijection of 64 bits that leaves no pattern (Stafford's constants for the finaliser of MurmurHash3, "Mix13").
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// 64 random bits for a seed and two numbers.
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio: SplitMix64's step
  return mixed(mixed(mixed(seed + golden) + (a + 1) * golden) + (b + 1) * golden);
}

/// In the open interval (0, 1), 2^52 values, symmetric about a half.
inline double open_unit(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

}  // namespace tendril::variation
