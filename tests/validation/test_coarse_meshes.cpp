// Meshes too coarse for the shape: they must still be solved, and the error estimate must say that it cannot be trusted.
// Also equilibria that no cold start reaches.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include "validation/reference.h"

using namespace tendril;
using namespace tendril::validation;

namespace {

Equilibrium solved_with_estimate(const Reference& reference, const Method& method, int segments) {
  const Equilibrium e = solve(problem_of(reference, segments), method.options(true));
  CAPTURE(reference.name, method.name, segments, e.message, e.iterations, e.fallbacks);
  REQUIRE(e.status == Status::solved);
  REQUIRE(e.error);
  return e;
}

}  // namespace

TEST_CASE("boundary layers of 0.09 m in 10 m of catenary: coarse meshes say that they are too coarse") {
  for (const char* name : {"hose_gravity_soft", "hose_catenary_limit"}) {
    const Reference& reference = *references_named(name).front();
    CHECK_FALSE(solved_with_estimate(reference, se3, 10).error->valid);
    CHECK_FALSE(solved_with_estimate(reference, staggered, 10).error->valid);
    CHECK_FALSE(solved_with_estimate(reference, staggered, 20).error->valid);
  }
}

TEST_CASE("boundary layers of 0.0045 L: resolved from 160 segments on") {
  const Reference& reference = *references_named("extreme_stretched_EAL2_EI_1e6").front();
  for (const int segments : {10, 20}) {
    CHECK_FALSE(solved_with_estimate(reference, se3, segments).error->valid);
    CHECK_FALSE(solved_with_estimate(reference, staggered, segments).error->valid);
  }
  for (const int segments : {160, 320, 640}) {
    const Equilibrium e = solved_with_estimate(reference, se3, segments);
    const double error = errors_of(reference, e).line;
    CHECK(e.error->valid);
    CHECK(e.error->value / reference.rod.length < 3 * error);
    CHECK(e.error->value / reference.rod.length > error / 3);
  }
}

TEST_CASE("boundary layers of 4.5e-5 L: far below any sensible mesh") {
  // The reaction is within 0.02 % all the same with the staggered element, whose stretch does not know of the bending.
  const Reference& reference = *references_named("extreme_stretched_EAL2_EI_1e10").front();
  for (const int segments : {10, 40, 160, 640}) {
    const Equilibrium e = solved_with_estimate(reference, staggered, segments);
    CHECK_FALSE(e.error->valid);
    const Errors errors = errors_of(reference, e);
    CHECK(errors.line < 3e-5);
    CHECK(errors.reaction < 2e-4);
  }
  // The fourth-order element is no use on segments this long for the tension; the staggered one stands in for it.
  for (const int segments : {10, 20, 40, 160, 640}) {
    const Equilibrium e = solved_with_estimate(reference, se3, segments);
    CHECK_FALSE(e.error->valid);
    CHECK(errors_of(reference, e).line < 0.2 / segments);
  }
}

TEST_CASE("2.5 turns brought together by 0.4 L: reached by moving the end") {
  const std::vector<const Reference*> all = references_named("twisted_clamped_R2p5turns");
  const Reference& start = *all[3];
  const Reference& reference = *all.back();
  REQUIRE(std::string(reference.label) == "R=2.5 turns, D=0.4, Kirchhoff");
  REQUIRE(std::string(start.label) == "R=2.5 turns, D=0.3, Kirchhoff");
  double errors_at[2];
  for (const int k : {0, 1}) {
    const int segments = 80 << k;
    RodProblem problem = problem_of(start, segments);
    Equilibrium e = solve(problem, se3.options());
    for (int step = 1; step <= 10; ++step) {
      problem.holds[1].frame.at.z() = 0.7 - 0.01 * step;
      e = solve(problem, se3.options(), {}, &e);
      CAPTURE(step, e.message, e.iterations, e.fallbacks);
      REQUIRE(e.status == Status::solved);
    }
    CHECK(e.stable);
    const Errors errors = errors_of(reference, e);
    errors_at[k] = errors.line;
    CHECK(errors.line < (k == 0 ? 4e-6 : 3e-7));
    CHECK(errors.reaction < (k == 0 ? 4e-5 : 2e-5));
  }
  CHECK(std::log2(errors_at[0] / errors_at[1]) == Approx(4).margin(0.4));
}
