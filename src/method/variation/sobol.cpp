#include "method/variation/sobol.h"

#include <array>
#include <bit>

#include "method/variation/random_stream.h"

namespace tendril::variation {
namespace {

/// A primitive polynomial over GF(2), its highest bit the highest power, and as many odd initial values as its degree.
struct Generator {
  int polynomial;
  std::array<int, 9> initial;
};

// Dimensions 2, 3, ...; the first one is the radical inverse.
constexpr Generator generators[sobol_dimensions - 1] = {
    {3, {1}}, {7, {1, 3}}, {11, {1, 3, 1}}, {13, {1, 1, 1}}, {19, {1, 1, 3, 3}}, {25, {1, 3, 5, 13}},
    {37, {1, 1, 5, 5, 17}}, {41, {1, 1, 5, 5, 5}}, {47, {1, 1, 7, 11, 19}}, {55, {1, 1, 5, 1, 1}}, {59, {1, 1, 1, 3, 11}},
    {61, {1, 3, 5, 5, 31}}, {67, {1, 3, 3, 9, 7, 49}}, {91, {1, 1, 1, 15, 21, 21}}, {97, {1, 3, 1, 13, 27, 49}},
    {103, {1, 1, 1, 15, 7, 5}}, {109, {1, 3, 1, 15, 13, 25}}, {115, {1, 1, 5, 5, 19, 61}},
    {131, {1, 3, 7, 11, 23, 15, 103}}, {137, {1, 3, 7, 13, 13, 15, 69}}, {143, {1, 1, 3, 13, 7, 35, 63}},
    {145, {1, 3, 5, 9, 1, 25, 53}}, {157, {1, 3, 1, 13, 9, 35, 107}}, {167, {1, 3, 1, 5, 27, 61, 31}},
    {171, {1, 1, 5, 11, 19, 41, 61}}, {185, {1, 3, 5, 3, 3, 13, 69}}, {191, {1, 1, 7, 13, 1, 19, 1}},
    {193, {1, 3, 7, 5, 13, 19, 59}}, {203, {1, 1, 3, 9, 25, 29, 41}}, {211, {1, 3, 5, 13, 23, 1, 55}},
    {213, {1, 3, 7, 3, 13, 59, 17}}, {229, {1, 3, 1, 3, 5, 53, 69}}, {239, {1, 1, 5, 5, 23, 33, 13}},
    {241, {1, 1, 7, 7, 1, 61, 123}}, {247, {1, 1, 7, 9, 13, 61, 49}}, {253, {1, 3, 3, 5, 3, 55, 33}},
    {285, {1, 3, 1, 15, 31, 13, 49, 245}}, {299, {1, 3, 5, 15, 31, 59, 63, 97}}, {301, {1, 3, 1, 11, 11, 11, 77, 249}},
    {333, {1, 3, 1, 11, 27, 43, 71, 9}}, {351, {1, 1, 7, 15, 21, 11, 81, 45}}, {355, {1, 3, 7, 3, 25, 31, 65, 79}},
    {357, {1, 3, 1, 1, 19, 11, 3, 205}}, {361, {1, 1, 5, 9, 19, 21, 29, 157}}, {369, {1, 3, 7, 11, 1, 33, 89, 185}},
    {391, {1, 3, 3, 3, 15, 9, 79, 71}}, {397, {1, 3, 7, 11, 15, 39, 119, 27}}, {425, {1, 1, 3, 1, 11, 31, 97, 225}},
    {451, {1, 1, 1, 3, 23, 43, 57, 177}}, {463, {1, 3, 7, 7, 17, 17, 37, 71}}, {487, {1, 3, 1, 5, 27, 63, 123, 213}},
    {501, {1, 1, 3, 5, 11, 43, 53, 133}}, {529, {1, 3, 5, 5, 29, 17, 47, 173, 479}}, {539, {1, 3, 3, 11, 3, 1, 109, 9, 69}},
    {545, {1, 1, 1, 5, 17, 39, 23, 5, 343}}, {557, {1, 3, 1, 5, 25, 15, 31, 103, 499}},
    {563, {1, 1, 1, 11, 11, 17, 63, 105, 183}}, {601, {1, 1, 5, 11, 9, 29, 97, 231, 363}},
    {607, {1, 1, 5, 15, 19, 45, 41, 7, 383}}, {617, {1, 3, 7, 7, 31, 19, 83, 137, 221}},
    {623, {1, 1, 1, 3, 23, 15, 111, 223, 83}}, {631, {1, 1, 5, 13, 31, 15, 55, 25, 161}},
    {637, {1, 1, 3, 13, 25, 47, 39, 87, 257}}};

constexpr int bits = 32;
using Directions = std::array<std::uint32_t, bits>;

constexpr Directions directions_of(const Generator& generator) {
  const int degree = std::bit_width(static_cast<unsigned>(generator.polynomial)) - 1;
  Directions v{};
  for (int k = 0; k < bits; ++k) {
    if (k < degree) {
      v[k] = static_cast<std::uint32_t>(generator.initial[k]) << (bits - 1 - k);
      continue;
    }
    v[k] = v[k - degree] ^ (v[k - degree] >> degree);
    for (int j = 1; j < degree; ++j)
      if (generator.polynomial >> (degree - j) & 1) v[k] ^= v[k - j];
  }
  return v;
}

constexpr auto directions = [] {
  std::array<Directions, sobol_dimensions> all{};
  for (int k = 0; k < bits; ++k) all[0][k] = 1u << (bits - 1 - k);
  for (int d = 1; d < sobol_dimensions; ++d) all[d] = directions_of(generators[d - 1]);
  return all;
}();

}  // namespace

std::uint32_t sobol_bits(std::uint32_t index, int dimension) {
  std::uint32_t x = 0;
  for (; index; index &= index - 1) x ^= directions[dimension][std::countr_zero(index)];
  return x;
}

std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t seed) {
  std::uint32_t flips = 0;
  for (int k = 0; k < bits; ++k) {
    // The k bits above, with a one before them so that 0 and 00 differ.
    const std::uint64_t above = (std::uint64_t{1} << k) | (k ? x >> (bits - k) : 0);
    flips |= static_cast<std::uint32_t>(mixed(seed ^ (above * 0x9e3779b97f4a7c15u)) >> 63) << (bits - 1 - k);
  }
  return x ^ flips;
}

}  // namespace tendril::variation
