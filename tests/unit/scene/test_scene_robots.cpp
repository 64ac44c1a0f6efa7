#include <catch2/catch.hpp>

#include <cmath>

#include "base/error.h"
#include "scene/explain.h"
#include "unit/robot/robots.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

namespace {

/// A column that does not move, a beam of 1 x 0.2 x 0.1 m that turns about z on its top, at z = 1 m, and a bare flange at the beam's end.
std::shared_ptr<const Robot> turning_beam() {
  Link column{"column"}, beam{"beam"}, flange{"flange"};
  column.collision.push_back({Solid(Cylinder{0.1, 0.9}), {{0, 0, 0.45}, Quat::Identity()}});
  beam.collision.push_back({Solid(Box{{1, 0.2, 0.1}}), {{0.5, 0, 0}, Quat::Identity()}});
  Joint turn;
  turn.name = "turn";
  turn.kind = JointKind::revolute;
  turn.origin.at = {0, 0, 1};
  turn.axis = Vec3::UnitZ();
  turn.lower = -2;
  turn.upper = 2;
  Joint fixed;
  fixed.name = "mount";
  fixed.parent = 1;
  fixed.origin.at = {1, 0, 0};
  return std::make_shared<const Robot>("crane", std::vector<Link>{column, beam, flange}, std::vector<Joint>{turn, fixed});
}

PlacedRobot crane(const char* name = "crane", const Frame& base = {}) { return {name, turning_beam(), base}; }

Attachment attached(const char* rod, double at, int link, const Frame& in_link) {
  Attachment a;
  a.rod = rod;
  a.at = at;
  a.robot = "crane";
  a.link = link;
  a.in_link = in_link;
  return a;
}

double difference(const Frame& a, const Frame& b) { return (a.at - b.at).norm() + log_rotation(a.rotation.conjugate() * b.rotation).norm(); }

const Frame on_top = Frame::looking({0.5, 0, 0.05}, {0, 0, 1});
const Frame below = Frame::looking({0.5, 0, -0.05}, {0, 0, -1});

}  // namespace

TEST_CASE("attached holds go with the link", "[scene][robot]") {
  Scene scene(earth);
  const Frame base{{0.3, -0.2, 0.1}, exp_rotation({0.1, -0.2, 0.7})};
  scene.add(crane("crane", base));
  scene.add(PlacedRod("hose", Rod::uniform(1.2, soft_section(), 20), Frame::looking({0, 0, 2}, {1, 0, 0}), {}));
  scene.attach(attached("hose", 1.2, 2, Frame::looking({0.1, 0.05, 0}, {0, 1, 0})));
  for (const double q : {0.0, 1.3, -2.0, 0.4}) {
    scene.set_joints("crane", {q});
    const PlacedRobot& robot = scene.robot("crane");
    const Frame expected = base * robot.robot->link_frame(2, robot.joints) * Frame::looking({0.1, 0.05, 0}, {0, 1, 0});
    CHECK(difference(scene.rod("hose").hold_at(1.2)->frame, expected) < 1e-14);
    CHECK(difference(scene.rod("hose").hold_at(0)->frame, Frame::looking({0, 0, 2}, {1, 0, 0})) < 1e-15);
    CHECK(robot.joints == std::vector<double>{q});
  }
}

TEST_CASE("a rod on a robot settles as one that is held at the same places", "[scene][robot]") {
  Scene scene(earth), plain(earth);
  scene.add(crane());
  const Frame from = Frame::looking({0.5, 0, 0.1}, {0, 0, 1}), to = Frame::looking({0.1, 0, 0}, {1, 0, 0});
  scene.add(PlacedRod("hose", Rod::uniform(1.1, soft_section(), 24), {}, {}));
  scene.attach(attached("hose", 0, 1, from));
  scene.attach(attached("hose", 1.1, 2, to));
  scene.set_joints("crane", {0.7});
  plain.add(scene.bodies()[0]);
  plain.add(scene.bodies()[1]);
  const auto& holds = scene.rod("hose").holds();
  plain.add(PlacedRod("hose", scene.rod("hose").rod(), holds[0].frame, holds[1].frame));
  const SceneEquilibrium carried = scene.solve(), held = plain.solve();
  REQUIRE(carried.ok());
  REQUIRE(held.ok());
  const auto &a = carried.rod("hose").equilibrium.points, &b = held.rod("hose").equilibrium.points;
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK((a[i] - b[i]).norm() < 1e-9);
}

TEST_CASE("links are solid bodies after the obstacles", "[scene][robot]") {
  Scene scene(earth);
  scene.add(crane());
  scene.add(solid("floor", HalfSpace{}, {0, 0, 0}));
  REQUIRE(scene.bodies().size() == 3);
  CHECK(scene.obstacles().size() == 1);
  CHECK(scene.bodies()[0].name == "floor");
  CHECK(scene.bodies()[1].name == "crane.column");
  CHECK(scene.bodies()[2].name == "crane.beam");
  CHECK(scene.surroundings()->size() == 3);
  // A place beside the beam's long side, in the beam's axes, whichever way it stands.
  for (const double q : {0.0, 0.9, -1.7}) {
    scene.set_joints("crane", {q});
    const Vec3 beside = scene.robot("crane").link_frame(1).at + scene.robot("crane").link_frame(1).rotation * Vec3(0.6, 0.35, 0.02);
    const ClosestPoint near = scene.surroundings()->closest(beside, 1);
    CHECK(near.obstacle == 2);
    CHECK(near.distance == Approx(0.25).epsilon(1e-12));
  }
  CHECK(scene.without_rods().bodies().size() == 3);
}

TEST_CASE("several shapes of a link are one body", "[scene][robot]") {
  Link only{"only"};
  only.collision.push_back({Solid(Box{{0.2, 0.2, 0.2}}), {{0, 0, 0}, Quat::Identity()}});
  only.collision.push_back({Solid(Box{{0.1, 0.1, 0.1}}), {{1, 0, 0}, exp_rotation({0, 0, 0.3})}});
  Scene scene;
  PlacedRobot robot{"thing", std::make_shared<const Robot>("thing", std::vector<Link>{only}, std::vector<Joint>{}), {{0, 0, 5}, Quat::Identity()}};
  scene.add(robot);
  REQUIRE(scene.bodies().size() == 1);
  CHECK(scene.bodies()[0].triangles() == 24);
  CHECK(scene.surroundings()->closest({0.5, 0, 5}, 1).distance == Approx(0.4));
  CHECK(scene.surroundings()->closest({1, 0, 5.3}, 1).distance == Approx(0.25));
}

TEST_CASE("a rod that leaves a link's surface is carried by its hold alone", "[scene][robot]") {
  const auto [in_link, up] = GENERATE(table<Frame, bool>({{on_top, true}, {below, false}, {{on_top.at - Vec3(0, 0, 0.02), on_top.rotation}, true}}));
  CAPTURE(in_link.at.transpose());
  Scene scene(earth);
  scene.add(crane());
  scene.add(PlacedRod("hose", Rod::uniform(0.3, soft_section(), 20), {}, {}));
  scene.attach(attached("hose", 0, 1, in_link));
  scene.set_joints("crane", {1.1});
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& hose = eq.rod("hose");
  const double weight = hose.problem.rod.mass() * 9.81;
  const Reaction reaction = eq.reaction(hose, 0);
  CHECK((reaction.force - Vec3(0, 0, weight)).norm() < 1e-7 * weight);
  CHECK(hose.equilibrium.contacts.empty());
  CHECK(hose.equilibrium.energy.contact == 0);
  // Straight up or down, but for the change of length.
  CHECK(std::abs(hose.equilibrium.points.back().z() - hose.equilibrium.points.front().z() - (up ? 0.3 : -0.3)) < 1e-3);
}

TEST_CASE("beyond four radii the link is solid for what is fastened to it", "[scene][robot]") {
  // From the top of the beam the hose falls over its edge.
  Scene scene(earth);
  scene.add(crane());
  scene.add(PlacedRod("hose", Rod::uniform(0.8, soft_section(), 60), {}, {}));
  scene.attach(attached("hose", 0, 1, Frame::looking({0.5, 0, 0.0601}, {0, 1, 0})));
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& hose = eq.rod("hose");
  REQUIRE(!hose.equilibrium.contacts.empty());
  Vec3 total = eq.reaction(hose, 0).force;
  for (const ContactForce& force : hose.equilibrium.contacts) {
    CHECK(force.s > 4 * 0.01);
    CHECK(force.obstacle == eq.obstacle("crane.beam"));
    total += force.force;
  }
  const double weight = hose.problem.rod.mass() * 9.81;
  CHECK((total - Vec3(0, 0, weight)).norm() < 1e-5 * weight);
  CHECK(hose.equilibrium.deepest_penetration < 0.02 * 0.01);
}

TEST_CASE("gaps leave out the link near where the rod is fastened to it, and nothing else", "[scene][robot]") {
  Scene scene;
  scene.add(crane());
  scene.add(solid("wall", Box{{0.1, 0.4, 0.4}}, {0.65, 0, 1.25}));  // its face at x = 0.6, 0.09 m from the hose
  scene.add(PlacedRod("hose", Rod::uniform(0.3, soft_section(), 20), {}, {}));
  scene.attach(attached("hose", 0, 1, on_top));
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& hose = eq.rod("hose");
  const Clearance to_beam = eq.clearance(hose, eq.obstacle("crane.beam"));
  CHECK(to_beam.s == Approx(0.04).epsilon(1e-6));
  CHECK(to_beam.value == Approx(0.03).epsilon(1e-6));
  CHECK(eq.clearance(hose, eq.obstacle("crane.beam"), 0, 0.03).obstacle == -1);
  CHECK(eq.clearance(hose, eq.obstacle("wall")).value == Approx(0.09).epsilon(1e-6));
  CHECK(eq.clearance(hose).obstacle == eq.obstacle("crane.beam"));
  CHECK(eq.judged_gaps(hose).front().gap.value == Approx(0.03).epsilon(1e-6));
  const Vec3 low = hose.equilibrium.frame_at(0.01).at;
  CHECK(eq.closest(hose, 0.01, low).obstacle == eq.obstacle("wall"));
  CHECK(eq.closest(low).obstacle == eq.obstacle("crane.beam"));
}

TEST_CASE("links that are joined rigidly are one body to what is fastened to them", "[scene][robot]") {
  const auto robot = turning_beam();
  CHECK(rigid_with(*robot, 2) == std::vector<int>{1, 2});
  CHECK(rigid_with(*robot, 0) == std::vector<int>{0});
  Scene scene(earth);
  scene.add(solid("floor", HalfSpace{}, {0, 0, 0}));
  scene.add(crane());
  scene.add(PlacedRod("hose", Rod::uniform(0.3, soft_section(), 20), {}, {}));
  scene.attach(attached("hose", 0, 2, Frame::looking({0, 0, 0}, {1, 0, 0})));
  const RodProblem problem = scene.problem_of(scene.rod("hose"));
  REQUIRE(problem.fastenings.size() == 1);
  CHECK(problem.fastenings[0].obstacle == 2);
  CHECK(problem.fastenings[0].reach == Approx(0.04));
}

TEST_CASE("what a robot in a scene refuses", "[scene][robot]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  scene.add(solid("crane.beam", Sphere{0.1}, {5, 5, 5}));
  CHECK_THROWS_WITH(scene.add(crane()), Contains("already has an obstacle 'crane.beam'"));
  CHECK(scene.robots().empty());
  scene.remove("crane.beam");
  CHECK_THROWS_WITH(scene.add(crane("hose")), Contains("already has a rod 'hose'"));
  CHECK_THROWS_WITH(scene.add(crane("")), Contains("name is empty"));
  CHECK_THROWS_WITH(scene.add(crane("left.crane")), Contains("cannot have a dot"));
  CHECK_THROWS_WITH(scene.add(PlacedRobot{"arm", nullptr, {}}), Contains("no robot was given"));
  PlacedRobot wrong = crane();
  wrong.joints = {2.5};
  CHECK_THROWS_WITH(scene.add(wrong), Contains("'turn' at 2.5, limits -2 ... 2"));
  wrong.joints = {0, 0};
  CHECK_THROWS_WITH(scene.add(wrong), Contains("2 joint values, expected 1"));
  wrong = crane();
  wrong.clearance = -1;
  CHECK_THROWS_WITH(scene.add(wrong), Contains("'clearance' is -1"));
  wrong = crane("crane", {{0, 0, NAN}, Quat::Identity()});
  CHECK_THROWS_WITH(scene.add(wrong), Contains("'at' is not a frame"));

  scene.add(crane());
  CHECK_THROWS_WITH(scene.add(crane()), Contains("already has a robot 'crane'"));
  CHECK_THROWS_WITH(scene.add(solid("crane.beam", Sphere{0.1}, {5, 5, 5})), Contains("is a link of robot 'crane'"));
  CHECK_THROWS_WITH(scene.robot("cranes"), Contains("did you mean 'crane'?"));
  CHECK_THROWS_WITH(scene.set_joints("crane", {3}), Contains("placed_robot:move") && Contains("limits -2 ... 2"));
  CHECK_THROWS_WITH(scene.set_joints("crane", {NAN}), Contains("expected a finite number"));
  CHECK(scene.robot("crane").joints == std::vector<double>{0});
}

TEST_CASE("what an attachment refuses", "[scene][robot]") {
  Scene scene(earth);
  scene.add(crane());
  scene.add(sagging_hose());
  CHECK_THROWS_WITH(scene.attach(attached("hoes", 0.5, 1, {})), Contains("did you mean 'hose'?"));
  CHECK_THROWS_WITH(scene.attach(attached("hose", 0.5, 3, {})), Contains("no link of the number 3"));
  CHECK_THROWS_WITH(scene.attach(attached("hose", 0, 1, {})), Contains("'hose' is held at its start already"));
  CHECK_THROWS_WITH(scene.attach(attached("hose", 1.5, 1, {})), Contains("expected 0 to 1.2 m"));
  CHECK_THROWS_WITH(scene.attach(attached("hose", 0.5, 1, {{NAN, 0, 0}, Quat::Identity()})), Contains("not finite"));
  Attachment sliding = attached("hose", 1.2, 1, {});
  sliding.slide = true;
  scene.rod("hose").release(1.2);
  CHECK_THROWS_WITH(scene.attach(sliding), Contains("cannot slide"));
  scene.attach(attached("hose", 1.2, 1, on_top));
  CHECK_THROWS_WITH(scene.attach(attached("hose", 1.2, 1, on_top)), Contains("attached to 'crane' at its finish already"));
  CHECK_THROWS_WITH(scene.rod("hose").hold({1.2, on_top}), Contains("attached to 'crane' at its finish"));
  CHECK_THROWS_WITH(scene.join("end", {{&scene.rod("hose"), 1.2, {}}}, {}), Contains("attached to robot 'crane'"));
  CHECK_THROWS_WITH(scene.remove("crane"), Contains("carries 'hose' at its finish"));
  scene.rod("hose").release(1.2);
  CHECK(scene.rod("hose").attachments().empty());
  scene.join("end", {{&scene.rod("hose"), 1.2, {}}}, {});
  CHECK_THROWS_WITH(scene.attach(attached("hose", 1.2, 1, {})), Contains("belongs to branch point 'end'"));
  scene.remove("crane");
  CHECK(scene.robots().empty());
  CHECK(scene.surroundings() == nullptr);
}

TEST_CASE("swivels and sliding clips on links", "[scene][robot]") {
  Scene scene(earth);
  scene.add(crane());
  scene.add(PlacedRod("hose", Rod::uniform(1.2, soft_section(), 40), Frame::looking({0, 0.4, 1.3}, {1, 0, 0}), {}));
  Attachment swivel = attached("hose", 1.2, 2, {{0, 0.4, 0.3}, Quat::Identity()});
  swivel.orientation = false;
  scene.attach(swivel);
  Attachment slide = attached("hose", 0.6, 1, Frame::looking({0.5, 0.4, 0.1}, {1, 0, 0}));
  slide.slide = true;
  scene.attach(slide);
  for (const double q : {0.0, 0.15}) {
    scene.set_joints("crane", {q});
    const SceneEquilibrium eq = scene.solve();
    REQUIRE(eq.ok());
    const SolvedRod& hose = eq.rod("hose");
    const Equilibrium& state = hose.equilibrium;
    CHECK(state.reactions[1].moment.norm() < 1e-6);
    const Frame clip = scene.rod("hose").hold_at(0.6)->frame;
    CHECK((state.frame_at(state.reactions[2].s).at - clip.at).norm() < 1e-6);
    // As one that is held in the world where the link has it.
    Scene plain(earth);
    for (const PlacedObstacle& body : scene.bodies()) plain.add(body);
    PlacedRod& same = plain.add(PlacedRod("hose", scene.rod("hose").rod(), {}, {}));
    for (const Hold& hold : scene.rod("hose").holds()) same.hold(hold);
    const SceneEquilibrium held = plain.solve();
    REQUIRE(held.ok());
    CHECK((held.rod("hose").equilibrium.reactions[2].force - state.reactions[2].force).norm() < 1e-6);
    CHECK(held.rod("hose").equilibrium.reactions[2].s == Approx(state.reactions[2].s).epsilon(1e-7));
    // The stretch that does not meet the beam goes with the clip.
    CHECK(hose.problem.holds[2].at == state.reactions[2].s);
  }
}

TEST_CASE("the explanation tells of robots and their links", "[scene][robot]") {
  Scene scene(earth);
  PlacedRobot far = crane("far", {{50, 0, 0}, Quat::Identity()});
  scene.add(crane());
  scene.add(far);
  scene.add(PlacedRod("hose", Rod::uniform(0.3, soft_section(), 20), {}, {}));
  scene.attach(attached("hose", 0, 2, {}));
  const std::string text = explain(scene).text();
  CHECK_THAT(text, Contains("carries 'hose' at its start on flange"));
  CHECK_THAT(text, Contains("carries no rod"));
  CHECK_THAT(text, Contains("no rod can reach any of 2 links"));
  CHECK_THAT(text, Contains("clamped at its start on robot 'crane'"));
  CHECK_THAT(text, Contains("out of reach: crane.column, far.column, far.beam"));
}
