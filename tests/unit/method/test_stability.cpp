#include <catch2/catch.hpp>

#include <cmath>

#include "base/error.h"
#include "method/stability/stability.h"
#include "statics/parameter.h"
#include "statics/solve.h"
#include "unit/method/variation_cases.h"

using namespace tendril;
using namespace tendril::testing;

TEST_CASE("stability: the matrix and the moves are those of problems solved anew", "[stability]") {
  SolveOptions tight;
  tight.tolerance = 1e-12;
  const SceneEquilibrium eq = three_hoses().solve(tight);
  stability::Options options;
  options.vary = {{"a.length", 0.05}, {"b.to.at", 0.002}, {"c.to.turn.z", 0.1}, {"tee.3.at.y", 0}, {"gravity.x", 0}};
  options.measures = {"a.min_bend_radius", "b.max_tension", "c.length", "tee.place.z"};
  const stability::Result result = stability::run(eq, options);
  REQUIRE(result.ok);
  CHECK(result.message == "solved");
  REQUIRE(result.variables.size() == 7);
  CHECK(result.variables[2].name == "b.to.at.y");
  CHECK(result.unit(1, 0) == "N/m");
  CHECK(result.unit(3, 1) == "1");
  const std::vector<SceneParameter> all = parameters_of(eq);
  for (int c = 0; c < 7; ++c) {
    const SceneParameter p = named_parameters(eq, {result.variables[c].name})[0];
    const double h = 1e-5;
    SystemEquilibrium from = *eq.part(eq, eq.systems[0].rods, eq.systems[0].branches);
    const SystemEquilibrium more = solve(changed(eq.systems[0].problem, p.parameter, h), tight, {}, &from);
    const SystemEquilibrium less = solve(changed(eq.systems[0].problem, p.parameter, -h), tight, {}, &from);
    CAPTURE(result.variables[c].name);
    const auto slope = [&](auto value) { return (value(more) - value(less)) / (2 * h); };
    const double expected[] = {slope([](const SystemEquilibrium& e) { return e.rods[0].smallest_bend_radius(); }),
                               slope([](const SystemEquilibrium& e) { return e.rods[1].largest_tension(); }),
                               slope([](const SystemEquilibrium& e) { return e.rods[2].settled_length(); }),
                               slope([](const SystemEquilibrium& e) { return e.branches[0].at.z(); })};
    for (int m = 0; m < 4; ++m) {
      CHECK(result.matrix(m, c) == Approx(expected[m]).epsilon(1e-3).margin(1e-4 * result.matrix.row(m).cwiseAbs().maxCoeff()));
      CHECK(result.scaled(m, c) == Approx(result.matrix(m, c) * result.variables[c].tolerance));
    }
    for (int r = 0; r < 3; ++r)
      for (std::size_t v = 0; v < more.rods[r].points.size(); ++v) {
        const Vec3 move = (more.rods[r].points[v] - less.rods[r].points[v]) / (2 * h);
        CHECK((result.moves[c][r][v] - move).norm() < 1e-4 * (1 + move.norm()));
      }
  }
  // The colour: the worst of the tolerances at each vertex; zero at a clamp that does not move.
  const std::vector<double> colour = result.colour(0);
  CHECK(colour.front() == Approx(0).margin(1e-12));
  CHECK(colour.back() >= 0.05 * result.moves[0][0].back().norm());
  CHECK(result.measures[0].value == Approx(eq.rods[0].equilibrium.smallest_bend_radius()));
}

TEST_CASE("stability: defaults, several systems, and what is refused", "[stability]") {
  Scene scene = three_hoses();
  scene.add(PlacedRod("alone", Rod::uniform(1, hose_section(), 10), Frame::looking({0, 2, 0}, {1, 0, 0}, {0, 0, 1}),
                      Frame::looking({0.8, 2, 0}, {1, 0, 0}, {0, 0, 1})));
  const SceneEquilibrium eq = scene.solve();
  const stability::Result result = stability::run(eq);
  REQUIRE(result.ok);
  CHECK(result.measures.size() == 12);
  CHECK(result.variables.size() == 3 + 4 + 6 * 5);  // gravity, lengths, frames of five clamps
  int other = 0, own = 0;
  for (std::size_t c = 0; c < result.variables.size(); ++c) {
    const bool alone = result.variables[c].name.rfind("alone", 0) == 0,
               gravity = result.variables[c].name.rfind("gravity", 0) == 0;
    if (alone) CHECK(result.matrix.col(static_cast<Eigen::Index>(c)).head(9).isZero(0));
    if (alone) CHECK(result.moves[c][0].back().isZero(0));
    if (!alone && !gravity) CHECK(result.matrix.col(static_cast<Eigen::Index>(c)).tail(3).isZero(0));
    other += !alone;
    own += alone;
  }
  CHECK(own == 13);
  CHECK(other == 24);
  CHECK(result.colour(3).size() == 11);
  using Catch::Contains;
  CHECK_THROWS_WITH(stability::run(eq, {{{"a.lenght", 0}}, {}}),
                    Contains("method.stability: unknown parameter 'a.lenght'; did you mean 'a.length'?"));
  CHECK_THROWS_WITH(stability::run(eq, {{}, {"a.sag"}}), Contains("method.stability: unknown measure 'a.sag'"));
  CHECK_THROWS_WITH(stability::run(eq, {{{"a.from", 0.1}}, {}}),
                    Contains("'a.from' is numbers in 'm' and in 'rad', which no tolerance fits"));
  CHECK_THROWS_WITH(stability::run(eq, {{{"a.length", -1}}, {}}), Contains("'a.length' has the tolerance -1"));
  CHECK_THROWS_WITH(stability::run(eq, {{{"a.length", 0}, {"a.length", 0}}, {}}), Contains("'a.length' is given twice"));
  SceneEquilibrium broken = eq;
  for (SolvedRod& rod : broken.rods) rod.equilibrium.status = Status::stalled;
  const stability::Result not_ok = stability::run(broken);
  CHECK(not_ok.status == Status::stalled);
}
