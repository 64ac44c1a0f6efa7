// Contact with a rigid, smooth floor against exact answers.
#include <catch2/catch.hpp>

#include "validation/floor_contact.h"

using namespace tendril;
using namespace tendril::validation;

TEST_CASE("a heavy hose lies down on a floor: clamp force and moment, shape, lift-off") {
  for (const int segments : {40, 80, 160}) {
    const FloorProblem problem = hose_on_floor(segments);
    const Equilibrium e = solve(problem.rod);
    CAPTURE(segments, e.message);
    REQUIRE(e.ok());
    CHECK(e.stable);
    const FloorErrors errors = hose_on_floor_errors(e);
    CAPTURE(errors.force, errors.moment, errors.line, errors.deepest);
    CHECK(errors.force < 5e-4);
    CHECK(errors.moment < 1e-3);
    CHECK(errors.line < 5e-5);
    CHECK(errors.deepest < 1e-3);
  }
}

TEST_CASE("a cantilever's tip on a floor: the shape stays, the floor carries the rest") {
  for (const TipOnFloor& tip : tips_on_floor)
    for (const double times : {1.5, 3.0}) {
      const FloorProblem problem = tip_on_floor(tip, times, 40);
      const Equilibrium e = solve(problem.rod);
      CAPTURE(tip.depth, times, e.message);
      REQUIRE(e.ok());
      CHECK(e.stable);
      const TipErrors errors = tip_on_floor_errors(tip, times, e);
      CAPTURE(errors.place, errors.angle, errors.floor_force);
      CHECK(errors.place < 2e-5);
      CHECK(errors.angle < 1e-4);
      CHECK(errors.floor_force < 5e-4);
    }
}

TEST_CASE("a cantilever above a floor does not feel it") {
  const TipOnFloor& tip = tips_on_floor[1];
  const FloorProblem problem = tip_on_floor(tip, 0.95, 40);
  const Equilibrium e = solve(problem.rod);
  REQUIRE(e.ok());
  CHECK(e.contacts.empty());
  CHECK(e.points.back().z() > -tip.depth);
  RodProblem bare = problem.rod;
  bare.surroundings = nullptr;
  CHECK((e.points.back() - solve(bare).points.back()).norm() < 1e-8);
}
