// Random rods between two clamps, by family, for the property test and for the table of robustness.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "statics/problem.h"

namespace tendril::test {

struct RodFamily {
  std::string name;
  std::function<RodProblem(std::mt19937_64&)> make;
};

/// Rods of 1 m with 40 segments. Slenderness is the length over the section's radius.
std::vector<RodFamily> rod_families();

/// The random stream of one member of a family.
std::mt19937_64 stream_of(int family, int member);

/// Uniform over the unit sphere, and over all rotations.
Vec3 random_direction(std::mt19937_64& random);
Quat random_rotation(std::mt19937_64& random);
double random_between(std::mt19937_64& random, double low, double high);

/// A solid round rod of 1 m, 5 MPa, nu 0.5, without mass.
Rod slender_rod(double slenderness, int segments = 40);

}  // namespace tendril::test
