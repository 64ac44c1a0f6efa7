// Sobol' points: a low-discrepancy sequence in base 2, with Owen's nested uniform scrambling.
//
// Direction numbers: primitive polynomials and initial values of Joe and Kuo, SIAM J. Sci. Comput. 30 (2008).
#pragma once

#include <cstdint>

namespace tendril::variation {

inline constexpr int sobol_dimensions = 64;

/// Coordinate `dimension` (0 ... 63) of point `index` as a binary fraction of 32 bits.
std::uint32_t sobol_bits(std::uint32_t index, int dimension);

/// Each bit flipped at random, by what the bits above it are: keeps every net property, makes each point uniform.
std::uint32_t owen_scrambled(std::uint32_t bits, std::uint64_t seed);

}  // namespace tendril::variation
