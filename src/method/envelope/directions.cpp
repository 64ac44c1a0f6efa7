#include "method/envelope/directions.h"

#include <cmath>

#include "base/units.h"

namespace tendril::envelope {
namespace {

struct Spread {
  float x[direction_pairs], y[direction_pairs], z[direction_pairs];
  NormalArrays arrays{x, y, z, direction_pairs};

  Spread() {
    for (int axis = 0; axis < 3; ++axis) {
      x[axis] = axis == 0;
      y[axis] = axis == 1;
      z[axis] = axis == 2;
    }
    const double golden_angle = units::pi * (3 - std::sqrt(5.0));
    constexpr int rest = direction_pairs - 3;
    for (int i = 0; i < rest; ++i) {
      const double height = (i + 0.5) / rest, radius = std::sqrt(1 - height * height), angle = golden_angle * i;
      x[3 + i] = static_cast<float>(radius * std::cos(angle));
      y[3 + i] = static_cast<float>(radius * std::sin(angle));
      z[3 + i] = static_cast<float>(height);
    }
  }
};

}  // namespace

const NormalArrays& directions() {
  static const Spread spread;
  return spread.arrays;
}

}  // namespace tendril::envelope
