// Where straight rods buckle, where planar ones leave their plane: the sign of stability on both sides of known limits.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "validation/reference.h"

using namespace tendril;
using namespace tendril::validation;

namespace {

enum class Ends { clamped_free, pinned_pinned, clamped_clamped };

struct BucklingLoad {
  double radius, shear_factor;
  Ends ends;
  double load;  ///< N, with shear and compression; E = 5 MPa, nu = 0.5, length 1 m
};

const BucklingLoad buckling_loads[] = {
    {0.005, 1, Ends::clamped_free, 0.00605572664604891},       {0.005, 1, Ends::pinned_pinned, 0.02422066592014893},
    {0.005, 1, Ends::clamped_clamped, 0.09684684618413035},    {0.05, 1, Ends::clamped_free, 60.373497891090615},
    {0.05, 1, Ends::pinned_pinned, 239.31960221617248},        {0.05, 1, Ends::clamped_clamped, 925.33769911461},
    {0.05, 5.0 / 6, Ends::clamped_free, 60.31824850364547},    {0.05, 5.0 / 6, Ends::pinned_pinned, 238.47135518982648},
    {0.05, 5.0 / 6, Ends::clamped_clamped, 913.6751731769111},
};

/// A straight rod along its own axes with vertices at s (1 - shortening) and a twist of `turn` rad over its length.
Equilibrium straight(double length, int segments, double shortening, double turn) {
  Equilibrium e;
  for (int i = 0; i <= segments; ++i) {
    const double s = length * i / segments;
    e.s.push_back(s);
    e.points.push_back({0, 0, s * (1 - shortening)});
    e.rotations.push_back(exp_rotation(Vec3(0, 0, turn * i / segments)));
  }
  return e;
}

/// Negative directions of the straight rod under an axial load; held ends are moved to where that load is.
int negative_directions(const BucklingLoad& row, double load, const Method& method, int segments) {
  const double diameter = 2 * row.radius;
  const Section section = Section::round(diameter, 0, Material::from_poisson(5e6, 0.5, 0), row.shear_factor);
  RodProblem problem;
  problem.rod = Rod::uniform(1, section, segments);
  const double shortening = load / section.EA;
  const bool clamped = row.ends != Ends::pinned_pinned;
  problem.holds = {{0, Frame{}, true, clamped}};
  if (row.ends == Ends::clamped_free)
    problem.loads = {{1, {0, 0, -load}, Vec3::Zero()}};
  else
    problem.holds.push_back({1, Frame{{0, 0, 1 - shortening}, Quat::Identity()}, true, clamped});
  SolveOptions options = method.options();
  options.stable_only = false;
  const Equilibrium start = straight(1, segments, shortening, 0);
  const Equilibrium e = solve(problem, options, {}, &start);
  REQUIRE(e.status == Status::solved);
  for (const Vec3& p : e.points) CHECK(std::hypot(p.x(), p.y()) < 1e-6);  // still straight
  return e.negative_pivots;
}

/// Negative directions of a straight, twisted rod under tension between clamps; EI = L = 1.
int negative_when_twisted(double tension, double turn, double torsion, const Method& method, int segments) {
  Section section;
  section.outer = 0.01;
  section.EI1 = section.EI2 = 1;
  section.GJ = torsion;
  section.GA1 = section.GA2 = section.EA = 1e8;
  RodProblem problem;
  problem.rod = Rod::uniform(1, section, segments);
  const double shortening = -tension / section.EA;
  problem.holds = {{0, Frame{}}, {1, Frame{{0, 0, 1 - shortening}, exp_rotation(Vec3(0, 0, turn))}}};
  SolveOptions options = method.options();
  options.stable_only = false;
  options.tolerance = 1e-9;
  const Equilibrium start = straight(1, segments, shortening, turn);
  const Equilibrium e = solve(problem, options, {}, &start);
  REQUIRE(e.status == Status::solved);
  return e.negative_pivots;
}

}  // namespace

TEST_CASE("straight rods buckle at Euler's load with shear and compression") {
  for (const BucklingLoad& row : buckling_loads) {
    CAPTURE(row.radius, row.shear_factor, static_cast<int>(row.ends));
    // Isotropic: both directions buckle at once. A pinned rod is also free to spin: one direction is neutral.
    const int neutral = row.ends == Ends::pinned_pinned ? 1 : 0;
    CHECK(negative_directions(row, 0.9999 * row.load, se3, 80) <= neutral);
    CHECK(negative_directions(row, 1.0001 * row.load, se3, 80) >= 2);
    CHECK(negative_directions(row, 0.998 * row.load, staggered, 80) <= neutral);
    CHECK(negative_directions(row, 1.002 * row.load, staggered, 80) >= 2);
  }
}

TEST_CASE("straight rods under tension and twist buckle at the critical rotation") {
  struct Row {
    double tension, moment;
  };
  for (const Row& row : {Row{-30, 3.8004296234800794}, Row{-20, 5.77113570332134}, Row{-10, 7.451015644297791},
                         Row{0, 8.986818915669764}, Row{10, 10.428856439276949}, Row{50, 15.589323932753883},
                         Row{100, 20.983500828140517}})
    for (const double torsion : {5.0 / 7, 2.0 / 3, 1.0}) {
      const double turn = row.moment / torsion;
      CAPTURE(row.tension, torsion);
      CHECK(negative_when_twisted(row.tension, 0.999 * turn, torsion, se3, 80) == 0);
      CHECK(negative_when_twisted(row.tension, 1.001 * turn, torsion, se3, 80) > 0);
      CHECK(negative_when_twisted(row.tension, 0.98 * turn, torsion, staggered, 80) == 0);
      CHECK(negative_when_twisted(row.tension, 1.02 * turn, torsion, staggered, 80) > 0);
    }
}

TEST_CASE("the planar clamped elastica leaves its plane at the known end shortening") {
  struct Row {
    double torsion, shortening;
  };
  for (const Row& row : {Row{1.0 / 2, 0.49015395205312395}, Row{2.0 / 3, 0.5426730973477729},
                         Row{5.0 / 7, 0.5589543202793759}, Row{1.0, 0.6666666666666682}})
    for (const double away : {-0.01, 0.01}) {
      Section section;
      section.outer = 0.01;
      section.EI1 = section.EI2 = 1;
      section.GJ = row.torsion;
      section.GA1 = section.GA2 = section.EA = 1e8;
      RodProblem problem;
      problem.rod = Rod::uniform(1, section, 80);
      problem.holds = {{0, Frame{}}, {1, Frame{{0, 0, 1 - row.shortening - away}, Quat::Identity()}}};
      const Equilibrium e = solve(problem);
      CAPTURE(row.torsion, away, e.message, e.iterations, e.energy.twist);
      REQUIRE(e.status == Status::solved);
      CHECK(e.stable);
      if (away < 0) CHECK(e.energy.twist < 1e-9 * e.energy.bend);
      if (away > 0) CHECK(e.energy.twist > 1e-3 * e.energy.bend);
    }
}
