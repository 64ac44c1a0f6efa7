// Clearances of dress packs: gaps of rods and links with their gradients, and paths that keep what is demanded.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/reduced.h"
#include "method/dress_pack/triangle_pair.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

/// A hose from the upper arm to the hand, a solid hand, and a ball that the hose comes near.
PackProblem pack_by_ball(double radius = 0.08) {
  PackProblem pack = six_axis_pack(12);
  pack.names = {"hose"};
  pack.bodies = {{{Sphere{radius}, {{1.0, 0.35, 1.0}, Quat::Identity()}, 0, "ball"}},
                 {{Box{{0.1, 0.12, 0.14}}, {{0.05, 0, -0.1}, exp_rotation({0.2, 0.1, 0})}, 0, "hand"}, 6},
                 {{Cylinder{0.05, 0.4}, {{0.3, 0, 0.3}, exp_rotation({0, 1, 0})}, 0, "forearm"}, 3}};
  return pack;
}

JointPath gentle_path(int via = 5) {
  return JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({40, 0, 0, 30, 30, 20})}).resampled(via);
}

Mesh random_soup(int count, double reach, double size, Random& random) {
  Mesh mesh;
  for (int k = 0; k < count; ++k) {
    const Vec3 middle = random.point(reach);
    for (int c = 0; c < 3; ++c) mesh.vertices.push_back(middle + random.point(size));
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  return mesh;
}

/// Two cones on a polygon of `sides` corners, closed.
Mesh bipyramid(double radius, double height, int sides) {
  Mesh mesh;
  mesh.vertices = {{0, 0, -height}, {0, 0, height}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * units::pi * k / sides;
    mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    const int here = 2 + k, next = 2 + (k + 1) % sides;
    mesh.triangles.push_back({0, next, here});
    mesh.triangles.push_back({1, here, next});
  }
  return mesh;
}

/// A ball in the way of the hose's middle on the best path without it.
PackProblem blocked_pack(const JointPath& path, const ReducedOptions& options) {
  PackProblem pack = six_axis_pack(12);
  pack.names = {"hose"};
  const ReducedResult free = optimise(pack, path, options);
  REQUIRE(free.ok());
  const PackStep& middle = free.after.steps[free.after.steps.size() / 2];
  pack.bodies = {{{Sphere{0.05}, {middle.state.r[6] - Vec3(0, 0, 0.085), Quat::Identity()}, 0, "ball"}}};
  return pack;
}

ReducedOptions few_steps() {
  ReducedOptions options;
  options.steps = 16;
  return options;
}

}  // namespace

TEST_CASE("closest points of two triangles: a fine scan is never nearer, and both points lie on them", "[dress_pack]") {
  Random random(31);
  int meet = 0;
  for (int round = 0; round < 300; ++round) {
    Vec3 a[3], b[3];
    const Vec3 away = random.point(1);
    for (int k = 0; k < 3; ++k) a[k] = random.point(0.6), b[k] = away + random.point(0.6);
    const TrianglePair pair = closest_of_triangles(a, b);
    CHECK((pair.on_a - pair.on_b).norm() == Approx(pair.distance).margin(1e-12));
    double least = 1e9, to_a = 1e9, to_b = 1e9;
    const int n = 14;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = (i * a[0] + j * a[1] + (n - i - j) * a[2]) / n;
        for (int k = 0; k <= n; ++k)
          for (int l = 0; k + l <= n; ++l) least = std::min(least, (p - (k * b[0] + l * b[1] + (n - k - l) * b[2]) / n).norm());
      }
    CHECK(pair.distance <= least + 1e-12);
    CHECK(least < pair.distance + 1.8 / n);
    for (const auto* one : {&a, &b}) {
      const Vec3 normal = ((*one)[1] - (*one)[0]).cross((*one)[2] - (*one)[0]).normalized();
      (one == &a ? to_a : to_b) = std::abs(normal.dot((one == &a ? pair.on_a : pair.on_b) - (*one)[0]));
    }
    CHECK(to_a < 1e-9);
    CHECK(to_b < 1e-9);
    meet += pair.distance == 0;
  }
  CHECK(meet > 10);
}

TEST_CASE("gaps of links: meshes and solids against all pairs of triangles, and along a motion", "[dress_pack]") {
  Random random(32);
  PackProblem pack = six_axis_pack(8);
  const auto hand = std::make_shared<const TriangleSurface>(random_soup(40, 0.1, 0.03, random));
  const auto cell = std::make_shared<const TriangleSurface>(random_soup(200, 0.5, 0.06, random));
  pack.bodies = {{{hand, {{0.1, 0, 0}, random.rotation()}, 0, "hand"}, 6},
                 {{cell, {{1.5, 0.2, 1.6}, random.rotation()}, 0, "cell"}},
                 {{Sphere{0.1}, {{1.6, -0.5, 1.4}, Quat::Identity()}, 0, "ball"}},
                 {{HalfSpace{}, {{0, 0, 0.9}, Quat::Identity()}, 0, "floor"}},
                 {{Sphere{0.07}, {{0.2, 0, 0}, Quat::Identity()}, 0, "tool"}, 6}};
  const PackBodies bodies(pack);
  const RobotGaps gaps(bodies);
  RobotGaps::Memory memory;
  std::vector<BodyPose> at;
  const JointVector from = random_values(6, 0.5, random), to = random_values(6, 0.5, random);
  for (int step = 0; step <= 30; ++step) {
    const JointVector q = from + step / 30.0 * (to - from);
    bodies.poses(q, at);
    double expected[3] = {1e9, 1e9, 1e9};  // of the hand from cell, ball and floor
    for (const auto& t : hand->mesh().triangles) {
      Vec3 a[3];
      for (int k = 0; k < 3; ++k) a[k] = at[0].to_world(hand->mesh().vertices[t[k]]);
      for (const auto& u : cell->mesh().triangles) {
        Vec3 b[3];
        for (int k = 0; k < 3; ++k) b[k] = at[1].to_world(cell->mesh().vertices[u[k]]);
        expected[0] = std::min(expected[0], closest_of_triangles(a, b).distance);
      }
      for (const Vec3& v : a) expected[2] = std::min(expected[2], v.z() - 0.9);
    }
    expected[1] = hand->tree().closest(at[0].to_body(at[2].at)).distance - 0.1;
    std::vector<LinkGap> near;
    gaps.near(q, 1, memory, near);
    double least = 1e9;
    for (const LinkGap& gap : near) {
      if (gap.body == 0) CHECK(gap.gap == Approx(expected[gap.other - 1]).margin(1e-9));
      if (gap.body == 4 && gap.other == 2) CHECK(gap.gap == Approx((at[4].at - at[2].at).norm() - 0.17).margin(1e-9));
      if (gap.gap > 0) CHECK((gap.on_link - gap.on_other).norm() == Approx(gap.gap).margin(1e-9));
      least = std::min(least, gap.gap);
    }
    for (int k = 0; k < 3; ++k)
      if (expected[k] < 1) CHECK(std::any_of(near.begin(), near.end(), [&](const LinkGap& gap) { return gap.body == 0 && gap.other == k + 1; }));
    CHECK(gaps.smallest(q, 1, memory).gap == Approx(std::min(least, 1.0)).margin(1e-12));
  }
}

TEST_CASE("gaps of links: boxes, cylinders, and how deep they overlap", "[dress_pack]") {
  PackProblem pack = planar_pack(8);
  pack.bodies = {{{Box{{0.2, 0.2, 0.2}}, {{0.3, 0, 0}, Quat::Identity()}, 0, "link"}, 1},
                 {{Box{{0.1, 0.1, 0.1}}, {{0.3, 0.5, 0}, Quat::Identity()}, 0, "box"}}};
  const JointVector q = degrees({0, 0});
  const auto smallest = [&] {
    const PackBodies bodies(pack, Sides::of_meshes_too);
    RobotGaps::Memory memory;
    return RobotGaps(bodies).smallest(q, 1, memory);
  };
  CHECK(smallest().gap == Approx(0.35));
  pack.bodies[1].body.pose.at.y() = 0.13;  // 2 cm deep
  CHECK(smallest().gap == Approx(-0.02));
  pack.bodies[1].body.pose.at.y() = 0.5;
  pack.bodies[1].body.shape = Solid(Cylinder{0.05, 0.3});
  CHECK(smallest().gap == Approx(0.35).margin(1e-4));
  pack.bodies[0].link = 0;  // the base does not move
  CHECK(smallest().body == -1);
}

TEST_CASE("gaps of links: closed meshes that overlap, by the deepest of all corners", "[dress_pack]") {
  Random random(34);
  PackProblem pack = six_axis_pack(8);
  int deep[2] = {0, 0};
  for (int round = 0; round < 200; ++round) {
    INFO("round " << round);
    const auto hand = std::make_shared<const TriangleSurface>(bipyramid(random.in(0.05, 0.3), random.in(0.1, 0.6), 12));
    const auto cell = std::make_shared<const TriangleSurface>(bipyramid(random.in(0.1, 0.3), random.in(0.1, 0.3), 40));
    const JointVector q = random_values(6, 0.5, random);
    const Frame link = pack.robot->link_frame(6, {q.data(), 6});
    pack.bodies = {{{hand, {random.point(0.1), random.rotation()}, 0, "hand"}, 6},
                   {{cell, {link.at + random.point(0.4), random.rotation()}, 0, "cell"}}};
    const PackBodies bodies(pack, Sides::of_meshes_too);
    std::vector<BodyPose> at;
    bodies.poses(q, at);
    double depth[2] = {0, 0};  // of the hand's corners in the cell, and the other way
    for (int b = 0; b < 2; ++b)
      for (const Vec3& v : (b == 0 ? hand : cell)->mesh().vertices)
        depth[b] = std::min(depth[b], bodies.distance(1 - b, at[1 - b].to_body(at[b].to_world(v)), 0).distance);
    RobotGaps::Memory memory;
    const LinkGap gap = RobotGaps(bodies).smallest(q, 1, memory);
    if (depth[0] == 0 && depth[1] == 0) {
      CHECK(gap.gap >= 0);
      continue;
    }
    for (int b = 0; b < 2; ++b) deep[b] += depth[b] <= depth[1 - b];
    CHECK(gap.gap == Approx(std::min(depth[0], depth[1])).epsilon(0).margin(1e-12));
    CHECK((gap.on_link - gap.on_other).norm() == Approx(-gap.gap).margin(1e-12));
  }
  CHECK(deep[0] > 5);
  CHECK(deep[1] > 5);
}

TEST_CASE("clearance rows: gradients against finite differences of equilibria", "[dress_pack]") {
  Random random(33);
  const PackProblem pack = pack_by_ball();
  PackStatics statics(pack);
  PackDemands demands;
  demands.clearance = 0.03;
  demands.robot_clearance = 0.05;
  ClearanceRows rows(statics, demands, 1);
  rows.set_weight(2);
  PackFollower follower(statics, {});
  RodState state;
  JointVector q = degrees({5, 5, -5, 20, 20, 10});
  REQUIRE(follower.start(state, q, {}).ok());
  int compared = 0;
  for (int round = 0; round < 4; ++round) {
    const JointVector there = q + random_values(6, 0.15, random);
    REQUIRE(follower.advance(state, q, there, {}).ok());
    q = there;
    REQUIRE(statics.stand_at(state));
    std::vector<ClearanceRow> here, before, after;
    rows.near(statics, state, q, 0, 0.3, here);
    std::vector<Vec6> by_node(statics.network().nodes(), Vec6::Zero());
    JointVector slope = JointVector::Zero(6);
    const double penalty = rows.penalty(state, q, 0, by_node, slope);
    CHECK(penalty == Approx(rows.penalty(state, q, 0)));
    Eigen::MatrixXd jacobian;
    pack.jacobian(q, jacobian);
    slope += jacobian.transpose() * statics.pull_back(Eigen::VectorXd::Zero(12), by_node);
    for (int j = 0; j < 6; ++j) {
      const double e = 1e-5;
      const JointVector plus = q + e * JointVector::Unit(6, j), minus = q - e * JointVector::Unit(6, j);
      RodState up = state, down = state;
      REQUIRE(follower.advance(up, q, plus, {}).ok());
      REQUIRE(follower.advance(down, q, minus, {}).ok());
      CHECK(slope[j] == Approx((rows.penalty(up, plus, 0) - rows.penalty(down, minus, 0)) / (2 * e)).epsilon(1e-4).margin(1e-7));
      REQUIRE(statics.stand_at(up));
      rows.near(statics, up, plus, 0, 0.3, after);
      REQUIRE(statics.stand_at(down));
      rows.near(statics, down, minus, 0, 0.3, before);
      if (after.size() != here.size() || before.size() != here.size()) continue;  // a row at the margin came or went
      for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i].body != before[i].body || here[i].body != after[i].body || std::abs(after[i].s - before[i].s) > 1e-3) continue;
        ++compared;
        // Between the points the lowest place is that of a parabola, which moves a little along the rod.
        const double margin = after[i].s == before[i].s ? 2e-6 : 1e-3;
        CHECK(here[i].slope[j] == Approx((after[i].gap - before[i].gap) / (2 * e)).epsilon(1e-4).margin(margin));
      }
    }
  }
  CHECK(compared > 60);
}

TEST_CASE("clearance rows: a ball's gap is the distance of its middle less both radii", "[dress_pack]") {
  PackProblem pack = pack_by_ball();
  pack.bodies.resize(1);
  PackStatics statics(pack);
  PackDemands demands;
  demands.clearance = 0.03;
  ClearanceRows rows(statics, demands, 1);
  PackFollower follower(statics, {});
  RodState state;
  const JointVector q = degrees({5, 5, -5, 20, 20, 10});
  REQUIRE(follower.start(state, q, {}).ok());
  REQUIRE(statics.stand_at(state));
  std::vector<ClearanceRow> found;
  rows.near(statics, state, q, 0, 1, found);
  REQUIRE(found.size() > 3);
  const PackBodies bodies(pack);
  const PackGaps gaps(bodies, statics.network(), Compared::clearance);
  PackPlaces places;
  gaps.place(state, q, places);
  double least = 1e9;
  for (const Vec3& p : places.points) least = std::min(least, (p - pack.bodies[0].body.pose.at).norm() - 0.08 - 0.015);
  const auto worst = std::min_element(found.begin(), found.end(), [](const ClearanceRow& a, const ClearanceRow& b) { return a.gap < b.gap; });
  CHECK(worst->gap <= least + 1e-12);
  CHECK(worst->gap > least - 0.015 * 0.015 / 8 / 0.09);
}

TEST_CASE("reduced problem with clearances: gradient of the penalised objective against differences", "[dress_pack]") {
  const PackProblem pack = pack_by_ball(0.2);
  PackDemands demands;
  demands.clearance = 0.03;
  demands.robot_clearance = 0.05;
  ReducedProblem problem(pack, gentle_path(), 12, demands, {});
  REQUIRE(problem.start({}).ok());
  problem.set_clearances(5, 0);
  CHECK(problem.objective() > problem.plain_objective());
  Eigen::VectorXd gradient;
  REQUIRE(problem.gradient(gradient));
  const Eigen::VectorXd u = problem.values();
  for (int i = 0; i < u.size(); ++i) {
    const double e = 1e-5;
    const auto plus = problem.try_values(u + e * Eigen::VectorXd::Unit(u.size(), i), {});
    const auto minus = problem.try_values(u - e * Eigen::VectorXd::Unit(u.size(), i), {});
    REQUIRE(plus.ok());
    REQUIRE(minus.ok());
    CHECK(gradient[i] == Approx((plus.objective - minus.objective) / (2 * e)).epsilon(1e-4).margin(1e-6));
  }
}

TEST_CASE("optimised with clearance: a hose keeps away from a ball in its way, at fine steps too", "[dress_pack]") {
  ReducedOptions options = few_steps();
  const JointPath path = gentle_path();
  const PackProblem pack = blocked_pack(path, options);
  options.demands.clearance = 0.03;
  const ReducedResult found = optimise(pack, path, options);
  INFO(found.message);
  REQUIRE(found.ok());
  CHECK(found.clearance >= 0.03 - 1.1e-5);
  CHECK(found.clearance < 0.032);  // and no farther than it must
  SimulationOptions fine;
  fine.steps = 203;
  const PackMotion motion = simulate(pack, found.path, fine);
  REQUIRE(motion.ok());
  CHECK(motion.contact_solutions == 0);
  CHECK(motion.smallest_clearance() > 0.03 - 3e-4);
  CHECK(beyond_robot(found.path, *pack.robot).empty());
  // What it costs: more than without the ball, less than the given path with a heavy hand.
  PackProblem bare = pack;
  bare.bodies.clear();
  const ReducedResult free = optimise(bare, path, few_steps());
  CHECK(found.objective >= free.objective * (1 - 1e-6));
}

TEST_CASE("optimised with clearance: ends that do not keep it are refused at once, with the reason", "[dress_pack]") {
  PackProblem pack = pack_by_ball();
  pack.bodies.resize(1);
  ReducedOptions options = few_steps();
  const JointPath path = gentle_path();
  PackProblem bare = pack;
  bare.bodies.clear();
  const PackMotion free = simulate(bare, path, {4});
  REQUIRE(free.ok());
  options.demands.clearance = 0.03;
  pack.bodies[0].body.pose.at = free.steps.back().state.r[6] + Vec3(0, 0, -0.11);
  const ReducedResult late = optimise(pack, path, options);
  CHECK(late.status == Status::infeasible);
  CHECK(late.iterations == 0);
  CHECK_THAT(late.message, Contains("at the end of the path, which stays as it is, hose comes within") && Contains("of obstacle 'ball', 30 mm are demanded"));
  pack.bodies[0].body.pose.at = free.steps.front().state.r[6];
  const ReducedResult early = optimise(pack, path, options);
  CHECK(early.status == Status::infeasible);
  CHECK_THAT(early.message, Contains("at the start of the path") && Contains("hose overlaps obstacle 'ball' by"));
  options.demands.clearance = NAN;
  CHECK_THROWS_WITH(optimise(pack, path, options), Contains("a clearance of"));
}

TEST_CASE("optimised with clearance: links keep away too", "[dress_pack]") {
  PackProblem pack = pack_by_ball();
  pack.bodies.erase(pack.bodies.begin() + 2);
  ReducedOptions options = few_steps();
  const JointPath path = gentle_path();
  // A ball where the hand passes half way, a little aside.
  const Frame hand = pack.robot->link_frame(6, {path.at(0.5).data(), 6});
  pack.bodies[0].body.pose.at = hand.at + hand.rotation * Vec3(0.05, 0, -0.1) + Vec3(0, 0, -0.2);
  options.demands.robot_clearance = 0.06;
  const ReducedResult found = optimise(pack, path, options);
  INFO(found.message);
  REQUIRE(found.ok());
  CHECK(found.robot_clearance >= 0.06 - 1.1e-5);
  CHECK(found.robot_clearance < 0.064);
  CHECK(found.after.steps[5].robot.link == 6);
  CHECK(found.after.steps[5].robot.body == 0);
}

TEST_CASE("optimised with clearance: what is impossible is said, and an interruption keeps what there is", "[dress_pack]") {
  ReducedOptions options = few_steps();
  const JointPath path = gentle_path();
  PackProblem pack = blocked_pack(path, options);
  options.demands.clearance = 0.03;
  SECTION("out of time") {
    RunContext context;
    context.deadline = RunContext::Clock::now();
    const ReducedResult cut = optimise(pack, path, options, context);
    CHECK((cut.status == Status::timeout || cut.status == Status::cancelled));
    CHECK(cut.path.points() == path.points());
  }
  SECTION("cancelled while it improves") {
    std::atomic<bool> cancel{false};
    RunContext context;
    context.cancel = &cancel;
    int calls = 0;
    context.progress = [&](double, const char* what) {
      if (std::string(what) == "optimisation" && ++calls == 5) cancel = true;
    };
    const ReducedResult cut = optimise(pack, path, options, context);
    CHECK(cut.status == Status::cancelled);
    CHECK_THAT(cut.message, Contains("interrupted"));
    CHECK(beyond_robot(cut.path, *pack.robot).empty());
  }
  SECTION("a wall between the start and the end") {
    options.most_iterations = 10;
    pack.bodies[0].body = {Box{{6, 0.02, 6}}, {{0, 0, 0}, exp_rotation({0, 0, 20 * units::deg})}, 0, "wall"};
    const ReducedResult found = optimise(pack, path, options);
    INFO(found.message);
    CHECK(found.status == Status::infeasible);
    CHECK_THAT(found.message, Contains("no path with these clearances was found; on the best one, at t = ") && Contains("mm") && Contains("obstacle 'wall'"));
  }
}
