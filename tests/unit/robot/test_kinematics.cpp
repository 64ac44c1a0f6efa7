// Forward kinematics against plain matrices, Jacobians against finite differences.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "unit/robot/robots.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;

namespace {

using Mat4 = Eigen::Matrix4d;

Mat4 matrix(const Frame& f) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = f.rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = f.at;
  return m;
}

// By the definition of a joint, in homogeneous matrices.
Mat4 place_by_matrices(const Robot& robot, int link, const std::vector<double>& q) {
  if (link == 0) return Mat4::Identity();
  const Joint& joint = robot.joints()[link - 1];
  const int followed = joint.mimics == -1 ? link - 1 : joint.mimics;
  double value = 0;
  for (int v = 0; v < robot.size(); ++v)
    if (robot.variables()[v] == followed) value = q[v];
  if (joint.mimics != -1) value = joint.factor * value + joint.shift;
  Mat4 motion = Mat4::Identity();
  if (joint.kind == JointKind::prismatic)
    motion.topRightCorner<3, 1>() = value * joint.axis;
  else if (joint.kind != JointKind::fixed)
    motion.topLeftCorner<3, 3>() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
  return place_by_matrices(robot, joint.parent, q) * matrix(joint.origin) * motion;
}

Jacobian by_differences(const Robot& robot, int link, std::vector<double> q, double h) {
  Jacobian out(6, robot.size());
  const Frame middle = robot.link_frame(link, q);
  const auto step = [&](int k, double by) {
    std::vector<double> moved = q;
    moved[k] += by;
    const Frame there = middle.inverse() * robot.link_frame(link, moved);
    Eigen::Matrix<double, 6, 1> v;
    v << there.at, log_rotation(there.rotation);
    return v;
  };
  for (int k = 0; k < robot.size(); ++k)
    out.col(k) = (8 * (step(k, h) - step(k, -h)) - (step(k, 2 * h) - step(k, -2 * h))) / (12 * h);  // fourth order
  return out;
}

}  // namespace

TEST_CASE("a planar arm stands where trigonometry says", "[robot]") {
  const Robot arm = planar_arm({0.7, 0.4});
  CHECK(arm.size() == 2);
  CHECK(arm.links()[arm.tip()].name == "link_3");
  for (double a : {0.0, 1e-9, 0.5, units::pi - 1e-9, units::pi})
    for (double b : {0.0, -1e-9, 1.2, -units::pi}) {
      const double q[] = {a, b};
      const Frame tip = arm.link_frame(3, q);
      CHECK(tip.at.x() == Approx(0.7 * std::cos(a) + 0.4 * std::cos(a + b)).margin(1e-15));
      CHECK(tip.at.y() == Approx(0.7 * std::sin(a) + 0.4 * std::sin(a + b)).margin(1e-15));
      CHECK(tip.at.z() == 0);
      CHECK((tip.d1() - Vec3(std::cos(a + b), std::sin(a + b), 0)).norm() < 1e-14);
      const Jacobian j = arm.jacobian(3, q);
      CHECK((j.col(1) - (Eigen::Matrix<double, 6, 1>() << 0, 0.4, 0, 0, 0, 1).finished()).norm() < 1e-14);
      CHECK((j.col(0).head<3>() - Vec3(0.7 * std::sin(b), 0.4 + 0.7 * std::cos(b), 0)).norm() < 1e-14);
    }
}

TEST_CASE("trees of all joints agree with plain matrices, their Jacobians with differences", "[robot]") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Robot robot = random_tree(1 + random.below(12), random);
    for (double size : {0.0, 1e-9, 1.0, 3.0}) {
      std::vector<double> q;
      for (int k = 0; k < robot.size(); ++k) q.push_back(random.in(-size, size));
      const std::vector<Frame> frames = robot.link_frames(q);
      for (int link = 0; link < static_cast<int>(robot.links().size()); ++link) {
        const Mat4 expected = place_by_matrices(robot, link, q);
        CHECK((matrix(frames[link]) - expected).norm() < 1e-13);
        CHECK((matrix(robot.link_frame(link, q)) - expected).norm() < 1e-13);
        Jacobian j(6, robot.size());
        const Frame same = robot.jacobian(link, q, j);
        CHECK((matrix(same) - expected).norm() < 1e-13);
        CHECK((j - robot.jacobian(link, q)).norm() == 0);
        CHECK((j - by_differences(robot, link, q, 1e-3)).norm() < 1e-9 * (1 + j.norm()));
      }
    }
  }
}

TEST_CASE("only the joints below a link move it", "[robot]") {
  const Robot arm = planar_arm({1, 1, 1});
  const double q[] = {0.3, 0.2, 0.1};
  CHECK(arm.jacobian(0, q).norm() == 0);
  CHECK(arm.jacobian(1, q).rightCols(2).norm() == 0);
  CHECK(arm.jacobian(1, q).col(0).norm() == Approx(1));
  CHECK(arm.chain(4) == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(arm.parent(0) == -1);
  CHECK(arm.parent(3) == 2);
}

TEST_CASE("limits: of the joints, and of those that mimic them", "[robot]") {
  Joint a{"a", JointKind::revolute, 0, {}, Vec3::UnitZ(), -1, 2};
  Joint b{"b", JointKind::prismatic, 1, {}, Vec3::UnitZ(), 0, 3};
  b.mimics = 0;
  b.factor = -2;
  b.shift = 1;  // 0 <= 1 - 2a <= 3: -1 <= a <= 0.5
  const Robot robot("pair", named_links(3), {a, b});
  CHECK(robot.size() == 1);
  CHECK(robot.lower() == std::vector<double>{-1});
  CHECK(robot.upper() == std::vector<double>{0.5});
  const double inside[] = {0.5}, outside[] = {0.6};
  CHECK(robot.within_limits(inside));
  CHECK(robot.beyond_limits(inside).empty());
  CHECK_FALSE(robot.within_limits(outside));
  CHECK(robot.within_limits(outside, 0.11));
  CHECK(robot.beyond_limits(outside) == "'a' at 0.6, limits -1 ... 0.5");
  b.lower = b.upper = 30;
  CHECK_THROWS_WITH(Robot("pair", named_links(3), {a, b}), Contains("joint 'b'") && Contains("no place to 'a'"));
}

TEST_CASE("what is no robot is refused with the joint's name", "[robot]") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const Joint good{"a", JointKind::revolute, 0, {}, Vec3::UnitZ(), -1, 1, 2};
  const auto refused = [&](const char* why, auto change) {
    Joint joint = good;
    change(joint);
    CHECK_THROWS_WITH(Robot("r", named_links(2), {joint}), Contains("robot 'r', joint 'a'") && Contains(why));
  };
  refused("its axis", [](Joint& j) { j.axis.setZero(); });
  refused("its axis", [&](Joint& j) { j.axis.x() = nan; });
  refused("not numbers", [&](Joint& j) { j.lower = nan; });
  refused("lower limit 2 lies above the upper one, 1", [](Joint& j) { j.lower = 2; });
  refused("no place", [&](Joint& j) { j.lower = j.upper = inf; });
  refused("velocity is nan", [&](Joint& j) { j.velocity = nan; });
  refused("velocity is -1", [](Joint& j) { j.velocity = -1; });
  refused("origin is not finite", [&](Joint& j) { j.origin.at.x() = inf; });
  refused("origin lies more than 1e+09 m away", [](Joint& j) { j.origin.at.z() = -1e10; });
  refused("axis has a number beyond 1e+09", [](Joint& j) { j.axis = {0, 1e200, 0}; });
  refused("unit quaternion", [](Joint& j) { j.origin.rotation.coeffs() *= 2; });
  refused("earlier link", [](Joint& j) { j.parent = 1; });
  refused("mimic another joint", [](Joint& j) { j.mimics = 0; });
  refused("mimic another joint", [](Joint& j) { j.mimics = 7; });
  CHECK_THROWS_WITH(Robot("r", named_links(2), {}), Contains("got 2 links and 0 joints"));
  CHECK_THROWS_WITH(Robot("r", {}, {}), Contains("got 0 links"));
  CHECK_THROWS_WITH(Robot("r", {Link{"x"}, Link{"x"}}, {good}), Contains("two links are called 'x'"));
  CHECK_THROWS_WITH(Robot("r", {Link{"x"}, Link{""}}, {good}), Contains("a link has no name"));
  CHECK_THROWS_WITH(Robot("r", named_links(3), {good, good}), Contains("two joints are called 'a'"));
  Joint fixed{"f"}, follower = good;
  follower.mimics = 0;
  CHECK_THROWS_WITH(Robot("r", named_links(3), {fixed, follower}), Contains("mimics 'f', which is fixed"));
  Link ball{"ball", {}, {{Solid(Sphere{-1}), {}}}};
  CHECK_THROWS_WITH(Robot("r", {ball}, {}), Contains("link 'ball'"));
}

TEST_CASE("joint values that do not fit are refused", "[robot]") {
  const Robot arm = planar_arm({1, 1});
  const double one[] = {0.0}, bad[] = {0, std::nan("")};
  CHECK_THROWS_WITH(arm.link_frame(1, one), "link_frame: got 1 joint values, expected 2 for 'planar'");
  CHECK_THROWS_WITH(arm.jacobian(1, bad), Contains("joint 'joint_2' is nan"));
  CHECK_THROWS_WITH(arm.within_limits(bad), Contains("finite"));
  std::vector<Frame> few(2);
  const double q[] = {0.0, 0.0};
  CHECK_THROWS_WITH(arm.link_frames(q, few), Contains("room for 2 frames, expected 4"));
  CHECK_THROWS_WITH(arm.link_frame(4, q), "robot 'planar': there is no link of the number 4");
  CHECK_THROWS_WITH(arm.jacobian(-1, q), Contains("no link of the number -1"));
  CHECK_THROWS_WITH(arm.chain(4), Contains("no link of the number 4"));
  Jacobian narrow(6, 1);
  CHECK_THROWS_WITH(arm.jacobian(1, q, narrow), Contains("room for 1 columns, expected 2"));
  CHECK_THROWS_WITH(arm.link("link_9"), Contains("no link 'link_9'") && Contains("did you mean"));
  CHECK_THROWS_WITH(arm.joint("elbow"), Contains("no joint 'elbow'") && Contains("joint_1"));
  CHECK(arm.link("link_2") == 2);
  CHECK(arm.joint("joint_2") == 1);
}
