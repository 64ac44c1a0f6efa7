// Dress packs among bodies: distances, contact with fixed bodies and with the robot's own links, holds that slide.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/pack_gaps.h"
#include "method/dress_pack/pack_simulation.h"
#include "robot/load_robot.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

Mesh cube(const Vec3& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.push_back(0.5 * size.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// What acts on rod 0 of a step: force, and moment about the world's origin.
std::pair<Vec3, Vec3> loads(const PackProblem& pack, const PackStep& step) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const std::vector<Frame> poses = pack.poses(step.q);
  for (std::size_t k = 0; k < step.ends.size(); ++k) {
    force += step.ends[k].force;
    moment += step.ends[k].moment + poses[k].at.cross(step.ends[k].force);
  }
  for (const ContactForce& contact : step.rods[0].contacts) {
    force += contact.force;
    moment += contact.point.cross(contact.force);
  }
  return {force, moment};
}

/// Six axes with a forearm that is solid, about x of link 3, and a hose that hangs from its elbow to its hand.
PackProblem forearm_pack() {
  PackProblem pack = six_axis_pack(20);
  pack.bodies = {{{Cylinder{0.09, 0.7}, {{0.45, 0, 0.2}, Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX())}, 0, "forearm"}, 3}};
  return pack;
}

}  // namespace

TEST_CASE("bodies of a pack: distances and paths are those of surroundings", "[dress_pack]") {
  Random random(71);
  PackProblem pack = forearm_pack();
  pack.base = {{0.2, -0.1, 0.3}, random.rotation()};
  pack.bodies.push_back({{std::make_shared<const TriangleSurface>(cube({0.3, 0.2, 0.1})), {{0.4, 0.3, 0.2}, random.rotation()}, 0, "box"}});
  PackBodies bodies(pack);
  std::vector<BodyPose> poses;
  for (int round = 0; round < 200; ++round) {
    const JointVector q = random_values(6, 2, random);
    bodies.move(q);
    bodies.poses(q, poses);
    const Vec3 p = random.point(1.5), r = random.point(1.5);
    for (int b = 0; b < 2; ++b) {
      const ClosestPoint expected = bodies.surroundings().closest_on(b, p, 0.8);
      const BodyDistance found = bodies.distance(b, poses[b].to_body(p), 0.8);
      CHECK(found.found == (expected.obstacle >= 0));
      CHECK(found.distance == Approx(expected.distance).margin(1e-9));
      if (found.found) CHECK((poses[b].to_world(found.point) - expected.point).norm() < 1e-6);
    }
    const bool passes = bodies.passes(0, poses[0].to_body(p), poses[0].to_body(r)) || bodies.passes(1, poses[1].to_body(p), poses[1].to_body(r));
    CHECK(passes == bodies.surroundings().ray(p, r).has_value());
  }
}

TEST_CASE("bodies of a pack: near a hold a rod is not compared with the link that carries it", "[dress_pack]") {
  PackProblem pack = forearm_pack();
  pack.bodies.push_back({{Sphere{0.1}, {}, 0, "lamp"}});
  pack.bodies.push_back({{Sphere{0.1}, {}, 0, "hand"}, 7});  // joined rigidly to link 6
  const PackBodies bodies(pack);
  const double radius = 0.015, length = 1.6;
  for (const Compared what : {Compared::clearance, Compared::contact}) {
    CHECK_FALSE(bodies.compared(0, 0, 0, what));
    CHECK_FALSE(bodies.compared(0, 3.99 * radius, 0, what));
    CHECK(bodies.compared(0, 4.01 * radius, 0, what));
    CHECK(bodies.compared(0, length - 2 * radius, 0, what));
    CHECK(bodies.compared(0, 1.01 * radius, 1, what));
    CHECK_FALSE(bodies.compared(0, length - 3.99 * radius, 2, what));
    CHECK(bodies.compared(0, 2 * radius, 2, what));
  }
  // Contact cannot move a held place, but it must keep its clearance.
  CHECK_FALSE(bodies.compared(0, 0.99 * radius, 1, Compared::contact));
  CHECK(bodies.compared(0, 0.99 * radius, 1, Compared::clearance));
  // What is held in the world is fastened to something fixed.
  pack.attachments.pop_back();
  const PackBodies held(pack);
  CHECK_FALSE(held.compared(0, length - 3.99 * radius, 1, Compared::clearance));
  CHECK(held.compared(0, length - 4.01 * radius, 1, Compared::clearance));
  CHECK(held.compared(0, length - 3.99 * radius, 2, Compared::clearance));
}

TEST_CASE("gaps of a pack: the smallest is that of a fine scan, along a motion with one memory", "[dress_pack]") {
  Random random(72);
  PackProblem pack = forearm_pack();
  pack.bodies.push_back({{Sphere{0.1}, {{0.9, 0.4, 1.2}, Quat::Identity()}, 0, "ball"}});
  pack.bodies.push_back({{std::make_shared<const TriangleSurface>(cube({0.3, 0.2, 0.1})), {{0.9, 0.1, 1.3}, random.rotation()}, 0, "box"}});
  PackProblem free = pack;
  free.bodies.clear();
  const PackMotion motion = simulate(free, problematic_path(), {60});
  REQUIRE(motion.ok());
  const PackBodies bodies(pack);
  const PackStatics statics(pack);
  const PackGaps gaps(bodies, statics.network(), Compared::contact);
  PackGaps::Memory memory;
  PackPlaces places;
  for (const PackStep& step : motion.steps) {
    gaps.place(step.state, step.q, places);
    const PackGaps::Nearest near = gaps.smallest(0, step.state, places, 10, memory);
    double least = 1e9;
    int body = -1;
    for (int p = 0; p < gaps.points(); ++p)
      for (int b = 0; b < bodies.size(); ++b) {
        if (!bodies.compared(0, gaps.point(p).s, b, Compared::contact)) continue;
        const double gap = bodies.distance(b, places.bodies[b].to_body(places.points[p]), 1e9).distance - gaps.point(p).radius;
        if (gap < least) least = gap, body = b;
      }
    CHECK(near.body == body);
    CHECK(near.gap <= least + 1e-12);
    // A chord of a radius over a ball of 0.05 m; within a body the distance has kinks.
    if (least > 0) CHECK(near.gap > least - 0.015 * 0.015 / 8 / 0.05);
    int listed = 0;
    gaps.visit_near(places, least + 0.01, memory, [&](int p, int b, const BodyDistance& found) {
      ++listed;
      CHECK(found.distance == Approx(bodies.distance(b, places.bodies[b].to_body(places.points[p]), 1e9).distance).margin(1e-12));
    });
    CHECK(listed > 0);
  }
}

TEST_CASE("contact of a pack: a hose pressed against the forearm balances", "[dress_pack]") {
  const PackProblem pack = forearm_pack();
  const double weight = pack.rods[0].rod.mass() * 9.81;
  const PackMotion motion = simulate(pack, JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 100, -40, 40})}), {20});
  INFO(motion.message);
  REQUIRE(motion.ok());
  CHECK(motion.contact_solutions > 0);
  int pressed = 0;
  for (const PackStep& step : motion.steps) {
    CAPTURE(step.t);
    CHECK(step.rods[0].clearance > -1e-3 * 0.015);
    CHECK(step.residual < 1e-3 * weight);
    const auto [force, moment] = loads(pack, step);
    CHECK((force - Vec3(0, 0, weight)).norm() < 1e-3 * weight);
    // The weight's moment: of the mass along the vertices.
    Vec3 of_weight = Vec3::Zero();
    const int n = static_cast<int>(step.state.r.size());
    for (int i = 0; i < n; ++i)
      of_weight += (i == 0 || i + 1 == n ? 0.5 : 1.0) / (n - 1) * step.state.r[i].cross(Vec3(0, 0, -weight));
    CHECK((moment + of_weight).norm() < 0.02 * weight);
    if (step.rods[0].contact_force() > 1) {
      ++pressed;
      CHECK(step.rods[0].body == 0);
      for (const ContactForce& contact : step.rods[0].contacts) CHECK(contact.obstacle == 0);
    }
  }
  CHECK(pressed > 3);
}

TEST_CASE("contact of a pack: a hose that rests lightly is followed in few passes", "[dress_pack]") {
  // 0.1 to 1 N at a hose that sways easily: contact must neither open nor be driven deep in on the way from step to step.
  PackProblem pack;
  pack.robot = load_robot("builtin:six_axis");
  pack.rods = {hose(1.6, 16)};
  pack.attachments = {{0, 0, pack.robot->link("link_2"), Frame::looking({0.05, 0.2, 0.75}, {1, 0, 1}, {0, 0, 1})},
                      {0, 1, pack.robot->link("link_6"), Frame::looking({0.05, 0, 0.15}, {1, 0, 0}, {0, 0, 1})}};
  const Quat along = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
  pack.bodies = {{{Cylinder{0.12, 1.0}, {{0.5, 0, 0.1}, along}, 0, "forearm"}, pack.robot->link("link_3")}};
  const double weight = pack.rods[0].rod.mass() * 9.81;
  const PackMotion motion = simulate(pack, JointPath({degrees({0, 0, 0, 0, 0, 0}), degrees({15, 2.5, -10, 10, 5, 5})}), {100});
  INFO(motion.message);
  REQUIRE(motion.ok());
  CHECK(motion.snaps.empty());
  CHECK(motion.contact_solutions > 90);
  CHECK(motion.iterations < 12 * motion.contact_solutions);
  for (const PackStep& step : motion.steps) {
    CAPTURE(step.t);
    CHECK(step.rods[0].clearance > -1e-3 * 0.015);
    CHECK((loads(pack, step).first - Vec3(0, 0, weight)).norm() < 1e-3 * weight);
  }
}

TEST_CASE("contact of a pack: turned about gravity it is the same", "[dress_pack]") {
  PackProblem pack = forearm_pack();
  const JointPath path({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 100, -40, 40})});
  const PackMotion here = simulate(pack, path, {6});
  pack.base = {{3, -2, 0.5}, exp_rotation({0, 0, 1.1})};
  const PackMotion there = simulate(pack, path, {6});
  REQUIRE(here.ok());
  REQUIRE(there.ok());
  for (std::size_t k = 0; k < here.steps.size(); ++k) {
    CHECK(there.steps[k].ends[1].force.norm() == Approx(here.steps[k].ends[1].force.norm()).epsilon(1e-3));
    CHECK(there.steps[k].rods[0].clearance == Approx(here.steps[k].rods[0].clearance).margin(2e-5));
  }
}

TEST_CASE("contact of a pack: no hose gets through a post, however few the steps", "[dress_pack]") {
  // The whole robot turns by 35 degrees; a post stands in the way of the hose under its arm, which catches it.
  PackProblem pack = six_axis_pack(20);
  const JointVector here = degrees({-40, 0, 0, 0, 0, 0}), there = degrees({-5, 0, 0, 0, 0, 0});
  const PackMotion free = simulate(pack, JointPath({here, there}), {1});
  REQUIRE(free.ok());
  const auto lowest = std::min_element(free.steps[0].state.r.begin(), free.steps[0].state.r.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  const Vec3 ahead = exp_rotation({0, 0, 0.4}) * *lowest;
  pack.bodies = {{{Cylinder{0.02, 3}, {{ahead.x(), ahead.y(), ahead.z()}, Quat::Identity()}, 0, "post"}}};
  for (const int steps : {1, 10}) {
    CAPTURE(steps);
    const PackMotion caught = simulate(pack, JointPath({here, there}), {steps});
    INFO(caught.message);
    REQUIRE(caught.ok());
    CHECK(caught.smallest_clearance() > -1e-3 * 0.015);
    CHECK(caught.steps.back().rods[0].contact_force() > 1);
    Vec3 push = Vec3::Zero();
    for (const ContactForce& contact : caught.steps.back().rods[0].contacts) push += contact.force;
    CHECK(push.dot(Vec3::UnitZ().cross(ahead).normalized()) < -1);  // back against the turn
  }
}

TEST_CASE("contact of a pack: limits, refusals and interruptions", "[dress_pack]") {
  PackProblem pack = forearm_pack();
  const JointPath path({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, -10, 100, -40, 40})});
  SimulationOptions few;
  few.most_solutions = 3;
  const PackMotion cut = simulate(pack, path, few);
  CHECK(cut.status == Status::stalled);
  CHECK_THAT(cut.message, Contains("not finished in 3 solutions with contact"));
  CHECK_FALSE(cut.steps.empty());
  few.most_solutions = 0;
  CHECK_THROWS_WITH(simulate(pack, path, few), Contains("at most 0 solutions with contact, expected at least 1"));
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(simulate(pack, path, {}, context).status == Status::cancelled);
  pack.bodies[0].link = 40;
  CHECK_THROWS_WITH(simulate(pack, path), Contains("body 0 is on link 40"));
  pack = forearm_pack();
  pack.bodies[0].body.shape = Solid(Sphere{-1});
  CHECK_THROWS_WITH(simulate(pack, path), Contains("obstacle"));
  pack = forearm_pack();
  const Surroundings own;
  pack.rods[0].surroundings = &own;
  CHECK_THROWS_WITH(simulate(pack, path), Contains("rod 1 has surroundings of its own"));
}

TEST_CASE("sliding holds of a pack: followed, and refused where paths are optimised", "[dress_pack]") {
  // A hose through a ring on the forearm: what the hand winds up comes through it without force along the hose.
  PackProblem pack = six_axis_pack(16);
  Hold ring{0.8, {}, true, false};
  ring.slide = true;
  pack.rods[0].holds.insert(pack.rods[0].holds.begin() + 1, ring);
  pack.attachments[1].hold = 2;
  pack.attachments.push_back({0, 1, 4, {{0.5, 0, -0.35}, Quat::Identity()}});
  const PackMotion motion = simulate(pack, JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({0, 0, 0, 60, -30, 0})}), {10});
  INFO(motion.message);
  REQUIRE(motion.ok());
  REQUIRE(motion.steps.size() == 11);
  for (const PackStep& step : motion.steps) {
    const Vec3 sum = step.ends[0].force + step.ends[1].force + step.ends[2].force;
    CHECK((sum - Vec3(0, 0, pack.rods[0].rod.mass() * 9.81)).norm() < 1e-5 * pack.rods[0].rod.mass() * 9.81);
    CHECK(step.residual < 1e-4);
  }
  CHECK_THROWS_WITH(PackStatics(pack), Contains("slides through a hold, which paths can be simulated with but not optimised"));
}
