#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/scene_path_motion.h"
#include "unit/method/dress_pack_cases.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;

namespace {

/// A beam of 1 x 0.2 x 0.1 m that turns about z, at z = 1 m, and a hand that slides out of it along x.
std::shared_ptr<const Robot> reaching_beam() {
  Link base{"base"}, beam{"beam"}, hand{"hand"};
  beam.collision.push_back({Solid(Box{{1, 0.2, 0.1}}), {{0.5, 0, 0}, Quat::Identity()}});
  Joint turn, reach;
  turn.name = "turn";
  turn.kind = JointKind::revolute;
  turn.origin.at = {0, 0, 1};
  turn.axis = Vec3::UnitZ();
  turn.lower = -2;
  turn.upper = 2;
  reach.name = "reach";
  reach.kind = JointKind::prismatic;
  reach.parent = 1;
  reach.origin.at = {1, 0, 0};
  reach.lower = 0;
  reach.upper = 0.5;
  return std::make_shared<const Robot>("crane", std::vector<Link>{base, beam, hand}, std::vector<Joint>{turn, reach});
}

tendril::Attachment fastened(const char* rod, double at, int link, const Frame& in_link) {
  tendril::Attachment a;
  a.rod = rod;
  a.at = at;
  a.robot = "crane";
  a.link = link;
  a.in_link = in_link;
  return a;
}

/// A hose along the beam from its root to the hand, high above it, or sagging onto it.
Scene crane_with_hose(double height, double length = 1.5) {
  Scene scene(testing::earth);
  scene.add(PlacedRobot{"crane", reaching_beam(), {}});
  scene.add(PlacedRod("hose", Rod::uniform(length, testing::soft_section(), 40), {}, {}));
  scene.attach(fastened("hose", 0, 1, Frame::looking({0.05, 0, height}, {1, 0, 0})));
  scene.attach(fastened("hose", length, 2, Frame::looking({0.2, 0, height}, {1, 0, 0})));
  return scene;
}

JointPath path(std::initializer_list<std::pair<double, double>> places) {
  std::vector<JointVector> via;
  for (const auto& [turn, reach] : places) via.push_back(Eigen::Vector2d(turn, reach));
  return JointPath(via);
}

SceneEquilibrium solved_at(Scene& scene, const std::vector<double>& q, const SceneEquilibrium& from) {
  scene.set_joints("crane", q);
  return scene.solve({}, {}, &from);
}

double farthest(const SceneEquilibrium& a, const SceneEquilibrium& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].equilibrium.points.size(); ++i)
      most = std::max(most, (a.rods[k].equilibrium.points[i] - b.rods[k].equilibrium.points[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("a robot's motion passes through the scene's own equilibria", "[dress_pack][scene]") {
  for (const bool touches : {false, true}) {
    CAPTURE(touches);
    Scene scene = touches ? crane_with_hose(0.12, 1.18) : crane_with_hose(1);
    const SceneMotion motion = dress_pack::move_robot(scene, "crane", path({{0, 0}, {0.8, 0.005}, {1.2, 0.005}}), {.steps = 6}, {});
    CAPTURE(motion.message);
    REQUIRE(motion.ok());
    REQUIRE(motion.times.size() == 7);
    CHECK(motion.snaps.empty());
    CHECK(scene.robot("crane").joints == std::vector<double>{0, 0});
    for (const int k : {0, 3, 6}) {
      const SceneEquilibrium& state = *motion.equilibria[k];
      const std::vector<double> q = k == 0 ? std::vector<double>{0, 0} : k == 3 ? std::vector<double>{0.8, 0.005} : std::vector<double>{1.2, 0.005};
      CHECK(motion.times[k] == Approx(k / 6.0));
      CHECK(farthest(state, solved_at(scene, q, state)) < (touches ? 2e-4 : 1e-7));
      CHECK(state.rods[0].equilibrium.contacts.empty() == !touches);
    }
    scene.set_joints("crane", {0, 0});
  }
}

TEST_CASE("a hose that lies on a moving link is carried by it and by its holds", "[dress_pack][scene]") {
  const Scene scene = crane_with_hose(0.12, 1.18);
  const SceneMotion motion = dress_pack::move_robot(scene, "crane", path({{0, 0}, {1.5, 0}}), {.steps = 4}, {});
  CAPTURE(motion.message);
  REQUIRE(motion.ok());
  for (const auto& state : motion.equilibria) {
    const SolvedRod& hose = state->rod("hose");
    Vec3 total = state->reaction(hose, 0).force + state->reaction(hose, 1.18).force;
    double pressed = 0;
    for (const ContactForce& force : hose.equilibrium.contacts) {
      CHECK(force.obstacle == state->obstacle("crane.beam"));
      total += force.force;
      pressed += force.force.z();
    }
    const double weight = hose.problem.rod.mass() * 9.81;
    CHECK((total - Vec3(0, 0, weight)).norm() < 1e-5 * weight);
    CHECK(pressed > 0.05 * weight);
  }
}

TEST_CASE("turning about gravity changes nothing but the place", "[dress_pack][scene]") {
  const Scene scene = crane_with_hose(1);
  const SceneMotion motion = dress_pack::move_robot(scene, "crane", path({{-1, 0.2}, {1.3, 0.2}}), {.steps = 5}, {});
  REQUIRE(motion.ok());
  const Vec3 axis = Vec3::UnitZ();
  for (std::size_t k = 0; k < motion.equilibria.size(); ++k) {
    const Quat back = exp_rotation(-2.3 * motion.times[k] * axis);
    const auto &first = motion.equilibria[0]->rods[0].equilibrium, &here = motion.equilibria[k]->rods[0].equilibrium;
    for (std::size_t i = 0; i < here.points.size(); ++i) CHECK((back * here.points[i] - first.points[i]).norm() < 1e-7);
  }
}

TEST_CASE("a hose that slides through a clip on a link", "[dress_pack][scene]") {
  Scene scene = crane_with_hose(1);
  tendril::Attachment clip = fastened("hose", 0.7, 1, Frame::looking({0.6, 0, 0.75}, {1, 0, 0}));
  clip.slide = true;
  scene.attach(clip);
  const SceneMotion motion = dress_pack::move_robot(scene, "crane", path({{0, 0}, {0.5, 0.3}}), {.steps = 3}, {});
  REQUIRE(motion.ok());
  const double before = motion.equilibria.front()->rods[0].equilibrium.reactions[2].s, after = motion.equilibria.back()->rods[0].equilibrium.reactions[2].s;
  CHECK(std::abs(after - before) > 1e-3);
  for (const auto& state : motion.equilibria) {
    const Reaction& held = state->rods[0].equilibrium.reactions[2];
    CHECK(state->rods[0].problem.holds[2].at == held.s);
    CHECK((state->rods[0].equilibrium.frame_at(held.s).at - state->rods[0].problem.holds[2].frame.at).norm() < 1e-6);
  }
  const SceneEquilibrium there = solved_at(scene, {0.5, 0.3}, *motion.equilibria.back());
  REQUIRE(there.ok());
  CHECK(there.rods[0].equilibrium.reactions[2].s == Approx(after).margin(2e-4));
}

TEST_CASE("what a robot's motion refuses", "[dress_pack][scene]") {
  Scene scene = crane_with_hose(1);
  const SceneMotion far = dress_pack::move_robot(scene, "crane", path({{0, 0}, {2.5, 0}}), {}, {});
  CHECK(far.status == Status::infeasible);
  CHECK_THAT(far.message, Contains("turn"));
  CHECK(far.equilibria.empty());
  CHECK_THROWS_WITH(dress_pack::move_robot(scene, "crane", JointPath({JointVector::Zero(3)}), {}, {}), Contains("3 joint values, expected 2"));
  CHECK_THROWS_WITH(dress_pack::move_robot(scene, "crain", path({{0, 0}, {1, 0}}), {}, {}), Contains("unknown robot 'crain'"));
  scene.add(testing::sagging_hose("other"));
  CHECK_THROWS_WITH(dress_pack::move_robot(scene, "crane", path({{0, 0}, {1, 0}}), {}, {}), Contains("'other' not attached to robot 'crane'"));
  RunContext cancelled;
  scene.remove("other");
  std::atomic<bool> flag = true;
  cancelled.cancel = &flag;
  CHECK(dress_pack::move_robot(scene, "crane", path({{0, 0}, {1, 0}}), {}, cancelled).status == Status::cancelled);
}
