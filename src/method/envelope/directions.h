// The directions in which the extent of every cloud of centre points is measured.
#pragma once

#include "method/envelope/kernel.h"

namespace tendril::envelope {

/// 64 unit vectors, which stand for 128 directions with their opposites: the three axes, then 61 spread evenly over half
/// of the sphere (a Fibonacci spiral).
constexpr int direction_pairs = 64;
const NormalArrays& directions();

}  // namespace tendril::envelope
