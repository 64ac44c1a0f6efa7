#include <catch2/catch.hpp>

#include "base/units.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

Rod cable(double length, int segments) {
  Rod rod;
  rod.length = length;
  rod.segments = segments;
  Section section;
  section.EI1 = section.EI2 = 0.01;
  section.GJ = 0.007;
  section.EA = 5000;
  section.GA1 = section.GA2 = 1700;
  section.mass = 0.15;
  section.outer = 0.012;
  rod.parts = {{length, section}};
  return rod;
}

Frame along_x(double x, double z) { return Frame::looking({x, 0, z}, Vec3::UnitX()); }

SystemProblem clipped(double at, double clip_x, double end_x) {
  SystemProblem problem;
  problem.rods.resize(1);
  RodProblem& rod = problem.rods[0];
  rod.rod = cable(1, 48);
  rod.gravity = {0, 0, -9.81};
  Hold clip{at, along_x(clip_x, 0)};
  clip.slide = true;
  rod.holds = {{0, along_x(0, 0)}, clip, {1, along_x(end_x, 0)}};
  return problem;
}

/// n . r' + m . Omega - W at a clip's two sides, extrapolated linearly from the two nearest segments.
double side(const Equilibrium& eq, const Rod& rod, std::size_t first, std::size_t second) {
  const auto at = [&](std::size_t i) {
    const Section& section = rod.parts[0].section;
    const Quat middle = eq.rotations[i].slerp(0.5, eq.rotations[i + 1]);
    const Vec3 n = middle.conjugate() * eq.forces[i];
    const Vec3 gamma = eq.strains[i] + Vec3::UnitZ(), m = eq.moments[i];
    const double stored = 0.5 * (n.x() * n.x() / section.GA1 + n.y() * n.y() / section.GA2 + n.z() * n.z() / section.EA +
                                 m.x() * m.x() / section.EI1 + m.y() * m.y() / section.EI2 + m.z() * m.z() / section.GJ);
    return n.dot(gamma) + m.dot(eq.curvatures[i]) - stored;
  };
  return 1.5 * at(first) - 0.5 * at(second);
}

}  // namespace

TEST_CASE("slide clip: between two equal, nearly taut spans the rod settles in the middle", "[statics]") {
  const SystemEquilibrium eq = solve(clipped(0.495, 0.49, 0.98));
  REQUIRE(eq.ok());
  CHECK(eq.rods[0].stable);
  CHECK(eq.rods[0].reactions[1].s == Approx(0.5).margin(1e-7));
  // Nothing pulls the clip along, as both sides pull alike.
  CHECK(std::abs(eq.rods[0].reactions[1].force.x()) < 1e-6);
  const Vec3 support = eq.rods[0].reactions[0].force + eq.rods[0].reactions[1].force + eq.rods[0].reactions[2].force;
  CHECK((support - Vec3(0, 0, 0.15 * 9.81)).norm() < 1e-8);
}

TEST_CASE("slide clip: breaks of the shape under the clip and around it change nothing", "[statics]") {
  const SystemProblem plain = clipped(0.45, 0.44, 0.98);
  SystemProblem broken = plain;
  for (int k = 1; k < 20; ++k) broken.rods[0].rod.shape_breaks.push_back(0.05 * k);  // of a straight shape: no break at all
  const SystemEquilibrium a = solve(plain), b = solve(broken);
  REQUIRE(a.ok());
  REQUIRE(b.ok());
  CHECK(b.rods[0].reactions[1].s == Approx(a.rods[0].reactions[1].s).margin(1e-9));
  CHECK(b.energy() == Approx(a.energy()).epsilon(1e-10));
  Vec3 support = Vec3::Zero();
  for (const auto& reaction : b.rods[0].reactions) support += reaction.force;
  CHECK((support - Vec3(0, 0, 0.15 * 9.81)).norm() < 1e-8);
}

TEST_CASE("slide clip: one where something else needs a vertex is refused by name", "[statics]") {
  SystemProblem problem = clipped(0.45, 0.44, 0.98);
  problem.rods[0].loads.push_back({0.45, {0, 0, -1}, Vec3::Zero()});
  const SystemEquilibrium eq = solve(problem);
  CHECK(eq.rods[0].status == Status::infeasible);
  CHECK(eq.rods[0].message == "the clip at 0.45 m, through which the rod slips, lies where a load acts, the section changes or rods are joined: "
                              "put it a little beside");
  problem.rods[0].loads[0].at = 0.47;
  CHECK(solve(problem).ok());
}

TEST_CASE("slide clip: the configurational force is the same on both sides", "[statics]") {
  const SystemProblem problem = clipped(0.45, 0.44, 0.98);
  const SystemEquilibrium eq = solve(problem);
  REQUIRE(eq.ok());
  const Equilibrium& rod = eq.rods[0];
  std::size_t clip = 0;
  while (rod.s[clip] < rod.reactions[1].s - 1e-9) ++clip;
  CHECK(std::abs(rod.reactions[1].s - 0.45) > 1e-3);
  const double before = side(rod, problem.rods[0].rod, clip - 1, clip - 2), after = side(rod, problem.rods[0].rod, clip, clip + 1);
  // What the clip pushes along the rod is the jump of M^2/2EI: without it the two sides would differ by so much.
  const double force = rod.reactions[1].force.x();
  CAPTURE(rod.reactions[1].s, before, after);
  CHECK(std::abs(before - after) < 0.02 * std::abs(force));
}

TEST_CASE("slide clip: where it began does not matter, and a small error estimate says so", "[statics]") {
  SolveOptions options;
  options.error = true;
  const SystemEquilibrium a = solve(clipped(0.45, 0.44, 0.98), options), b = solve(clipped(0.46, 0.44, 0.98), options);
  REQUIRE(a.ok());
  REQUIRE(b.ok());
  // The meshes differ: up to the discretisation error.
  CHECK(a.rods[0].reactions[1].s == Approx(b.rods[0].reactions[1].s).margin(2e-4));
  REQUIRE(a.rods[0].error);
  CHECK(a.rods[0].error->value < 1e-4);
  const SystemEquilibrium again = solve(clipped(0.45, 0.44, 0.98), {}, {}, &a);
  CHECK(again.rods[0].reactions[1].s == Approx(a.rods[0].reactions[1].s).margin(1e-8));
}

TEST_CASE("slide clip: a rod that nothing else holds slides out, and the message says so", "[statics]") {
  SystemProblem problem = clipped(0.5, 0, 0);
  RodProblem& rod = problem.rods[0];
  rod.holds.erase(rod.holds.begin());
  rod.holds.pop_back();
  rod.holds[0].frame = Frame::looking({0, 0, 0}, -Vec3::UnitZ());
  const SystemEquilibrium eq = solve(problem);
  CHECK(eq.rods[0].status == Status::infeasible);
  CHECK_THAT(eq.rods[0].message, Catch::Contains("slides out of the clip that was put at 0.5 m"));
}
