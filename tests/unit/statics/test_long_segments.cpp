// Segments so long that the force in the rod outweighs the bending stiffness over them.
#include <catch2/catch.hpp>

#include <cmath>

#include "statics/solve.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

/// 1.2 m long between clamps 0.8 m apart; heaviness: w L^3/EI.
RodProblem hanging(double heaviness, int segments) {
  Section section = Section::round(2e-4, 0, Material::from_poisson(5e6, 0.5, 0));
  section.mass = heaviness * section.EI1 / (1.2 * 1.2 * 1.2) / 9.81;
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, section, segments);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

RodProblem stretched(double slenderness, int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(2 / slenderness, 0, Material::from_poisson(5e6, 0.5, 0)), segments);
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0.5, 0}, {0, 0, 1})}, {1, Frame::looking({1.05, 0, 0}, {1, -0.5, 0}, {0, 0, 1})}};
  return problem;
}

/// Lowest point of an inextensible chain of 1.2 m between equal heights 0.8 m apart.
double catenary_sag() {
  double low = 0.05, high = 1;  // 1.2 = 2 a sinh(0.4 / a)
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high);
    (2 * a * std::sinh(0.4 / a) > 1.2 ? low : high) = a;
  }
  return low * (std::cosh(0.4 / low) - 1);
}

}  // namespace

TEST_CASE("a rod too heavy for the fourth-order element on its mesh is solved with the staggered one, at once") {
  for (const double heaviness : {3.5e5, 3.5e6}) {
    const Equilibrium e = solve(hanging(heaviness, 40));
    CAPTURE(heaviness, e.iterations);
    REQUIRE(e.ok());
    CHECK(e.stable);
    CHECK(e.fallbacks == 0);
    CHECK(e.iterations < 60);
    CHECK_THAT(e.message, Contains("solved with the staggered element: the segments are too long for the tension in them"));
    CHECK(-e.points[20].z() == Approx(catenary_sag()).epsilon(0.02));
  }
}

TEST_CASE("with segments short enough it is solved with the fourth-order element") {
  for (const int segments : {80, 160}) {
    const Equilibrium e = solve(hanging(2e4, segments));
    REQUIRE(e.ok());
    CHECK(e.message == "solved");
    CHECK(e.stable);
  }
  // In between the staggered solution is where the fourth-order element starts from.
  const Equilibrium between = solve(hanging(2e4, 28));
  REQUIRE(between.ok());
  CHECK(between.iterations < 60);
}

TEST_CASE("a rod pulled beyond its length: few iterations on any mesh") {
  for (const double slenderness : {10., 100., 1000.})
    for (const int segments : {10, 40, 160}) {
      const Equilibrium e = solve(stretched(slenderness, segments));
      CAPTURE(slenderness, segments, e.message);
      REQUIRE(e.ok());
      CHECK(e.stable);
      CHECK(e.iterations < 60);
      if (slenderness > 50)  // else the bending takes part
        CHECK(e.reactions[1].force.x() == Approx(0.05 * Section::round(2 / slenderness, 0, Material::from_poisson(5e6, 0.5, 0)).EA).epsilon(0.25));
    }
}
