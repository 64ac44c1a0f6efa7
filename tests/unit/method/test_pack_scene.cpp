#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/pack_scene.h"
#include "unit/method/dress_pack_cases.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;
using dress_pack::ScenePack;

namespace {

/// The arm of six_axis_pack(), with a box on two of its links, on a base that stands askew.
std::shared_ptr<const Robot> solid_arm() {
  ArmShape shape;
  shape.limit = 3.1;
  const auto bare = arm(shape);
  std::vector<Link> links = bare->links();
  links[0].collision.push_back({Solid(Cylinder{0.2, 0.3}), {{0, 0, 0.15}, Quat::Identity()}});
  links[2].collision.push_back({Solid(Box{{0.1, 0.1, 1}}), {{0.02, 0, 0.5}, exp_rotation({0, 0.1, 0})}});
  return std::make_shared<const Robot>("arm", links, bare->joints());
}

const Frame askew{{0.4, -0.3, 0.2}, exp_rotation({0, 0, 0.6})};

tendril::Attachment fastened(const char* rod, double at, int link, const Frame& in_link, const char* robot = "arm") {
  tendril::Attachment a;
  a.rod = rod;
  a.at = at;
  a.robot = robot;
  a.link = link;
  a.in_link = in_link;
  return a;
}

const Frame at_elbow = Frame::looking({0.1, 0, 0.35}, {1, 0, 0}, {0, 0, 1}), at_hand = Frame::looking({0.05, 0, 0.2}, {1, 0, 0}, {0, 0, 1});

/// A floor, another robot, and a rod that has nothing to do with either.
Scene cell() {
  Scene scene(testing::earth);
  scene.add(testing::sagging_hose("other"));
  scene.add(PlacedRod("hose", Rod::uniform(1.6, hose_section(), 16), {}, {}));
  scene.add(testing::solid("floor", HalfSpace{}, {0, 0, -5}, 0.01));
  scene.add(PlacedRobot{"second", solid_arm(), {{6, 0, 0}, Quat::Identity()}, std::vector<double>(6, 0.2)});
  scene.add(PlacedRobot{"arm", solid_arm(), askew});
  scene.attach(fastened("hose", 0, 3, at_elbow));
  scene.attach(fastened("hose", 1.6, 6, at_hand));
  return scene;
}

}  // namespace

TEST_CASE("a pack of a scene's robot", "[dress_pack][scene]") {
  const Scene scene = cell();
  const ScenePack pack = dress_pack::pack_of(scene, "arm");
  CHECK(pack.rods == std::vector<int>{1});
  CHECK(pack.robot == 1);
  CHECK(pack.problem.names == std::vector<std::string>{"hose"});
  REQUIRE(pack.problem.attachments.size() == 2);
  CHECK(pack.problem.attachments[1].link == 6);
  CHECK(pack.problem.attachments[1].hold == 1);
  CHECK((pack.problem.base.at - askew.at).norm() == 0);
  REQUIRE(pack.problem.bodies.size() == 5);
  CHECK(pack.problem.bodies[0].body.name == "floor");
  CHECK(pack.problem.bodies[0].body.clearance == 0.01);
  CHECK(pack.problem.bodies[0].link == -1);
  CHECK(pack.problem.bodies[1].body.name == "second.link_0");
  CHECK(pack.problem.bodies[2].link == -1);
  CHECK(pack.problem.bodies[4].body.name == "arm.link_2");
  CHECK(pack.problem.bodies[3].link == 0);
  CHECK(pack.problem.bodies[4].link == 2);
  CHECK(pack.problem.rods[0].gravity.z() == -9.81);
}

TEST_CASE("a pack of a scene moves as one that was put together by hand", "[dress_pack][scene]") {
  const Scene scene = cell();
  const ScenePack pack = dress_pack::pack_of(scene, "arm");
  PackProblem plain = six_axis_pack(16);
  plain.base = askew;
  const JointVector q = degrees({10, 20, -15, 40, -30, 25});
  const SystemProblem a = pack.problem.system_at(q), b = plain.system_at(q);
  for (int h = 0; h < 2; ++h) {
    CHECK((a.rods[0].holds[h].frame.at - b.rods[0].holds[h].frame.at).norm() < 1e-14);
    CHECK(log_rotation(a.rods[0].holds[h].frame.rotation.conjugate() * b.rods[0].holds[h].frame.rotation).norm() < 1e-14);
  }
  const auto path = JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 10, 20, 10})});
  const auto moved = dress_pack::simulate(pack.problem, path), expected = dress_pack::simulate(plain, path);
  REQUIRE(moved.ok());
  CHECK(moved.largest_end_force() == Approx(expected.largest_end_force()).epsilon(1e-9));
}

TEST_CASE("a state of the pack is the scene's own with the robot there", "[dress_pack][scene]") {
  Scene scene = cell();
  const ScenePack pack = dress_pack::pack_of(scene, "arm");
  const auto path = JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 10, 20, 10})});
  const auto moved = dress_pack::simulate(pack.problem, path);
  REQUIRE(moved.ok());
  dress_pack::PackStatics statics(pack.problem);
  const auto& last = moved.steps.back();
  const auto state = dress_pack::scene_state(scene, pack, last, statics);
  CHECK(state->ok());
  REQUIRE(state->rods.size() == 1);
  REQUIRE(state->obstacles.size() == 5);

  scene.set_joints("arm", std::vector<double>(last.q.data(), last.q.data() + 6));
  const SceneEquilibrium there = scene.solve({}, {}, state.get());
  REQUIRE(there.ok());
  const auto &a = state->rod("hose").equilibrium.points, &b = there.rod("hose").equilibrium.points;
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK((a[i] - b[i]).norm() < 1e-7);
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(state->obstacles[k].name == there.obstacles[k].name);
    CHECK((state->obstacles[k].body.pose.at - there.obstacles[k].body.pose.at).norm() < 1e-12);
    CHECK((state->surroundings->box_of(k).sizes().array().isInf().all() || (state->surroundings->box_of(k).center() - there.surroundings->box_of(k).center()).norm() < 1e-12));
  }
  CHECK(state->clearance(state->rods[0]).value == Approx(there.clearance(there.rod("hose")).value).epsilon(1e-6));
  CHECK(state->reaction(state->rods[0], 1.6).force.norm() == Approx(last.ends[1].force.norm()).epsilon(1e-9));
  CHECK_THROWS_WITH(dress_pack::scene_state(scene, pack, last.q, {}), Contains("0 rods, expected 1"));
}

TEST_CASE("what a scene's pack refuses, by name", "[dress_pack][scene]") {
  Scene scene = cell();
  CHECK_THROWS_WITH(dress_pack::pack_of(scene, "second"), Contains("'second'") && Contains("no rods are attached"));
  CHECK_THROWS_WITH(dress_pack::pack_of(scene, "amr"), Contains("unknown robot 'amr'"));
  scene.rod("hose").load({0.5, {0, 0, -1}, {0, 1, 0}});
  CHECK_THROWS_WITH(dress_pack::pack_of(scene, "arm"), Contains("'hose' carries a dead moment at 0.5 m"));
  scene.rod("hose").unload();
  scene.join("knot", {{&scene.rod("hose"), 0.8, {}}, {&scene.rod("other"), 0.6, {}}}, {});
  CHECK_THROWS_WITH(dress_pack::pack_of(scene, "arm"), Contains("'hose' belongs to branch point 'knot'"));
}
