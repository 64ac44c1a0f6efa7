#include <catch2/catch.hpp>

#include "base/units.h"
#include "statics/modes.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

Rod hose(double length, int segments) {
  Rod rod;
  rod.length = length;
  rod.segments = segments;
  Section section;
  section.EI1 = section.EI2 = 0.01608495438638;
  section.GJ = section.EI1 * 2 / 3;
  section.EA = 1005.309649149;
  section.GA1 = section.GA2 = section.EA / 3;
  section.mass = 0.2211681228127;
  section.outer = 0.016;
  rod.parts = {{length, section}};
  return rod;
}

double energy_of(const SystemEquilibrium& eq) {
  double sum = 0;
  for (const Equilibrium& rod : eq.rods) sum += rod.energy.total();
  return sum;
}

}  // namespace

TEST_CASE("modes: a straight clamped rod has the eigenvalues of its twist and of its buckling", "[statics]") {
  SystemProblem problem;
  problem.rods.resize(1);
  problem.rods[0].rod = hose(1, 64);
  problem.rods[0].holds = {{0, Frame::looking({0, 0, 0}, Vec3::UnitX())}, {1, Frame::looking({1, 0, 0}, Vec3::UnitX())}};
  NetworkSolver solver(problem, {});
  const SystemEquilibrium eq = solver.solve({});
  REQUIRE(eq.ok());
  const std::vector<Eigenmode> modes = softest_modes(solver, solver.starting_state(&eq), 5);
  REQUIRE(modes.size() == 5);
  // Twist: k^2 pi^2 GJ/EI. Bending, twice: EI w'''' + (lambda EI/L^2)(w'' - 0.01 w/L^2) = 0 with clamped ends, 4 pi^2 but for
  // the weight of the move: w = 1 - cos(2 pi x/L) makes it 1 + 0.01 * 1.5/(2 pi^2) times smaller.
  const double twist = units::pi * units::pi * 2 / 3, bending = 4 * units::pi * units::pi / (1 + 0.01 * 1.5 / (2 * units::pi * units::pi));
  CHECK(modes[0].eigenvalue == Approx(twist).epsilon(2e-3));
  CHECK(modes[1].eigenvalue == Approx(4 * twist).epsilon(2e-3));
  CHECK(modes[2].eigenvalue == Approx(bending).epsilon(2e-3));
  CHECK(modes[3].eigenvalue == Approx(bending).epsilon(2e-3));
  CHECK(modes[4].eigenvalue == Approx(9 * twist).epsilon(4e-3));
}

TEST_CASE("modes: an equilibrium that is not stable shows a negative eigenvalue", "[statics]") {
  SystemProblem problem;
  problem.rods.resize(1);
  problem.rods[0].rod = hose(1, 40);
  problem.rods[0].holds = {{0, Frame::looking({0, 0, 0}, Vec3::UnitX())}, {1, Frame::looking({0.95, 0, 0}, Vec3::UnitX())}};
  SolveOptions options;
  options.stable_only = false;
  NetworkSolver solver(problem, options);
  std::vector<std::vector<Frame>> straight(1);
  for (const double s : solver.network().rod(0).mesh().s) straight[0].push_back(Frame::looking({0.95 * s, 0, 0}, Vec3::UnitX()));
  RodState state = solver.network().state_from(straight, {});
  REQUIRE(solver.iterate(state, true, {}).status == Status::solved);
  const std::vector<Eigenmode> modes = softest_modes(solver, state, 2);
  REQUIRE(modes.size() == 2);
  CHECK(modes[0].eigenvalue < 0);
}

TEST_CASE("modes: the search finds the twisted equilibria of a hanging hose", "[statics]") {
  SystemProblem problem;
  problem.rods.resize(1);
  problem.rods[0].rod = hose(1.2, 40);
  problem.rods[0].gravity = {0, 0, -9.81};
  const Quat along_x(0, std::sqrt(0.5), 0, std::sqrt(0.5));
  problem.rods[0].holds = {{0, {{0, 0, 0}, along_x}}, {1.2, {{0.8, 0, 0}, along_x}}};
  const SystemEquilibrium found = solve(problem);
  REQUIRE(found.ok());
  CHECK(energy_of(found) == Approx(-0.340873).epsilon(1e-4));
  const std::vector<SystemEquilibrium> others = other_equilibria(problem, {}, {}, found);
  // Energies of the reference equilibria with one turn less and two turns more.
  for (const double reference : {-0.186466, 0.284164}) {
    double nearest = INFINITY;
    for (const SystemEquilibrium& other : others) nearest = std::min(nearest, std::abs(energy_of(other) - reference));
    CHECK(nearest < 1e-4);
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    CHECK(others[i].ok());
    CHECK(others[i].rods[0].stable);
    CHECK(others[i].rods[0].residual < 1e-6);
    if (i > 0) CHECK(energy_of(others[i]) >= energy_of(others[i - 1]));
  }
}
