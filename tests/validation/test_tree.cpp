// Three hoses that meet in a rigid branch point.
#include <catch2/catch.hpp>

#include <cmath>

#include "validation/reference.h"

using namespace tendril;
using namespace tendril::validation;

TEST_CASE("harness of three hoses: the reference is met, with the elements' orders") {
  for (const Method* method : {&se3, &staggered}) {
    TreeErrors errors[2];
    for (const int k : {0, 1}) {
      const SystemEquilibrium e = solve(tree_problem(20 << k), method->options(true));
      REQUIRE(e.ok());
      CAPTURE(method->name, k, e.rods[0].message);
      for (const Equilibrium& rod : e.rods) CHECK(rod.stable);
      errors[k] = tree_errors(e);
      // What holds a free branch point is nothing.
      CHECK(e.branch_supports[0].force.norm() < 1e-8);
      double estimate = 0;
      for (const Equilibrium& rod : e.rods) {
        REQUIRE(rod.error);
        CHECK(rod.error->valid);
        estimate = std::max(estimate, rod.error->value / 0.4);
      }
      CHECK(estimate < 3 * errors[k].line);
      CHECK(estimate > errors[k].line / 3);
    }
    CAPTURE(method->name, errors[0].line, errors[1].line, errors[1].reaction, errors[1].energy);
    CHECK(std::log2(errors[0].line / errors[1].line) == Approx(method->order).margin(0.4));
    const bool fourth = method == &se3;
    CHECK(errors[1].line < (fourth ? 1.4e-6 : 1.3e-3));
    CHECK(errors[1].reaction < (fourth ? 5e-6 : 5e-3));
    CHECK(errors[1].energy < (fourth ? 6e-6 : 5e-3));
    CHECK(errors[1].branch < errors[1].line * (1 + 1e-9));
    CHECK(errors[1].branch_turn < (fourth ? 2e-6 : 2e-3));
  }
}
