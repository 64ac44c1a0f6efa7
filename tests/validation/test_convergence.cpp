// Every reference case: error bounds at a stated mesh, the order of convergence and the error estimate.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "validation/expected_errors.h"

using namespace tendril;
using namespace tendril::validation;

namespace {

/// What an error against a reference cannot fall below: the reference's own digits, or the load over the stiffness of an
/// inextensible rod's twin.
double floor_of(const Reference& reference) { return reference.rod.rigid() ? 1e-8 : 2e-12; }

void check_estimate(const Reference& reference, const Equilibrium& equilibrium, double error) {
  REQUIRE(equilibrium.error);
  if (!equilibrium.error->valid || error < floor_of(reference)) return;
  const double estimate = equilibrium.error->value / reference.rod.length;
  CAPTURE(estimate, error);
  CHECK(estimate < 3 * error);
  CHECK(estimate > error / 3);
}

void check_method(const Reference& reference, const Method& method, int segments, const Errors& bound) {
  CAPTURE(reference.name, reference.label, method.name, segments);
  const Equilibrium coarse = solve(problem_of(reference, segments / 2), method.options(true));
  const Equilibrium fine = solve(problem_of(reference, segments), method.options(true));
  REQUIRE(fine.status == Status::solved);
  CHECK(fine.stable);
  const Errors errors = errors_of(reference, fine);
  CHECK(errors.line < bound.line);
  CHECK(errors.reaction < bound.reaction);
  CHECK(errors.energy < bound.energy);
  REQUIRE(fine.error);
  CHECK(fine.error->valid);
  check_estimate(reference, fine, errors.line);
  // Very strongly bent rods may fail on the coarser mesh; then it gives no order.
  if (coarse.status != Status::solved) return;
  const Errors coarse_errors = errors_of(reference, coarse);
  check_estimate(reference, coarse, coarse_errors.line);
  if (errors.line < floor_of(reference) || coarse_errors.line > 0.1) return;
  const double order = std::log2(coarse_errors.line / errors.line);
  CHECK(order > method.order - 0.5);
  CHECK(order < method.order + 0.7);
}

void check_all(const char* part) {
  int cases = 0;
  for (const ExpectedErrors& expected : expected_errors()) {
    if (std::strncmp(expected.name, part, std::strlen(part)) != 0) continue;
    for (const Reference* reference : references_named(expected.name)) {
      // No cold start leads there; by moving the end: test_coarse_meshes.cpp.
      if (std::string(reference->label) == "R=2.5 turns, D=0.4, Kirchhoff") continue;
      check_method(*reference, se3, expected.segments, expected.se3);
      check_method(*reference, staggered, expected.segments, expected.staggered);
      check_method(*reference, thesis, expected.segments, expected.thesis);
      ++cases;
    }
  }
  CHECK(cases > 0);
}

}  // namespace

TEST_CASE("elastica: inextensible, slender and thick cantilevers") { check_all("elastica"); }
TEST_CASE("45 degree bend: pre-curved cantilever under a force out of its plane") { check_all("bend45"); }
TEST_CASE("Princeton beam: unequal bending stiffnesses, loads at all pitches") { check_all("princeton"); }
TEST_CASE("hose under gravity: all listed equilibria, by the end hold's turns") { check_all("hose"); }
TEST_CASE("opposed tangents: all listed equilibria, by the end hold's turns") { check_all("extreme_opposed"); }
TEST_CASE("end turned by 720 degrees") { check_all("extreme_twist720"); }
TEST_CASE("clamps further apart than the rod is long") { check_all("extreme_stretched"); }
TEST_CASE("helical spring, pulled and pushed") { check_all("helix_spring"); }
TEST_CASE("clamped elastica after buckling") { check_all("euler_postbuckled"); }
TEST_CASE("clamped rods, twisted by half a turn to four turns") { check_all("twisted_clamped"); }

TEST_CASE("every reference list is covered") {
  std::size_t solutions = 0;
  for (const Reference* reference : all_references()) {
    ++solutions;
    CHECK(reference->rod.length > 0);
  }
  CHECK(solutions == 91);
}
