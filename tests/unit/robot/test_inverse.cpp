// Inverse kinematics: every solution reproduces its frame, and no branch is missed.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "robot/inverse.h"
#include "robot/urdf.h"
#include "unit/robot/arms.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;

namespace {

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * units::pi)); }

bool same_turned(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (angle_between(a[k], b[k]) > tolerance) return false;
  return true;
}

bool holds(const std::vector<std::vector<double>>& list, const std::vector<double>& q, double tolerance) {
  return std::any_of(list.begin(), list.end(), [&](const auto& other) { return same_turned(other, q, tolerance); });
}

void check_solutions(const Robot& robot, const InverseKinematics& inverse, const Frame& target, const InverseResult& result,
                     bool limits = true) {
  for (const auto& q : result.solutions) {
    CHECK(inverse.residual(q, target) < 1e-9);
    if (limits) CHECK(robot.within_limits(q));
  }
}

}  // namespace

TEST_CASE("closed form: FK(IK(frame)) is the frame, and the values it was made of are among the solutions", "[robot]") {
  int most = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto robot = seed == 1 ? arm() : random_arm(random);
    const InverseKinematics inverse(robot, robot->tip());
    INFO(inverse.why_not_closed_form());
    REQUIRE(inverse.closed_form());
    for (int i = 0; i < 40; ++i) {
      const std::vector<double> q = random_values(*robot, random);
      const Frame target = robot->link_frame(robot->tip(), q);
      const InverseResult result = inverse.solve(target);
      CHECK(result.status == Status::solved);
      CHECK(result.closed_form);
      CHECK_FALSE(result.solutions.empty());
      CHECK(result.solutions.size() <= 8);
      check_solutions(*robot, inverse, target, result);
      CHECK(holds(result.solutions, q, 1e-6));
      most = std::max(most, static_cast<int>(result.solutions.size()));
    }
  }
  CHECK(most == 8);
}

TEST_CASE("closed form: every branch that a numeric search finds is there, and each differs from the others", "[robot]") {
  int branches = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto robot = random_arm(random);
    const InverseKinematics inverse(robot, robot->tip());
    const Frame target = robot->link_frame(robot->tip(), random_values(*robot, random));
    const InverseResult closed = inverse.solve(target);
    RunContext context;
    context.seed = seed;
    const InverseResult numeric = inverse.solve(target, {.numeric = true, .starts = 250}, context);
    CHECK_FALSE(numeric.closed_form);
    check_solutions(*robot, inverse, target, numeric);
    for (const auto& q : numeric.solutions) CHECK(holds(closed.solutions, q, 1e-5));
    for (const auto& q : closed.solutions) CHECK(holds(numeric.solutions, q, 1e-5));
    for (std::size_t i = 0; i < closed.solutions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(same_turned(closed.solutions[i], closed.solutions[j], 1e-4));
    branches += static_cast<int>(closed.solutions.size());
  }
  CHECK(branches >= 40);
}

TEST_CASE("closed form: the numeric solver's view of the real arm", "[robot][real]") {
  const std::string file = real_robot();
  if (file.empty()) {
    WARN("no shared robots here: skipped");
    return;
  }
  const auto robot = load_urdf(file);
  const InverseKinematics inverse(robot, robot->link("tool0"));
  REQUIRE(inverse.closed_form());
  Random random(5);
  std::size_t most = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const std::vector<double> q = random_values(*robot, random);
    const Frame target = robot->link_frame(robot->link("tool0"), q);
    const InverseResult result = inverse.solve(target, {.near = q});
    REQUIRE_FALSE(result.solutions.empty());
    check_solutions(*robot, inverse, target, result);
    for (std::size_t k = 0; k < q.size(); ++k) CHECK(std::abs(result.solutions[0][k] - q[k]) < 1e-6);
    most = std::max(most, result.solutions.size());
  }
  CHECK(most > 8);  // joints 4 and 6 have room for more than a turn
}

TEST_CASE("turns: all that fit the limits, nearest to the reference first", "[robot]") {
  ArmShape shape;
  shape.limit = 1.5 * units::pi;
  const auto robot = arm(shape);
  const InverseKinematics inverse(robot, robot->tip());
  const std::vector<double> q = {0.3, 0.2, -0.4, 2.0, 1.0, -1.8};
  const Frame target = robot->link_frame(robot->tip(), q);
  const InverseResult all = inverse.solve(target, {.near = q});
  check_solutions(*robot, inverse, target, all);
  // Each base solution by itself: a joint at `a` fits twice when |a| > pi/2.
  const InverseResult one = inverse.solve(target, {.near = q, .turns = false});
  CHECK(one.solutions.size() <= 8);
  std::size_t expected = 0;
  for (const auto& s : one.solutions) {
    std::size_t ways = 1;
    for (double a : s) ways *= std::abs(std::remainder(a, 2 * units::pi)) >= units::pi / 2 ? 2 : 1;
    expected += ways;
  }
  CHECK(all.solutions.size() == expected);
  for (std::size_t i = 0; i < all.solutions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(all.solutions[i] != all.solutions[j]);
  CHECK(all.solutions[0][3] == Approx(2.0));
  double last = 0;
  for (const auto& s : all.solutions) {
    double distance = 0;
    for (int k = 0; k < 6; ++k) distance = std::max(distance, std::abs(s[k] - q[k]));
    CHECK(distance >= last);
    last = distance;
  }
  // A reference a turn away draws the answer there.
  std::vector<double> far = q;
  far[3] -= 2 * units::pi;
  CHECK(inverse.solve(target, {.near = far, .turns = false}).solutions[0][3] == Approx(2.0 - 2 * units::pi));
}

TEST_CASE("turns: a bounded number of them, whatever the limits", "[robot]") {
  ArmShape shape;
  const std::vector<double> q = {0.3, 0.2, -0.4, 2.0, 1.0, -1.8};
  for (double limit : {10.0, 17.0, 100.0}) {
    CAPTURE(limit);
    shape.limit = limit;
    const auto robot = arm(shape);
    const InverseKinematics inverse(robot, robot->tip());
    const Frame target = robot->link_frame(robot->tip(), q);
    const InverseResult all = inverse.solve(target, {.near = q});
    CHECK(all.solutions.size() <= 8000);
    CHECK(all.solutions.size() >= 4);
    check_solutions(*robot, inverse, target, all);
    for (int k = 0; k < 6; ++k) CHECK(all.solutions[0][k] == Approx(q[k]).margin(1e-9));
    // Seen from many turns away the limits are still kept.
    const InverseResult far = inverse.solve(target, {.near = std::vector<double>(6, 1000.0)});
    CHECK(far.status == Status::solved);
    check_solutions(*robot, inverse, target, far);
  }
}

TEST_CASE("numeric: an arm of a thousand joints", "[robot]") {
  std::vector<Joint> snake;
  for (int k = 0; k < 1000; ++k)
    snake.push_back({"j" + std::to_string(k),
                     JointKind::revolute,
                     k,
                     {{0, 0, k ? 0.01 : 0}, Quat::Identity()},
                     k % 2 ? Vec3::UnitX() : Vec3::UnitY(),
                     -7,
                     7});
  const auto robot = std::make_shared<const Robot>("snake", named_links(1001), snake);
  const InverseKinematics inverse(robot, 1000);
  const Frame target{{1, 2, 3}, Quat::Identity()};
  const InverseResult result = inverse.solve(target, {.starts = 3});
  REQUIRE(result.status == Status::solved);
  CHECK(result.solutions.size() <= 3);
  check_solutions(*robot, inverse, target, result);
}

TEST_CASE("out of reach: the reason has the numbers", "[robot]") {
  const auto robot = arm();
  const InverseKinematics inverse(robot, robot->tip());
  const InverseResult far = inverse.solve({{5, 0, 1}, Quat::Identity()});
  CHECK(far.status == Status::infeasible);
  CHECK(far.solutions.empty());
  CHECK_THAT(far.message, Contains("from the axis of 'joint_2', the arm reaches") && Contains("2.22712 m"));
  ArmShape sideways;
  sideways.elbow.y() = 0.2;  // the wrist keeps 0.2 m beside the plane of joint 1
  const auto odd = arm(sideways);
  const InverseKinematics beside(odd, odd->tip());
  const Frame flange{{0.05, 0, 1.5}, Quat::Identity()};
  const InverseResult within = beside.solve(flange);
  CHECK(within.status == Status::infeasible);
  CHECK_THAT(within.message, Contains("from the axis of 'joint_1', at least 0.2 m is needed"));
  CHECK_THROWS_WITH(inverse.solve({{std::nan(""), 0, 0}, Quat::Identity()}), Contains("no finite frame"));
  CHECK_THROWS_WITH(inverse.solve({}, {.near = {1, 2}}), Contains("near: got 2 joint values"));
  CHECK_THROWS_WITH(inverse.solve({}, {.starts = 0}), Contains("got 0 starts"));
  CHECK_THROWS_WITH(InverseKinematics(robot, 99), Contains("no link of the number 99"));
}

TEST_CASE("beyond the limits: told, and given without limits", "[robot]") {
  ArmShape shape;
  shape.limit = 0.5;
  const auto robot = arm(shape);
  const InverseKinematics inverse(robot, robot->tip());
  const std::vector<double> q = {0.2, 0.6, 0.1, 0.2, 0.3, 0.1};
  const Frame target = robot->link_frame(robot->tip(), q);
  const InverseResult limited = inverse.solve(target);
  CHECK(limited.status == Status::infeasible);
  CHECK_THAT(limited.message,
             Contains("beyond the joint limits in every way") && Contains("'joint_2' at 0.6, limits -0.5 ... 0.5"));
  const InverseResult free = inverse.solve(target, {.limits = false});
  CHECK(free.status == Status::solved);
  CHECK(holds(free.solutions, q, 1e-9));
  check_solutions(*robot, inverse, target, free, false);
  // At a limit exactly: rounding does not push it over.
  const std::vector<double> rim = {0.5, -0.5, 0.5, 0.5, 0.5, -0.5};
  const InverseResult at_rim = inverse.solve(robot->link_frame(robot->tip(), rim));
  CHECK(holds(at_rim.solutions, rim, 1e-9));
  check_solutions(*robot, inverse, robot->link_frame(robot->tip(), rim), at_rim);
}

TEST_CASE("singular poses: solved, with what is free", "[robot]") {
  const auto robot = arm();
  const InverseKinematics inverse(robot, robot->tip());
  const auto solve_at = [&](const std::vector<double>& q, const std::vector<double>& near) {
    const Frame target = robot->link_frame(robot->tip(), q);
    const InverseResult result = inverse.solve(target, {.near = near});
    CHECK(result.status == Status::solved);
    check_solutions(*robot, inverse, target, result);
    return result;
  };
  for (double off : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
    CAPTURE(off);
    const auto wrist = solve_at({0.1, 0.2, 0.3, 0.4, off, 0.6}, {0, 0, 0, 0.7, 0, 0});
    CHECK(wrist.singular == (off < 1e-6));
    if (off == 0) {
      CHECK_THAT(wrist.message, Contains("the wrist is stretched: 'joint_4' is free and stays at 0.7"));
      CHECK(wrist.solutions[0][3] == Approx(0.7));
      CHECK(std::abs(wrist.solutions[0][5] - 0.3) < 1e-7);  // on the fold an error of the frame counts as its root
    }
    // The elbow stretched: fore and upper arm in a line.
    const double stretched = std::atan2(1.16, 0.2) + off;
    const auto elbow = solve_at({0.1, 0.2, -stretched, 0.4, 0.5, 0.6}, {0, 0, 0, 0, 0, 0});
    if (off == 0) CHECK_THAT(elbow.message, Contains("'joint_3'") && Contains("stretched or folded"));
  }
  // Above the base: the wrist centre on axis 1. With q3 such that fore arm and upper arm lean back by 0.3 m.
  double low = -1.5, high = 0;
  const auto distance = [&](double q2) {
    const std::vector<double> q = {0, q2, 0.3, 0, 0, 0};
    return robot->link_frame(5, q).at.x();  // joint 5's frame lies in the wrist centre
  };
  REQUIRE(distance(low) < 0);
  REQUIRE(distance(high) > 0);
  for (int i = 0; i < 200; ++i) (distance((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  const auto above = solve_at({0.4, low, 0.3, 0.4, 0.5, 0.6}, {0.9, 0, 0, 0, 0, 0});
  CHECK(above.singular);
  CHECK_THAT(above.message, Contains("'joint_1' is free and stays at 0.9"));
  CHECK(above.solutions[0][0] == Approx(0.9));
}

TEST_CASE("arms of other kinds are told why they are solved numerically", "[robot]") {
  const auto of = [](const std::shared_ptr<const Robot>& robot) {
    return InverseKinematics(robot, robot->tip()).why_not_closed_form();
  };
  CHECK(of(arm()).empty());
  CHECK_THAT(of(std::make_shared<const Robot>(planar_arm({1, 1}))), Contains("2 joints move 'link_3', not six"));
  const auto changed = [&](auto change) {
    std::vector<Joint> joints = arm()->joints();
    change(joints);
    return std::make_shared<const Robot>("arm", named_links(joints.size() + 1), joints);
  };
  CHECK(of(changed([](auto& j) { j[5].origin.at.z() = 0.02; })) == "the last three axes do not meet in a point");
  CHECK(of(changed([](auto& j) { j[2].axis = Vec3(0.1, 1, 0).normalized(); })) == "axes 2 and 3 are not parallel");
  CHECK(of(changed([](auto& j) { j[2].kind = JointKind::prismatic; })) == "a joint shifts instead of turning");
  CHECK(of(changed([](auto& j) { j[2].origin.at.setZero(); })) == "axes 2 and 3 are one");
  CHECK(of(changed([](auto& j) { j[0].axis = Vec3::UnitY(); })) == "axes 1 and 2 are parallel");
  CHECK_THAT(of(changed([](auto& j) { j[5].mimics = 4; })), Contains("mimics"));
}

TEST_CASE("numeric: an arm with an offset wrist finds the values back; the same seed gives the same bits", "[robot]") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<Joint> joints = arm()->joints();
    joints[5].origin.at.z() = 0.08;
    const auto robot = std::make_shared<const Robot>("arm", named_links(joints.size() + 1), joints);
    const InverseKinematics inverse(robot, robot->tip());
    REQUIRE_FALSE(inverse.closed_form());
    const std::vector<double> q = random_values(*robot, random);
    const Frame target = robot->link_frame(robot->tip(), q);
    const InverseResult result = inverse.solve(target, {.starts = 600});
    CHECK(result.status == Status::solved);
    CHECK(holds(result.solutions, q, 1e-5));
    check_solutions(*robot, inverse, target, result);
    CHECK(inverse.solve(target, {.starts = 600}).solutions == result.solutions);
  }
}

TEST_CASE("numeric: shifts, redundant and short arms, and what is not to be found", "[robot]") {
  Random random(3);
  // Three shifts along x, y, z: one solution, the place itself.
  std::vector<Joint> gantry;
  for (int k = 0; k < 3; ++k) gantry.push_back({"slide_" + std::to_string(k), JointKind::prismatic, k, {}, Vec3::Unit(k), -2, 2});
  const auto slides = std::make_shared<const Robot>("gantry", named_links(4), gantry);
  const InverseKinematics shift(slides, 3);
  const InverseResult there = shift.solve({{0.5, -1.5, 2}, Quat::Identity()});
  REQUIRE(there.solutions.size() == 1);
  CHECK((Eigen::Map<const Vec3>(there.solutions[0].data()) - Vec3(0.5, -1.5, 2)).norm() < 1e-9);
  const InverseResult turned = shift.solve({{0.5, 0, 0}, exp_rotation({0, 0, 0.5})});
  CHECK(turned.status == Status::stalled);
  CHECK_THAT(turned.message, Contains("none of 100 starts found a solution") && Contains("28.6479 deg"));

  // Eight joints: some of infinitely many.
  std::vector<Joint> snake;
  for (int k = 0; k < 8; ++k)
    snake.push_back({"j" + std::to_string(k),
                     JointKind::continuous,
                     k,
                     {{0, 0, k ? 0.3 : 0}, Quat::Identity()},
                     k % 2 ? Vec3::UnitX() : Vec3::UnitZ()});
  const auto redundant = std::make_shared<const Robot>("snake", named_links(9), snake);
  const InverseKinematics many(redundant, 8);
  const Frame target = redundant->link_frame(8, random_values(*redundant, random));
  const InverseResult some = many.solve(target);
  CHECK(some.solutions.size() == 8);
  check_solutions(*redundant, many, target, some);

  // A planar arm of two joints: both elbows.
  const auto two = std::make_shared<const Robot>(planar_arm({0.7, 0.5}));
  const double q[] = {0.4, 0.9};
  const InverseKinematics planar(two, 3);
  CHECK(planar.solve(two->link_frame(3, q)).solutions.size() == 1);  // its direction names the elbow
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(planar.solve(two->link_frame(3, q), {}, context).status == Status::cancelled);
  // The base never moves.
  CHECK(InverseKinematics(two, 0).solve({}).status == Status::solved);
  CHECK_THAT(InverseKinematics(two, 0).solve({{1, 0, 0}, Quat::Identity()}).message, Contains("no joint moves 'link_0'"));
}
