// Dress packs in motion: equilibria along a path, snap-throughs, surroundings.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "geometry/surroundings.h"
#include "method/dress_pack/pack_simulation.h"
#include "statics/solve.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

/// A strip clamped at both ends, bent into an arch in the plane x, y; the robot turns its finish about z.
PackProblem arch() {
  PackProblem pack;
  std::vector<Joint> joints(2);
  joints[0] = {"turn", JointKind::revolute, 0, {{0.9, 0, 0}, Quat::Identity()}, Vec3::UnitZ(), -2, 2};
  joints[1] = {"tip", JointKind::fixed, 1};
  pack.robot = std::make_shared<const Robot>("turner", named_links(3), joints);
  RodProblem strip = hose(1, 20);
  strip.gravity.setZero();
  Section section = hose_section();
  section.EI1 = 200;  // about d1: out of the plane
  section.GJ = 200;
  strip.rod = Rod::uniform(1, section, 20);
  // d1 in the plane, d2 along z: the soft bending, about d2, is that of the plane.
  const auto clamp = [](const Vec3& at, double angle) {
    return Frame::looking(at, {std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0});
  };
  strip.holds = {{0, clamp({0, 0, 0}, 0.15)}, {1, {}}};
  pack.rods = {strip};
  pack.attachments = {{0, 1, 1, clamp({0, 0, 0}, 0)}};
  return pack;
}

}  // namespace

TEST_CASE("motion of a pack: every step is an equilibrium, and balances", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  const PackMotion motion = simulate(pack, problematic_path());
  REQUIRE(motion.ok());
  CHECK(motion.message == "solved");
  REQUIRE(motion.steps.size() == 41);
  CHECK(motion.snaps.empty());
  const double weight = pack.rods[0].rod.mass() * 9.81;
  for (const PackStep& step : motion.steps) {
    CAPTURE(step.t);
    CHECK(step.residual < 1e-5);
    // What the ends exert carries the weight, and turns nothing.
    const Vec3 force = step.ends[0].force + step.ends[1].force;
    CHECK((force - Vec3(0, 0, weight)).norm() < 1e-6 * weight);
    // Ends are where the links are.
    const std::vector<Frame> poses = pack.poses(step.q);
    CHECK((step.state.r.front() - poses[0].at).norm() < 1e-12);
    CHECK((step.state.r.back() - poses[1].at).norm() < 1e-12);
    CHECK(step.q == problematic_path().at(step.t));
  }
}

TEST_CASE("motion of a pack: the same ends and the same worst force by any number of steps", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  const PackMotion few = simulate(pack, problematic_path(), {5}), many = simulate(pack, problematic_path(), {80});
  REQUIRE(few.ok());
  REQUIRE(many.ok());
  for (std::size_t k = 0; k < few.steps.size(); ++k)
    for (std::size_t i = 0; i < few.steps[k].state.r.size(); ++i)
      CHECK((few.steps[k].state.r[i] - many.steps[16 * k].state.r[i]).norm() < 1e-7);
  const PackMotion finer = simulate(pack, problematic_path(), {160});
  CHECK(finer.largest_end_force() == Approx(many.largest_end_force()).epsilon(0.01));
  CHECK(finer.smallest_bend_radius() == Approx(many.smallest_bend_radius()).epsilon(0.01));
}

TEST_CASE("motion of a pack: the twist that the hand winds in stays in", "[dress_pack]") {
  // A straight hose along the last axis, weightless: six turns by 170 degrees would be lost by a solver that starts anew.
  std::vector<Joint> joints = {{"roll", JointKind::continuous, 0, {}, Vec3::UnitX()}};
  PackProblem pack;
  pack.robot = std::make_shared<const Robot>("roller", named_links(2), joints);
  pack.rods = {hose(1, 16)};
  pack.rods[0].gravity.setZero();
  pack.attachments = {{0, 0, 0, Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1})}, {0, 1, 1, Frame::looking({1.02, 0, 0}, {1, 0, 0}, {0, 0, 1})}};
  JointVector none(1), wound(1);
  none << 0;
  wound << 7;
  const PackMotion motion = simulate(pack, JointPath({none, wound}), {10});
  REQUIRE(motion.ok());
  for (const PackStep& step : motion.steps) {
    CHECK(step.rods[0].twist == Approx(step.q[0]).margin(1e-9));
    // 2 % stretch: EA times that, and the twist's torque, 1.4 N m a rad/m.
    CHECK(step.rods[0].tension == Approx(400).epsilon(1e-6));
    CHECK(step.ends[1].moment.x() == Approx(1.4 * step.q[0]).margin(1e-6));
    CHECK(step.ends[1].force.x() == Approx(400).epsilon(1e-6));
  }
  CHECK(motion.largest_twist() == Approx(7));
}

TEST_CASE("motion of a pack: a robot and its pack turned about gravity feel the same", "[dress_pack]") {
  PackProblem pack = six_axis_pack();
  const PackMotion here = simulate(pack, problematic_path(), {10});
  pack.base = {{3, -2, 0.5}, exp_rotation({0, 0, 1.1})};
  const PackMotion there = simulate(pack, problematic_path(), {10});
  REQUIRE(here.ok());
  REQUIRE(there.ok());
  for (std::size_t k = 0; k < here.steps.size(); ++k) {
    CHECK(there.steps[k].ends[1].force.norm() == Approx(here.steps[k].ends[1].force.norm()).epsilon(1e-6));
    CHECK(there.steps[k].rods[0].bend_radius == Approx(here.steps[k].rods[0].bend_radius).epsilon(1e-6));
  }
}

TEST_CASE("motion of a pack: an arch that snaps through is found, whatever the steps", "[dress_pack]") {
  const PackProblem pack = arch();
  JointVector up(1), down(1);
  up << -0.15;
  down << 1.6;
  double at = -1;
  for (const int steps : {7, 20, 100}) {
    CAPTURE(steps);
    const PackMotion motion = simulate(pack, JointPath({up, down}), {steps});
    INFO(motion.message);
    REQUIRE(motion.ok());
    REQUIRE(motion.snaps.size() == 1);
    CHECK_THAT(motion.message, Contains("with 1 snap-through"));
    CHECK(motion.snaps[0].energy_drop > 0);
    CHECK(motion.snaps[0].move > 0.05);
    if (at >= 0) CHECK(motion.snaps[0].t == Approx(at).margin(1e-3));
    at = motion.snaps[0].t;
    for (const PackStep& step : motion.steps) CHECK(step.residual < 1e-5);
    // It was above the line between its ends, and ends below it.
    CHECK(motion.steps.front().state.r[10].y() > 0.1);
    CHECK(motion.steps.back().state.r[10].y() < -0.05);
  }
}

TEST_CASE("motion of a pack: what it cannot do is refused or said", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  const JointVector rest = degrees({0, 0, 0, 0, 30, 0});
  const PackMotion beyond = simulate(pack, JointPath({rest, degrees({0, 0, 0, 200, 30, 0})}));
  CHECK(beyond.status == Status::infeasible);
  CHECK(beyond.steps.empty());
  CHECK_THAT(beyond.message, Contains("via point 1") && Contains("joint_4"));
  const JointPath path({rest, rest});
  CHECK_THROWS_WITH(simulate(pack, path, {0}), Contains("0 time steps, expected at least 1"));
  CHECK_THROWS_WITH(simulate(pack, path, {5, -1}), Contains("motions of 0.0001 to -1 rad"));
  CHECK_THROWS_WITH(simulate(pack, path, {5, 0.2, 1e-4, 0}), Contains("a tolerance of 0"));
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(simulate(pack, path, {}, context).status == Status::cancelled);
  // A robot that stands still.
  const PackMotion still = simulate(pack, JointPath({rest}), {3});
  REQUIRE(still.ok());
  for (const PackStep& step : still.steps) {
    double off = 0;
    for (std::size_t i = 0; i < step.state.r.size(); ++i) off = std::max(off, (step.state.r[i] - still.steps[0].state.r[i]).norm());
    CHECK(off < 1e-8);
  }
}

TEST_CASE("motion of a pack: surroundings far away change nothing", "[dress_pack]") {
  PackProblem pack = six_axis_pack();
  const PackMotion free = simulate(pack, problematic_path(), {5});
  pack.bodies = {{{Sphere{0.2}, {{0, 0, 9}, Quat::Identity()}, 0, "lamp"}}};
  const PackMotion among = simulate(pack, problematic_path(), {5});
  REQUIRE(free.ok());
  REQUIRE(among.ok());
  for (std::size_t k = 0; k < free.steps.size(); ++k) {
    CHECK((free.steps[k].ends[1].force - among.steps[k].ends[1].force).norm() < 1e-4 * free.steps[k].ends[1].force.norm());
    CHECK(among.steps[k].rods[0].clearance == INFINITY);
  }
}

TEST_CASE("motion of a pack: a hose that is lowered onto a table lies on it", "[dress_pack]") {
  PackProblem pack = six_axis_pack(20);
  const JointPath path({degrees({0, -10, 0, 0, 0, 0}), degrees({0, 4, 0, 90, 0, 0})});
  const PackMotion free = simulate(pack, path, {8});
  pack.bodies = {{{HalfSpace{}, {{0, 0, 1.75}, Quat::Identity()}, 0, "table"}}};
  const PackMotion on_table = simulate(pack, path, {8});
  REQUIRE(free.ok());
  REQUIRE(on_table.ok());
  double lowest = INFINITY;
  for (const PackStep& step : free.steps)
    for (const Vec3& r : step.state.r) lowest = std::min(lowest, r.z());
  REQUIRE(lowest < 1.74);  // without the table it would hang through
  CHECK(on_table.smallest_clearance() > -1e-3 * 0.015);
  CHECK(on_table.smallest_clearance() < 1e-3);
}
