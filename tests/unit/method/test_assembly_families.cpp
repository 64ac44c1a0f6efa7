// Whether assembly verification is right about scenes that can be installed and that cannot, and whether its proofs bear repeating.
#include <catch2/catch.hpp>

#include <algorithm>

#include "method/assembly/connector_ends.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"
#include "unit/method/assembly_scenes.h"

using namespace tendril;
using namespace tendril::assembly_scenes;

namespace {

void check_installed(const char* name, Case (*make)(int), int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    Case c = make(seed);
    c.options.optimise = false;
    const assembly::Result result = assembly::run(c.scene, c.options);
    INFO(name << ", seed " << seed << ": " << result.message);
    REQUIRE(result.ok);
    CHECK(result.status == Status::solved);
    CHECK(result.proof.deviation <= 0.05 * radius);
    CHECK(result.proof.strain <= c.options.max_strain);
    CHECK(result.proof.clearance >= -0.02 * radius);
  }
}

}  // namespace

TEST_CASE("assembly: what can be installed is proven", "[assembly]") {
  check_installed("two posts", two_posts, 2);
  check_installed("L channel", l_channel, 2);
  check_installed("ring", ring, 2);
  check_installed("lipped channel", lipped_channel, 2);
  check_installed("ring, small connectors", ring_with_small_connectors, 2);
  check_installed("ring, one large connector", ring_with_one_large_connector, 2);
}

TEST_CASE("assembly: what cannot be installed never is, and the answer names connector and ring", "[assembly]") {
  const auto check = [](const char* name, const Case& c, int seed) {
    const assembly::Result result = assembly::run(c.scene, c.options);
    INFO(name << ", seed " << seed << ": " << result.message);
    CHECK_FALSE(result.ok);
    CHECK(result.status == Status::infeasible);
    CHECK(result.manipulation.grips.empty());
    REQUIRE_FALSE(result.attempts.empty());
    const bool named = std::any_of(result.attempts.begin(), result.attempts.end(), [](const assembly::Attempt& attempt) {
      return attempt.outcome.find("connector '") == 0 && attempt.outcome.find("' is wedged in obstacle 'ring") != std::string::npos;
    });
    CHECK(named);
  };
  for (int seed = 1; seed <= 6; ++seed) {
    check("ring, large connectors", ring_with_large_connectors(seed), seed);
    check("ends behind rings", ends_behind_rings(seed), seed);
  }
}

TEST_CASE("assembly: a connector is wedged where it is pulled into a ring too small, not where it lies or passes", "[assembly]") {
  for (const double share : {0.55, 1.7}) {
    const Case c = ring_with_connectors(3, share);
    const assembly::InstalledSystem system = assembly::installed_system(c.scene, c.options, 2);
    CHECK(assembly::wedged(system, system.routed).empty());
    assembly::DriveOptions drive;
    drive.radius = system.radius;
    drive.jam = [&](const SystemEquilibrium& state) { return assembly::wedged(system, state); };
    const Frame from = system.pose(system.routed, system.extra[0]);
    const double side = (from.at - c.scene.obstacles()[0].body.pose.at).dot(from.d3()) > 0 ? 1 : -1;
    const assembly::Pulled pulled = assembly::pull(system, system.extra[0], {from.at, from.at + side * 0.5 * from.d3()}, false, drive, {});
    INFO("share " << share << ": " << pulled.message);
    CHECK(pulled.ok == (share < 1));
    if (pulled.ok) continue;
    CHECK(pulled.pulled.end == assembly::Drive::End::jammed);
    CHECK_THAT(pulled.message, Catch::StartsWith("connector '") && Catch::Contains("is wedged in obstacle 'ring' at ("));
    // All but the last state were free to go on.
    for (std::size_t i = 0; i + 1 < pulled.pulled.passed.size(); ++i) CHECK(assembly::wedged(system, pulled.pulled.passed[i].equilibrium).empty());
  }
}

TEST_CASE("assembly: the hose of the ring family lies in its ring", "[assembly]") {
  for (int seed = 1; seed <= 4; ++seed) {
    const Case c = ring(seed);
    const Frame pose = c.scene.obstacles()[0].body.pose;
    const std::vector<Vec3> points = c.scene.solve().rods[0].equilibrium.points;
    int through = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec3 a = pose.rotation.conjugate() * (points[i] - pose.at), b = pose.rotation.conjugate() * (points[i + 1] - pose.at);
      if (a.x() * b.x() < 0 && (a + a.x() / (a.x() - b.x()) * (b - a)).norm() < 0.034) ++through;
    }
    CHECK(through == 1);
  }
}

TEST_CASE("assembly: a closed box lets nothing in, and the answer says so", "[assembly]") {
  const Case c = closed_box(1);
  const assembly::Result result = assembly::run(c.scene, c.options);
  CHECK_FALSE(result.ok);
  CHECK(result.status == Status::infeasible);
  CHECK_THAT(result.message, Catch::Contains("no way out") && Catch::Contains("enclosed"));
}

TEST_CASE("assembly: a connector's sweep meets what lies in its way, to its slack", "[assembly]") {
  const double slack = 4e-4;
  assembly::Connector plug = connector("plug", false, {0.02, 0.03, 0.04});
  const assembly::ConnectorBody body(plug, 0, slack);
  CHECK(body.reach() == Approx(std::hypot(std::hypot(0.01, 0.015), 0.04)).margin(2 * slack));
  CHECK(body.behind() == Approx(0.04).margin(1e-12));
  Surroundings around;
  around.add({std::make_shared<const TriangleSurface>(torus(0.03, 0.006)), {}, 0, "ring"});
  // Along the ring's axis, the section normal along x: its corners are 18 mm from the axis.
  const auto along = [](double x, double y) { return Frame::looking({x, y, 0}, {1, 0, 0}); };
  CHECK_FALSE(body.sweep(around, along(-0.1, 0), along(0.2, 0)));
  // Aside by more than what is left between its wider half and the ring.
  for (const double aside : {0.02, 0.03, 0.036}) {
    const auto hit = body.sweep(around, along(-0.1, aside), along(0.2, aside));
    REQUIRE(hit);
    CHECK(hit->obstacle == 0);
    CHECK(hit->share < 0.5);
  }
  // Through a thin wall in one step.
  Surroundings wall;
  wall.add({Solid(Box{{0.001, 1, 1}}), {}, 0, "wall"});
  const auto hit = body.sweep(wall, along(-0.1, 0), along(0.3, 0));
  REQUIRE(hit);
  CHECK(hit->share == Approx((0.1 - 0.0005) / 0.4).margin(2 * slack / 0.4));
  // Where it is plugged in it may be, elsewhere not.
  assembly::ConnectorBody plugged(plug, 0, slack);
  plugged.plugged_in(wall, along(0.02, 0));
  CHECK_FALSE(plugged.sweep(wall, along(0.0, 0), along(0.02, 0)));
  CHECK(plugged.sweep(wall, along(0.3, 0.4), along(-0.2, 0.4)));
}

TEST_CASE("assembly: a proof repeated at half the steps says the same", "[assembly]") {
  const Case c = two_posts(3);
  const assembly::Result result = assembly::run(c.scene, c.options);
  REQUIRE(result.ok);
  const assembly::InstalledSystem system = assembly::installed_system(c.scene, {}, 2);
  std::vector<Frame> outside;
  for (std::size_t g = 0; g < result.manipulation.grips.size(); ++g) outside.push_back(result.manipulation.pose(static_cast<int>(g), 0));
  // Where the pull ended, without weight.
  assembly::DriveOptions drive;
  drive.radius = system.radius;
  drive.most_strain = 0.3;
  const auto grip = std::find_if(result.manipulation.grips.begin(), result.manipulation.grips.end(), [](const auto& g) { return !g.connection; });
  REQUIRE(grip != result.manipulation.grips.end());
  const assembly::Pulled pulled = assembly::pull(system, *grip, result.handle_path, false, drive, {});
  REQUIRE(pulled.ok);
  const assembly::Manipulation forward = assembly::traces(system, pulled, result.manipulation.grips).reversed();
  const SystemEquilibrium& start = pulled.pulled.passed.back().equilibrium;
  const assembly::Played whole = assembly::play(system, forward, start, 0.05 * radius, drive, {});
  drive.first_step /= 2;
  drive.most_step /= 2;
  const assembly::Played half = assembly::play(system, forward, start, 0.05 * radius, drive, {});
  CHECK(whole.proof.ok == half.proof.ok);
  CHECK(half.proof.ok);
  CHECK(half.proof.steps > 1.5 * whole.proof.steps);
  CHECK(std::abs(whole.proof.deviation - half.proof.deviation) < 0.02 * radius);
  // Backwards from the routed state along the same way: where it began.
  assembly::Manipulation back = forward.reversed();
  const auto poses = [&](double t) {
    std::vector<Frame> at;
    for (std::size_t g = 0; g < back.grips.size(); ++g) at.push_back(back.pose(static_cast<int>(g), t));
    return at;
  };
  const SystemProblem held = assembly::held_by(system.free, back.grips, poses(0));
  const assembly::Drive returned = assembly::drive(
      held, [&](double t, SystemProblem& problem) { assembly::place(problem, back.grips, poses(t)); },
      [&](double from, double to) { return back.moved(from, to); }, half.moved.passed.back().equilibrium, drive, {});
  REQUIRE(returned.ok());
  double farthest = 0;
  const Equilibrium &first = half.moved.passed.front().equilibrium.rods[0], &last = returned.passed.back().equilibrium.rods[0];
  for (std::size_t i = 0; i < first.points.size(); ++i) farthest = std::max(farthest, (first.points[i] - last.points[i]).norm());
  if (returned.snaps == 0) CHECK(farthest < 0.05 * radius);
}

TEST_CASE("assembly: connectors that make no sense are refused by name", "[assembly]") {
  Case c = two_posts(1);
  const auto message = [&](const assembly::Connector& one) {
    c.options.connectors = {one};
    try {
      assembly::run(c.scene, c.options);
    } catch (const UsageError& e) {
      return std::string(e.what());
    }
    return std::string("nothing thrown");
  };
  assembly::Connector plug = connector("plug", true, {0.02, 0.02, 0.02});
  plug.rod = "hoze";
  CHECK_THAT(message(plug), Catch::Contains("connector 'plug'") && Catch::Contains("hose"));
  plug = connector("", true, {0.02, 0.02, 0.02});
  CHECK_THAT(message(plug), Catch::Contains("without a name"));
  plug = connector("plug", true, {0.02, 0.02, 0.02});
  plug.body.shape = Solid(HalfSpace{});
  CHECK_THAT(message(plug), Catch::Contains("half-space"));
  plug.body.shape = Solid(Box{{0.02, -1, 0.02}});
  CHECK_THAT(message(plug), !Catch::Contains("nothing thrown"));
  plug = connector("plug", true, {0.02, 0.02, 0.02});
  c.options.connectors = {plug, connector("plug", false, {0.02, 0.02, 0.02})};
  CHECK_THROWS_WITH(assembly::run(c.scene, c.options), Catch::Contains("two connectors are named 'plug'"));
}
