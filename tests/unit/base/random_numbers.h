// Random numbers, vectors and rotations for tests. A failure is repeated by the seed it prints.
#pragma once

#include <random>

#include "base/frame.h"

namespace tendril::test {

struct Random {
  explicit Random(unsigned seed) : engine(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); }
  int below(int n) { return std::uniform_int_distribution<>(0, n - 1)(engine); }
  Vec3 point(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  Vec3 direction() {
    std::normal_distribution<> normal;
    return Vec3(normal(engine), normal(engine), normal(engine)).normalized();
  }
  Quat rotation() {
    std::normal_distribution<> normal;
    return Quat(normal(engine), normal(engine), normal(engine), normal(engine)).normalized();
  }
  std::mt19937 engine;
};

}  // namespace tendril::test
