#include <catch2/catch.hpp>

#include "base/units.h"
#include "statics/motion.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

Rod strip(double length, int segments) {
  Rod rod;
  rod.length = length;
  rod.segments = segments;
  Section section;
  section.EI1 = 0.1;  // stiff out of the plane that it snaps in
  section.EI2 = 0.002;
  section.GJ = 0.05;
  section.EA = 2000;
  section.GA1 = section.GA2 = 800;
  section.mass = 0.05;
  section.outer = 0.01;
  rod.parts = {{length, section}};
  return rod;
}

/// d1 = +z, d3 = +x turned by `angle` in the plane of x and z, upwards.
Frame tilted(double x, double angle) {
  return Frame::looking({x, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {-std::sin(angle), 0, std::cos(angle)});
}

/// An arch between two clamps that tilt from upwards to downwards.
SystemProblem arch(double angle) {
  SystemProblem problem;
  problem.rods.resize(1);
  problem.rods[0].rod = strip(0.5, 40);
  problem.rods[0].holds = {{0, tilted(0, angle)}, {0.5, tilted(0.46, -angle)}};
  return problem;
}

}  // namespace

TEST_CASE("motion: an arch whose clamps are turned over snaps once, later on each way than symmetry would have it", "[statics]") {
  const double most = 60 * units::deg;
  const auto tilt = [&](double t) { return most * (1 - 2 * t); };
  const std::vector<HeldPath> paths = {{0, 0, -1, [&](double t) { return tilted(0, tilt(t)); }},
                                       {0, 1, -1, [&](double t) { return tilted(0.46, -tilt(t)); }}};
  const Motion motion = move_holds(arch(most), paths, {}, {}, {});
  REQUIRE(motion.ok());
  REQUIRE(motion.snaps.size() == 1);
  const SnapThrough& snap = motion.snaps[0];
  CHECK(snap.t > 0.5);
  CHECK(snap.energy_drop > 0);
  CHECK(snap.move > 0.05);
  CHECK(snap.s == Approx(0.25).margin(0.1));
  CHECK_THAT(motion.message, Catch::Contains("1 snap-through"));
  CHECK(motion.steps.front().equilibrium.rods[0].points[20].z() > 0.05);
  CHECK(motion.steps.back().equilibrium.rods[0].points[20].z() < -0.05);
  for (const MotionStep& step : motion.steps) CHECK(step.equilibrium.rods[0].stable);
  // At half the largest move the snap is at the same place.
  MotionOptions finer;
  finer.largest_move = 0.01;
  const Motion again = move_holds(arch(most), paths, finer, {}, {});
  REQUIRE(again.snaps.size() == 1);
  CHECK(again.snaps[0].t == Approx(snap.t).margin(3e-4));
}

TEST_CASE("motion: a hose that is moved without a snap ends where a cold solve ends", "[statics]") {
  SystemProblem problem = arch(0.4);
  problem.rods[0].gravity = {0, 0, -9.81};
  const auto path = [](double t) { return Frame{{0.46 - 0.1 * t, 0.05 * t, 0.1 * t}, tilted(0, -0.4).rotation}; };
  MotionOptions motion;
  motion.steps = 7;
  const Motion moved = move_holds(problem, {{0, 1, -1, path}}, motion, {}, {});
  REQUIRE(moved.ok());
  CHECK(moved.snaps.empty());
  CHECK(moved.message == "solved");
  REQUIRE(moved.steps.size() == 8);
  problem.rods[0].holds[1].frame = path(1);
  const SystemEquilibrium cold = solve(problem);
  const Equilibrium& last = moved.steps.back().equilibrium.rods[0];
  for (std::size_t i = 0; i < last.points.size(); ++i) CHECK((last.points[i] - cold.rods[0].points[i]).norm() < 1e-7);
}

TEST_CASE("motion: a way that tears the rod ends with the time it came to, and bad input is refused", "[statics]") {
  const auto away = [](double t) { return tilted(0.46 + 1e3 * t, 0); };
  RunContext context;
  context.deadline = RunContext::Clock::now() + std::chrono::seconds(20);
  const Motion torn = move_holds(arch(0), {{0, 1, -1, away}}, {}, {}, context);
  CHECK(!torn.steps.empty());
  CHECK_THROWS_WITH(move_holds(arch(0), {}, {}, {}, {}), Catch::Contains("no hold moves"));
  CHECK_THROWS_WITH(move_holds(arch(0), {{0, 5, -1, away}}, {}, {}, {}), Catch::Contains("does not have"));
  CHECK_THROWS_WITH(move_holds(arch(0), {{0, 1, -1, [](double) { return Frame{{NAN, 0, 0}, Quat::Identity()}; }}}, {}, {}, {}),
                    Catch::Contains("not finite"));
  MotionOptions none;
  none.steps = 0;
  CHECK_THROWS_WITH(move_holds(arch(0), {{0, 1, -1, away}}, none, {}, {}), Catch::Contains("expected at least 1"));
}
