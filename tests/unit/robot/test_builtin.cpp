// The robot that comes with the program.
#include <catch2/catch.hpp>

#include "robot/inverse.h"
#include "robot/load_robot.h"
#include "robot/robot_collision.h"
#include "unit/robot/robots.h"

using namespace tendril;
using namespace tendril::test;

TEST_CASE("builtin:six_axis: its dimensions, meshes, kinematics", "[robot]") {
  const auto robot = load_robot("builtin:six_axis");
  CHECK(robot->size() == 6);
  CHECK(robot->links()[robot->tip()].name == "flange");
  const std::vector<double> zero(6, 0.0);
  const Frame flange = robot->link_frame(robot->tip(), zero);
  CHECK((flange.at - Vec3(0.35 + 0.3 + 0.82 + 0.195, 0, 0.35 + 0.43 + 1.02 + 0.215)).norm() < 1e-12);
  CHECK((flange.d3() - Vec3::UnitX()).norm() < 1e-12);
  for (int k = 0; k < 6; ++k) CHECK(robot->variable(k).velocity > 1);
  for (const Link& link : robot->links())
    for (const LinkShape& shape : link.collision) {
      const auto& surface = std::get<0>(shape.shape)->surface();
      CHECK(surface->topology().watertight());
      CHECK(surface->mesh().triangles.size() >= 1000);
      CHECK(surface->box().diagonal().norm() < 1.6);
    }
  // Stretched out level, the wrist centre is 2.51 m from the first axis.
  std::vector<double> stretched = zero;
  stretched[1] = units::pi / 2;
  stretched[2] = -std::atan2(1.12, 0.215);
  const Vec3 wrist = robot->link_frame(robot->link("link_5"), stretched).at;
  CHECK(std::hypot(wrist.x(), wrist.y()) == Approx(0.35 + 1.02 + std::hypot(1.12, 0.215)));
}

TEST_CASE("builtin:six_axis: solved in closed form all over its limits", "[robot]") {
  const auto robot = load_robot("builtin:six_axis");
  const InverseKinematics inverse(robot, robot->tip());
  REQUIRE(inverse.closed_form());
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    const std::vector<double> q = random_values(*robot, random);
    const Frame target = robot->link_frame(robot->tip(), q);
    const InverseResult result = inverse.solve(target, {.near = q});
    REQUIRE_FALSE(result.solutions.empty());
    for (std::size_t k = 0; k < q.size(); ++k) CHECK(std::abs(result.solutions[0][k] - q[k]) < 1e-6);
    for (const auto& solution : result.solutions) {
      CHECK(inverse.residual(solution, target) < 1e-9);
      CHECK(robot->within_limits(solution));
    }
  }
}

TEST_CASE("builtin:six_axis: clear of itself where it should be", "[robot]") {
  const auto robot = load_robot("builtin:six_axis");
  const RobotCollision collision(robot);
  for (const LinkPair& pair : collision.pairs()) CHECK(pair.kind != PairKind::always);
  CHECK_FALSE(collision.any(std::vector<double>(6, 0.0)));
  for (int k : {0, 3, 5})  // these turn on the spot
    for (double at : {robot->lower()[k], robot->upper()[k]}) {
      std::vector<double> q(6, 0.0);
      q[k] = at;
      CHECK_FALSE(collision.any(q));
    }
  for (double at : {robot->lower()[4], robot->upper()[4]})
    for (double turn : {0.0, 0.3, 0.7}) CHECK_FALSE(collision.any(std::vector<double>{0, 0, 0, turn, at, turn}));
  // Folded back, the wrist's motors hit the motor of the first axis.
  CHECK(collision.any(std::vector<double>{0, -65 * units::deg, -100 * units::deg, 0, 0.3, 0}));
  RobotCollision in_cell(robot);
  in_cell.add_obstacle(Solid(HalfSpace{}), {});
  CHECK_FALSE(in_cell.any(std::vector<double>(6, 0.0)));
  CHECK(in_cell.any(std::vector<double>{0, 85 * units::deg, 0.3, 0, 0, 0}));  // into the ground
}
