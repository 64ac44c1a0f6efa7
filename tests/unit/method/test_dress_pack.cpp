// Dress packs: paths of the robot, holds on links, and what the equilibria say about moving them.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/pack_follower.h"
#include "statics/solve.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

Eigen::VectorXd difference_of_poses(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  Eigen::VectorXd c(6 * static_cast<int>(a.size()));
  for (std::size_t k = 0; k < a.size(); ++k) {
    c.segment<3>(6 * static_cast<int>(k)) = b[k].at - a[k].at;
    c.segment<3>(6 * static_cast<int>(k) + 3) = log_rotation(a[k].rotation.conjugate() * b[k].rotation);
  }
  return c;
}

Eigen::VectorXd loads(const PackStatics& statics) {
  Eigen::VectorXd out(6 * statics.attachments());
  for (int k = 0; k < statics.attachments(); ++k) out.segment<6>(6 * k) = statics.end_load(k);
  return out;
}

/// At an equilibrium that the ordinary solver found.
struct Standing {
  PackProblem pack;
  PackStatics statics;
  PackFollower follower;
  JointVector q;
  RodState state;

  Standing(PackProblem given, const JointVector& at) : pack(std::move(given)), statics(pack), follower(statics, {}), q(at) {
    const PackFollower::Outcome started = follower.start(state, q, {});
    INFO(started.message);
    REQUIRE(started.ok());
    REQUIRE(statics.stand_at(state));
  }
  /// The equilibrium elsewhere.
  RodState moved_to(const JointVector& there) {
    RodState out = state;
    REQUIRE(follower.advance(out, q, there, {}).ok());
    return out;
  }
};

/// A hose from link 0 over a hold in its middle, which only has a place, to the hand; and one that is held in the world.
PackProblem clipped_pack() {
  PackProblem pack = six_axis_pack(12);
  pack.base = {{0.3, -0.2, 0.1}, exp_rotation({0.1, -0.2, 0.7})};
  pack.rods[0].holds.insert(pack.rods[0].holds.begin() + 1, Hold{0.7, {{0.5, 0, 0.3}, Quat::Identity()}, true, false});
  pack.attachments[1].hold = 2;
  pack.attachments.push_back({0, 1, 4, {{0.3, 0.02, 0.25}, Quat::Identity()}});
  RodProblem second = hose(1.4, 10);
  second.holds[0].frame = Frame::looking({1.8, 0.7, 1.9}, {0, 0, 1});
  pack.rods.push_back(second);
  pack.attachments.push_back({1, 1, 6, Frame::looking({0.05, 0.1, -0.1}, {-1, 0.2, 0}, {0, 0, 1})});
  return pack;
}

}  // namespace

TEST_CASE("joint path: linear between via points in uniform time", "[dress_pack]") {
  const JointPath path({degrees({0, 10}), degrees({30, 10}), degrees({30, 50})});
  CHECK((path.at(0.25) - degrees({15, 10})).norm() < 1e-15);
  CHECK(path.at(0.5) == path.via()[1]);
  CHECK(path.at(1) == path.via()[2]);
  CHECK(path.at(7) == path.via()[2]);
  CHECK(path.at(-1) == path.via()[0]);
  CHECK(path.place(0.75).first == 1);
  CHECK(path.place(0.75).share == Approx(0.5));
  CHECK(path.length() == Approx(70 * units::deg));
  CHECK(path.length({2, 0.5}) == Approx(80 * units::deg));
  CHECK(path.effort() == Approx((900 + 1600) * units::deg * units::deg));
  const JointVector speeds = path.largest_speeds(4);
  CHECK(speeds[0] == Approx(15 * units::deg));
  CHECK(speeds[1] == Approx(20 * units::deg));
  const JointPath finer = path.resampled(5);
  for (const double t : JointPath::times(40)) CHECK((finer.at(t) - path.at(t)).norm() < 1e-14);
  CHECK(finer.effort() == Approx(path.effort()));
  // At a uniform speed the effort is half of the squared length; that is the least.
  const JointPath uniform({degrees({0}), degrees({20}), degrees({40})}), uneven({degrees({0}), degrees({5}), degrees({40})});
  CHECK(uniform.effort() == Approx(0.5 * uniform.length() * uniform.length()));
  CHECK(uneven.effort() > uniform.effort());
  CHECK(JointPath({degrees({7})}).at(0.3) == degrees({7}));
}

TEST_CASE("joint path: what makes no sense is refused", "[dress_pack]") {
  CHECK_THROWS_WITH(JointPath(std::vector<JointVector>{}), Contains("no via points"));
  CHECK_THROWS_WITH(JointPath({degrees({0}), degrees({0, 1})}), Contains("via point 1 has 2 joint values, the first one has 1"));
  CHECK_THROWS_WITH(JointPath({degrees({0}), degrees({NAN})}), Contains("via point 1 has numbers that are not finite"));
  const JointPath path({degrees({0}), degrees({1})});
  CHECK_THROWS_WITH(path.largest_speeds(0), Contains("0 s, expected more than 0"));
  CHECK_THROWS_WITH(path.length({1, 2}), Contains("2 weights for 1 joints"));
  CHECK_THROWS_WITH(path.length({-1}), Contains("a weight is -1"));
  CHECK_THROWS_WITH(path.resampled(1), Contains("1 via points, expected at least 2"));
  CHECK_THROWS_WITH(JointPath::times(0), Contains("0 time steps"));
}

TEST_CASE("joint path: what a robot cannot do is said", "[dress_pack]") {
  const Robot robot = planar_arm({0.6, 0.5});
  const JointPath within({degrees({0, 0}), degrees({170, 0})}), beyond({degrees({0, 0}), degrees({190, 0})});
  CHECK(beyond_robot(within, robot) == "");
  CHECK_THAT(beyond_robot(beyond, robot), Contains("via point 1") && Contains("joint_1"));
  CHECK_THAT(beyond_robot(JointPath({degrees({0})}), robot), Contains("1 joint values, planar has 2"));
  std::vector<Joint> joints = robot.joints();
  joints[0].velocity = 1;
  const Robot slow("slow", robot.links(), joints);
  CHECK(beyond_robot(within, slow, 3) == "");
  CHECK_THAT(beyond_robot(within, slow, 2), Contains("joint_1 moves at 1.48353, at most 1") && Contains("more than 2 s"));
}

TEST_CASE("pack: the Jacobian of the holds against finite differences", "[dress_pack]") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    PackProblem pack;
    pack.robot = std::make_shared<const Robot>(random_tree(7, random));
    if (pack.robot->size() == 0) continue;
    pack.base = {random.point(1), random.rotation()};
    pack.rods = {hose(1, 8)};
    for (int k = 0; k < 2; ++k)
      pack.attachments.push_back({0, k, random.below(static_cast<int>(pack.robot->links().size())), {random.point(1), random.rotation()}});
    const JointVector q = test::random_values(pack.robot->size(), 2, random);
    Eigen::MatrixXd jacobian;
    pack.jacobian(q, jacobian);
    const double e = 1e-6;
    for (int j = 0; j < q.size(); ++j) {
      const JointVector by = e * JointVector::Unit(q.size(), j);
      const Eigen::VectorXd slope = difference_of_poses(pack.poses(q - by), pack.poses(q + by)) / (2 * e);
      // The rotation from the middle of the two is half of it either way: the middle's axes are those of both.
      CHECK((slope - jacobian.col(j)).norm() < 1e-7 * (1 + jacobian.col(j).norm()));
    }
  }
}

TEST_CASE("pack: what makes no sense is refused", "[dress_pack]") {
  const PackProblem good = six_axis_pack();
  good.check();
  auto refuses = [&](auto change, const char* says) {
    PackProblem pack = good;
    change(pack);
    CHECK_THROWS_WITH(pack.check(), Contains(says));
  };
  refuses([](PackProblem& p) { p.robot = nullptr; }, "no robot");
  refuses([](PackProblem& p) { p.rods.clear(); }, "no rods");
  refuses([](PackProblem& p) { p.attachments.clear(); }, "nothing is attached to arm");
  refuses([](PackProblem& p) { p.attachments[1].rod = 1; }, "attachment 1 names rod 1 of 1");
  refuses([](PackProblem& p) { p.attachments[1].hold = 2; }, "attachment 1 names hold 2 of 2");
  refuses([](PackProblem& p) { p.attachments[0].link = 99; }, "attachment 0 names link 99 of 8");
  refuses([](PackProblem& p) { p.attachments[0].hold = 1; }, "attachment 1: hold 1 of rod 0 is attached already");
  refuses([](PackProblem& p) { p.attachments[0].in_link.at.x() = NAN; }, "attachment 0 has numbers that are not finite");
  refuses([](PackProblem& p) { p.attachments[0].in_link.rotation.w() = 3; }, "attachment 0: its rotation has the norm");
  refuses([](PackProblem& p) { p.base.at.x() = INFINITY; }, "the robot's base has no proper frame");
  refuses([](PackProblem& p) { p.rods[0].loads.push_back({0.5, Vec3::Zero(), Vec3::UnitX()}); }, "rod 0 carries a dead moment");
  refuses([](PackProblem& p) { p.rods[0].rod.length = -1; }, "length");
}

TEST_CASE("statics of a pack: motions and end loads against finite differences of equilibria", "[dress_pack]") {
  Random random(5);
  const JointVector q = degrees({10, 5, -5, 40, 30, 20});
  for (const bool clipped : {false, true}) {
    CAPTURE(clipped);
    Standing here(clipped ? clipped_pack() : six_axis_pack(), q);
    Eigen::MatrixXd jacobian;
    here.pack.jacobian(q, jacobian);
    for (int trial = 0; trial < 6; ++trial) {
      const JointVector way = trial < 3 ? JointVector(JointVector::Unit(6, 2 * trial)) : test::random_values(6, 1, random);
      const double e = 1e-4;
      const RodState behind = here.moved_to(q - e * way), ahead = here.moved_to(q + e * way);
      REQUIRE(here.statics.stand_at(ahead));
      const Eigen::VectorXd loads_ahead = loads(here.statics);
      REQUIRE(here.statics.stand_at(behind));
      const Eigen::VectorXd loads_behind = loads(here.statics);
      REQUIRE(here.statics.stand_at(here.state));
      std::vector<Vec6> step;
      here.statics.respond(jacobian * way, step);
      double off = 0, size = 0;
      for (std::size_t i = 0; i < step.size(); ++i) {
        const Vec3 moved = (ahead.r[i] - behind.r[i]) / (2 * e);
        const Vec3 turned = log_rotation(behind.q[i].conjugate() * ahead.q[i]) / (2 * e);
        off = std::max({off, (moved - step[i].head<3>()).norm(), (turned - step[i].tail<3>()).norm()});
        size = std::max(size, step[i].norm());
      }
      CHECK(off < 1e-5 * size);
      const Eigen::VectorXd change = here.statics.load_change(step), slope = (loads_ahead - loads_behind) / (2 * e);
      CHECK((change - slope).norm() < 1e-5 * slope.norm());
    }
  }
}

TEST_CASE("statics of a pack: the adjoint is the transposed response", "[dress_pack]") {
  Random random(9);
  Standing here(clipped_pack(), degrees({0, 5, -5, 60, 20, 10}));
  const int n = 6 * here.statics.attachments();
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::VectorXd c = test::random_values(n, 1, random), by_load = test::random_values(n, 1, random);
    std::vector<Vec6> by_node(here.statics.network().nodes()), step;
    for (Vec6& one : by_node) one = test::random_values(6, 10, random);
    here.statics.respond(c, step);
    double forward = by_load.dot(here.statics.load_change(step));
    for (std::size_t i = 0; i < step.size(); ++i) forward += by_node[i].dot(step[i]);
    const Eigen::VectorXd backward = here.statics.pull_back(by_load, by_node);
    CHECK(backward.dot(c) == Approx(forward).epsilon(1e-9));
  }
}

TEST_CASE("statics of a pack: a turn of all of it about the direction of gravity changes no end load", "[dress_pack]") {
  // The first axis is vertical: forces turn with the pack, moments in the sections' own axes stay.
  for (const double angle : {0.0, 1e-9, 0.7, 3.0}) {
    CAPTURE(angle);
    JointVector q = degrees({0, 5, -5, 60, 20, 10});
    q[0] = angle;
    Standing here(six_axis_pack(), q);
    Eigen::MatrixXd jacobian;
    here.pack.jacobian(q, jacobian);
    std::vector<Vec6> step;
    here.statics.respond(jacobian.col(0), step);
    const Eigen::VectorXd change = here.statics.load_change(step);
    for (int k = 0; k < 2; ++k) {
      const Vec6 load = here.statics.end_load(k);
      const Vec3 turned = Vec3::UnitZ().cross(Vec3(load.head<3>()));
      CHECK((change.segment<3>(6 * k) - turned).norm() < 1e-7 * load.norm());
      CHECK(change.segment<3>(6 * k + 3).norm() < 1e-7 * load.norm());
    }
  }
}

TEST_CASE("statics of a pack: the same end loads as the ordinary solver's reactions", "[dress_pack]") {
  const JointVector q = degrees({0, 0, 0, 30, 20, 10});
  Standing here(six_axis_pack(), q);
  const SystemEquilibrium ordinary = solve(here.pack.system_at(q));
  REQUIRE(ordinary.ok());
  const SystemEquilibrium own = here.statics.describe(here.state);
  CHECK(own.rods[0].residual < 1e-6);
  for (int k = 0; k < 2; ++k) {
    CHECK((own.rods[0].reactions[k].force - ordinary.rods[0].reactions[k].force).norm() < 1e-6);
    CHECK((own.rods[0].reactions[k].moment - ordinary.rods[0].reactions[k].moment).norm() < 1e-6);
  }
  CHECK(own.rods[0].energy.total() == Approx(ordinary.rods[0].energy.total()).epsilon(1e-9));
}
