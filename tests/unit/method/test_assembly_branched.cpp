// Assembly verification of systems with branches, further grips, and optimisation of what was found.
#include <catch2/catch.hpp>

#include <cmath>

#include "method/assembly/assembly.h"
#include "method/assembly/optimisation.h"
#include "method/assembly/supplementation.h"

using namespace tendril;
using namespace tendril::assembly;

namespace {

Section cable() { return Section::round(0.012, 0, Material::from_poisson(3e7, 0.4, 1500)); }

PlacedObstacle floor_at_zero() {
  PlacedObstacle floor;
  floor.name = "floor";
  floor.body.shape = HalfSpace{};
  return floor;
}

/// A spine along x above a floor, held at both ends, with teeth along y, held at their tips.
Scene comb(int teeth) {
  constexpr double step = 0.15, height = 0.05, length = 0.2;
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(floor_at_zero());
  const auto along_x = [&](int k) { return Frame::looking({k * step, 0, height}, Vec3::UnitX()); };
  std::vector<PlacedRod*> spine;
  for (int k = 0; k <= teeth; ++k)
    spine.push_back(&scene.add(PlacedRod("spine " + std::to_string(k + 1), Rod::uniform(step, cable(), 8), along_x(k), along_x(k + 1))));
  for (int k = 1; k <= teeth; ++k) {
    const Frame root = Frame::looking({k * step, 0, height}, Vec3::UnitY()), tip = Frame::looking({k * step, length, height}, Vec3::UnitY());
    PlacedRod& tooth = scene.add(PlacedRod("tooth " + std::to_string(k), Rod::uniform(1.02 * length, cable(), 10), root, tip));
    const Frame relative{Vec3::Zero(), along_x(k).rotation.conjugate() * root.rotation};
    scene.join("junction " + std::to_string(k), {{spine[k - 1], step, {}}, {spine[k], 0, {}}, {&tooth, 0, relative}}, std::nullopt);
  }
  return scene;
}

/// A strip between two clamps that are nearer to each other than it is long: it bends up or down.
Scene arch() {
  Scene scene(Vec3::Zero());
  scene.add(PlacedRod("strip", Rod::uniform(0.52, cable(), 24), Frame::looking({0, 0, 0}, Vec3::UnitX()), Frame::looking({0.5, 0, 0}, Vec3::UnitX())));
  return scene;
}

double farthest(const Equilibrium& a, const Equilibrium& b) {
  double most = 0;
  for (const double s : a.s) most = std::max(most, (a.frame_at(s).at - b.frame_at(s).at).norm());
  return most;
}

Frame at(double x) { return {Vec3(x, 0, 0), Quat::Identity()}; }

}  // namespace

TEST_CASE("assembly: a harness with branches is pulled out by a junction and installed again") {
  const Scene scene = comb(3);
  Options options;
  options.optimise = false;
  const Result result = run(scene, options);
  INFO(result.message);
  REQUIRE(result.ok);
  CHECK(result.status == Status::solved);
  CHECK(result.proof.deviation <= 0.05 * 0.006);
  CHECK(result.proof.clearance > 0);
  CHECK(result.handle_path.back().z() > 0.2);
  // The handle is the junction with the shortest arm: from the middle one to the ends it is two pieces of the spine.
  REQUIRE(result.manipulation.grips.size() == 6);
  CHECK(result.manipulation.grips.back().name == "junction 2");
  // Every connection ends where it is held, and they all begin far above the floor.
  const SceneEquilibrium routed = scene.solve();
  for (std::size_t g = 0; g < result.manipulation.grips.size(); ++g) {
    const Grip& grip = result.manipulation.grips[g];
    INFO(grip.name);
    CHECK(result.manipulation.poses[g].front().at.z() > 0.1);
    if (grip.branch >= 0) continue;
    const SolvedRod& rod = routed.rods[grip.rod];
    CHECK((result.manipulation.pose(static_cast<int>(g), 1).at - rod.equilibrium.frame_at(grip.at).at).norm() < 1e-9);
  }
  const std::vector<std::string> steps = {"routed_configuration", "constraint_relaxation",       "handle_path_planning",
                                          "path_smoothing",       "grip_point_supplementation", "optimisation"};
  REQUIRE(result.steps.size() == steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) CHECK(result.steps[i].name == steps[i]);
}

TEST_CASE("assembly: optimisation keeps what is proven and makes it shorter or take fewer grips") {
  const Scene scene = comb(2);
  Options options;
  options.optimise = false;
  const Result plain = run(scene, options);
  options.optimise = true;
  options.optimise_seconds = 1e6;  // the number of plays ends it
  const Result best = run(scene, options);
  INFO(plain.message << " / " << best.message);
  REQUIRE(plain.ok);
  REQUIRE(best.ok);
  CHECK(best.proof.deviation <= 0.05 * 0.006);
  CHECK(best.proof.clearance >= std::min(plain.proof.clearance, 0.006) - 1e-4);
  CHECK(best.manipulation.grips.size() <= plain.manipulation.grips.size());
  CHECK(path_length(best.manipulation) < path_length(plain.manipulation));
  const Result again = run(scene, options);
  CHECK(path_length(again.manipulation) == path_length(best.manipulation));
  CHECK(again.proof.steps == best.proof.steps);
}

TEST_CASE("assembly: no time for optimisation leaves the proven manipulation as it is") {
  const Scene scene = comb(2);
  Options options;
  options.optimise = false;
  const Result plain = run(scene, options);
  options.optimise = true;
  options.optimise_seconds = 0;
  const Result same = run(scene, options);
  REQUIRE(same.ok);
  CHECK(path_length(same.manipulation) == path_length(plain.manipulation));
}

TEST_CASE("assembly: of several equilibria the given one is installed") {
  const Scene scene = arch();
  SceneEquilibrium up = scene.solve(), down = up;
  Equilibrium& mirrored = down.rods[0].equilibrium;
  // Half a turn about the line between the clamps.
  const Quat half(Eigen::AngleAxisd(M_PI, Vec3::UnitX()));
  for (std::size_t i = 0; i < mirrored.points.size(); ++i) {
    mirrored.points[i] = half * mirrored.points[i];
    mirrored.rotations[i] = half * mirrored.rotations[i] * Quat(Eigen::AngleAxisd(-M_PI, Vec3::UnitZ()));
  }
  for (Vec3& force : mirrored.forces) force = half * force;
  SolveOptions follow;
  follow.follow = true;
  const SceneEquilibrium other = scene.solve(follow, {}, &down);
  REQUIRE(other.ok());
  REQUIRE(farthest(up.rods[0].equilibrium, other.rods[0].equilibrium) > 0.05);
  const auto of = [&](const SceneEquilibrium& routed) {
    Options options;
    options.routed = std::make_shared<const SceneEquilibrium>(routed);
    return installed_system(scene, options, 2);
  };
  const InstalledSystem first = of(up), second = of(other);
  REQUIRE(first.routed.ok());
  REQUIRE(second.routed.ok());
  CHECK(farthest(first.routed.rods[0], up.rods[0].equilibrium) < 1e-4);
  CHECK(farthest(second.routed.rods[0], other.rods[0].equilibrium) < 1e-4);
}

TEST_CASE("assembly: every clip is a connection with a name of its own") {
  Scene scene(Vec3::Zero());
  PlacedRod& rod = scene.add(PlacedRod("hose", Rod::uniform(0.5, cable(), 20), at(0), std::nullopt));
  rod.hold(Hold{0.2, {Vec3(0, 0, 0.2), Quat::Identity()}});
  rod.hold(Hold{0.4, {Vec3(0, 0, 0.4), Quat::Identity()}});
  const InstalledSystem system = installed_system(scene, {}, 2);
  REQUIRE(system.connections.size() == 3);
  CHECK(system.connections[0].name == "hose.start");
  CHECK(system.connections[1].name == "hose.0.2");
  CHECK(system.connections[2].name == "hose.0.4");
}

TEST_CASE("assembly: the length of paths counts turns") {
  Manipulation manipulation;
  manipulation.grips.resize(2);
  manipulation.times = {0, 0.5, 1};
  manipulation.poses = {{at(0), at(1), at(3)}, {at(0), at(0), {Vec3::Zero(), Quat(Eigen::AngleAxisd(1, Vec3::UnitY()))}}};
  CHECK(path_length(manipulation) == Approx(3.05));
}

TEST_CASE("assembly: grips are taken by name, in order") {
  Manipulation all;
  all.times = {0, 1};
  for (const char* name : {"a", "b", "c"}) {
    all.grips.push_back({name});
    all.poses.push_back({at(double(all.grips.size())), at(0)});
  }
  const Manipulation some = with_grips(all, {"c", "a", "unknown"});
  REQUIRE(some.grips.size() == 2);
  CHECK(some.grips[0].name == "a");
  CHECK(some.grips[1].name == "c");
  CHECK(some.poses[1].front().at.x() == 3);
  CHECK(some.times == all.times);
}

TEST_CASE("assembly: the grip that strayed farthest is held next, then what contact presses on") {
  Scene scene(Vec3::Zero());
  scene.add(PlacedRod("hose", Rod::uniform(0.6, cable(), 24), Frame::looking({0, 0, 0}, Vec3::UnitX()), std::nullopt));
  const InstalledSystem system = installed_system(scene, {}, 2);
  Manipulation all;
  all.times = {0, 1};
  all.grips = system.connections;
  for (const Grip& grip : system.extra) all.grips.push_back(grip);
  for (const Grip& grip : all.grips) {
    const Frame pose = system.pose(system.routed, grip);
    all.poses.push_back({pose, pose});
  }
  const Manipulation played = with_grips(all, {"hose.start"});
  REQUIRE(system.extra.size() == 3);
  Played result;
  result.moved.passed.push_back({0.5, system.routed, false});
  // Nothing strays: the place next to the contact.
  ContactForce contact{};
  contact.point.setZero();
  contact.s = system.extra[2].at + 0.01;
  contact.force = Vec3(0, 0, 2);
  result.moved.passed.back().equilibrium.rods[0].contacts.push_back(contact);
  CHECK(supplementary_grip(system, all, played, result) == system.extra[2].name);
  // One path leads elsewhere by more than a radius.
  for (std::size_t g = 0; g < all.grips.size(); ++g)
    if (all.grips[g].name == system.extra[1].name) all.poses[g][1].at.y() += 0.03;
  CHECK(supplementary_grip(system, all, played, result) == system.extra[1].name);
  // All are held: there is none left.
  CHECK(supplementary_grip(system, all, all, result).empty());
}
