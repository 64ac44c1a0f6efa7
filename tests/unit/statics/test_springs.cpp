// Pose springs: against closed forms, and their derivatives against finite differences.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "statics/rod_system.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

/// 0.5 m of round rod, held at its start, along x.
RodProblem cantilever() {
  RodProblem problem;
  problem.rod = Rod::uniform(0.5, Section::round(0.01, 0, Material::from_poisson(20e6, 0.4, 1200)), 20);
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0, 0})}};
  return problem;
}

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

}  // namespace

TEST_CASE("springs: one that pulls the tip sideways bends the rod as a force does", "[springs]") {
  RodProblem problem = cantilever();
  const double EI = problem.rod.parts[0].section.EI1, length = problem.rod.length, small = 1e-4;
  const double rod = 3 * EI / std::pow(length, 3);  // N/m, of the tip
  for (const double stiffness : {1e-2 * rod, rod, 1e4 * rod}) {
    problem.springs = {{length, Frame::looking({length, small, 0}, {1, 0, 0}), stiffness, 0}};
    const Equilibrium eq = solve(problem);
    REQUIRE(eq.ok());
    // Shear adds 1/(GA) to the tip's flexibility.
    const double flexible = 1 / rod + length / problem.rod.parts[0].section.GA1;
    CHECK(eq.points.back().y() == Approx(small * stiffness / (stiffness + 1 / flexible)).epsilon(1e-6));
    CHECK(eq.energy.spring == Approx(0.5 * stiffness * (eq.points.back() - problem.springs[0].frame.at).squaredNorm()).epsilon(1e-9));
    CHECK(eq.reactions[0].force.y() == Approx(-stiffness * (small - eq.points.back().y())).epsilon(1e-6));
  }
}

TEST_CASE("springs: one that turns the tip twists the rod until both moments agree", "[springs]") {
  RodProblem problem = cantilever();
  const double GJ = problem.rod.parts[0].section.GJ, length = problem.rod.length;
  for (const double turn : {1e-9, 0.5, 2.0}) {
    const Frame straight = Frame::looking({length, 0, 0}, {1, 0, 0});
    problem.springs = {{length, {straight.at, exp_rotation(turn * Vec3::UnitX()) * straight.rotation}, 0, 3 * GJ / length}};
    const Equilibrium eq = solve(problem);
    REQUIRE(eq.ok());
    const double twisted = 2 * std::acos(std::min(1.0, std::abs((straight.rotation.conjugate() * eq.rotations.back()).w())));
    // GJ / length twisted = 3 GJ / length sin(turn - twisted)
    CHECK(twisted - 3 * std::sin(turn - twisted) == Approx(0).margin(turn < 1e-6 ? 2e-8 : 1e-7));
  }
}

TEST_CASE("springs: gradient and second derivative against finite differences", "[springs]") {
  for (int seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    RodProblem problem = cantilever();
    // The pose of the state but for an angle of 0, 1e-9 ... to nearly half a turn.
    const double angle = std::vector<double>{0, 1e-9, 1e-5, 0.1, 1, 1.5707963, 2, 3, 3.1415, 3.14159265}[seed];
    RodProblem bare = problem;
    const double at = 0.25;
    problem.springs = {{at, Frame{}, 0, 0}};
    bare.springs = problem.springs;
    auto plain = make_rod_system(bare, {}, cut_into_segments(bare, 10));
    std::vector<Frame> vertices;
    for (const double s : plain->mesh().s)
      vertices.push_back({problem.holds[0].frame.at + Vec3(s, 0.01 * std::sin(9 * s), 0), exp_rotation(0.3 * random_vector(random))});
    RodState state = plain->state_from(vertices);
    const int node = plain->mesh().spring_vertex[0];
    problem.springs[0].frame = {state.r[node] + 0.01 * random_vector(random), state.q[node] * exp_rotation(-angle * random_vector(random).normalized())};
    problem.springs[0].position = 2;
    problem.springs[0].rotation = 0.3;
    auto sprung = make_rod_system(problem, {}, cut_into_segments(problem, 10));
    const int nodes = plain->nodes();
    const auto difference = [&](const RodState& s, std::vector<Vec6>& gradient) {
      std::vector<Vec6> a(nodes), b(nodes);
      const double energy = sprung->gradient(s, a.data()) - plain->gradient(s, b.data());
      gradient.resize(nodes);
      for (int i = 0; i < nodes; ++i) gradient[i] = a[i] - b[i];
      return energy;
    };
    BlockSystem with, without;
    with.resize(nodes);
    without.resize(nodes);
    sprung->assemble(state, Stress::zero, with);
    plain->assemble(state, Stress::zero, without);
    std::vector<Vec6> here, forward, backward;
    difference(state, here);
    for (int k = 0; k < 6; ++k) {
      const double h = 1e-5;
      std::vector<Vec6> step(nodes, Vec6::Zero());
      step[node][k] = 1;
      RodState a = state, b = state;
      a.apply(step, h);
      b.apply(step, -h);
      const double up = difference(a, forward), down = difference(b, backward);
      CHECK((up - down) / (2 * h) == Approx(here[node][k]).margin(1e-8));
      const Vec6 column = (forward[node] - backward[node]) / (2 * h);
      // Gradients are in each state's own axes: the symmetric part of their change is the second derivative.
      const Mat6 second = with.diagonal[node] - without.diagonal[node];
      CHECK(column[k] == Approx(second(k, k)).margin(1e-7));
      for (int j = 0; j < 3; ++j) CHECK(column[j] == Approx(second(j, k)).margin(1e-7));
      for (int i = 0; i < nodes; ++i)
        if (i != node) CHECK(here[i].isZero(1e-12));
    }
  }
}

TEST_CASE("springs: what makes no sense is refused", "[springs]") {
  RodProblem problem = cantilever();
  problem.springs = {{2, Frame{}, 1, 0}};
  CHECK_THROWS_WITH(problem.check(), Catch::Contains("spring") && Catch::Contains("outside the rod"));
  problem.springs = {{0.1, Frame{}, -1, 0}};
  CHECK_THROWS_WITH(problem.check(), Catch::Contains("spring at 0.1 m"));
  problem.springs = {{0.1, Frame{}, 1, 0}};
  SolveOptions staggered;
  staggered.element = Element::staggered;
  CHECK_THROWS_WITH(solve(problem, staggered), Catch::Contains("at their ends only"));
}
