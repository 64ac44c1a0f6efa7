#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "statics/solve.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

RodProblem good_problem() {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), 20);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

void refuses(const RodProblem& problem, const char* reason) {
  CHECK_THROWS_AS(problem.check(), UsageError);
  CHECK_THROWS_WITH(problem.check(), Contains(reason));
  CHECK_THROWS_WITH(solve(problem), Contains(reason));
}

}  // namespace

TEST_CASE("problem: a good one passes") { CHECK_NOTHROW(good_problem().check()); }

TEST_CASE("problem: holds") {
  RodProblem problem = good_problem();
  problem.holds.clear();
  refuses(problem, "not held at any place");
  problem = good_problem();
  for (Hold& hold : problem.holds) hold.position = false;
  refuses(problem, "not held at any place");
  for (const double place : {-0.1, 1.3, not_a_number, double(INFINITY)}) {
    problem = good_problem();
    problem.holds[1].at = place;
    refuses(problem, "lies outside the rod (0 to 1.2 m)");
  }
  problem = good_problem();
  problem.holds[1].frame.at.y() = not_a_number;
  refuses(problem, "finite numbers");
  problem = good_problem();
  problem.holds[1].frame.rotation.x() = INFINITY;
  refuses(problem, "finite numbers");
  problem = good_problem();
  problem.holds[1].turns = not_a_number;
  refuses(problem, "finite numbers");
  problem = good_problem();
  problem.holds.push_back(problem.holds[0]);
  refuses(problem, "contradict each other");
  // Position and orientation of one place may be held apart.
  problem = good_problem();
  problem.holds[1].orientation = false;
  problem.holds.push_back({1.2, problem.holds[1].frame, false, true});
  CHECK_NOTHROW(problem.check());
}

TEST_CASE("problem: loads, gravity and weight") {
  RodProblem problem = good_problem();
  problem.loads = {{1.5, {0, 0, 1}, Vec3::Zero()}};
  refuses(problem, "load at arc length 1.5 m lies outside");
  problem.loads = {{0.5, {0, 0, not_a_number}, Vec3::Zero()}};
  refuses(problem, "force and moment must be finite");
  problem.loads = {{0.5, Vec3::Zero(), {INFINITY, 0, 0}}};
  refuses(problem, "force and moment must be finite");
  problem = good_problem();
  problem.gravity.x() = not_a_number;
  refuses(problem, "gravity must be three finite numbers");
  problem = good_problem();
  problem.rod.parts[0].section.mass = 1e6;
  refuses(problem, "stretch stiffness EA");
}

TEST_CASE("problem: the rod itself") {
  RodProblem problem = good_problem();
  problem.rod.segments = 0;
  refuses(problem, "'segments' is 0");
  problem = good_problem();
  problem.rod.length = -1;
  refuses(problem, "'length'");
  problem = good_problem();
  problem.rod.parts[0].section.EI1 = 0;
  refuses(problem, "'EI (about d1)' is 0");
}
