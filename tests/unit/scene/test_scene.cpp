#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>

#include "base/error.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

TEST_CASE("names in a scene are unique, and unknown ones name their neighbours", "[scene]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  scene.add(solid("floor", HalfSpace{}, {0, 0, 0}));
  CHECK_THROWS_WITH(scene.add(sagging_hose()), Contains("already has a rod 'hose'"));
  CHECK_THROWS_WITH(scene.add(solid("hose", HalfSpace{}, {0, 0, 0})), Contains("already has a rod 'hose'"));
  CHECK_THROWS_WITH(scene.add(sagging_hose("floor")), Contains("already has an obstacle 'floor'"));
  CHECK_THROWS_WITH(scene.rod("hoes"), Contains("did you mean 'hose'?"));
  CHECK_THROWS_WITH(scene.obstacle("flor"), Contains("did you mean 'floor'?"));
  CHECK_THROWS_WITH(scene.remove("wall"), Contains("'wall'") && Contains("hose, floor"));
  scene.remove("hose");
  scene.remove("floor");
  CHECK(scene.rods().empty());
  CHECK(scene.surroundings() == nullptr);
}

TEST_CASE("what a scene cannot contain", "[scene]") {
  CHECK_THROWS_WITH(Scene({0, 0, std::nan("")}), Contains("'gravity'"));
  Scene scene;
  CHECK_THROWS_WITH(scene.add(solid("", HalfSpace{}, {0, 0, 0})), Contains("name is empty"));
  CHECK_THROWS_WITH(scene.add(solid("ball", Sphere{-1}, {0, 0, 0})), Contains("radius"));
  CHECK_THROWS_WITH(scene.add(solid("ball", Sphere{1}, {0, 0, 0}, -0.01)), Contains("'clearance'"));
  CHECK_THROWS_WITH(scene.add(solid("ball", Sphere{1}, {0, 0, 0}, INFINITY)), Contains("'clearance'"));
  CHECK(scene.obstacles().empty());
}

TEST_CASE("a scene that cannot be solved says why", "[scene]") {
  Scene scene(earth);
  CHECK_THROWS_WITH(scene.solve(), Contains("no rods"));
  scene.add(PlacedRod("loose", Rod::uniform(1, soft_section()), {}, {}));
  CHECK_THROWS_WITH(scene.solve(), Contains("'loose' is not held anywhere"));

  Scene heavy(earth);
  const Section lead = Section::round(0.02, 0, Material::from_poisson(1e3, 0.4, 11000));
  heavy.add(PlacedRod("lead", Rod::uniform(1, lead), Frame::looking({0, 0, 0}, {1, 0, 0}), {}));
  CHECK_THROWS_WITH(heavy.solve(), Contains("'lead'") && Contains("EA"));
}

TEST_CASE("the supports carry the weight", "[scene]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const SolvedRod& hose = eq.rod("hose");
  const double weight = hose.problem.rod.mass() * 9.81;
  const Vec3 total = eq.reaction(hose, 0).force + eq.reaction(hose, 1.2).force;
  CHECK(total.z() == Approx(weight).epsilon(1e-8));
  CHECK(std::abs(total.x()) < 1e-8 * weight);
  CHECK(eq.reaction(hose, 0).force.z() == Approx(weight / 2).epsilon(1e-6));
  CHECK_THROWS_WITH(eq.reaction(hose, 0.5), Contains("not held at 0.5 m") && Contains("start, finish"));
  CHECK_THROWS_WITH(eq.rod("hoes"), Contains("did you mean 'hose'?"));
  CHECK(eq.energy().bend > 0);
  CHECK(eq.energy().gravity > 0);  // it hangs above the world origin
  CHECK(eq.energy().contact == 0);
  CHECK(eq.stable());
  CHECK_FALSE(eq.error());
  CHECK(eq.message() == "solved");
}

TEST_CASE("rods that do not touch each other are solved as if alone", "[scene]") {
  Scene both(earth), alone(earth);
  both.add(sagging_hose("one"));
  both.add(sagging_hose("two", 20));
  alone.add(sagging_hose("two", 20));
  const SceneEquilibrium a = both.solve(), b = alone.solve();
  CHECK(a.rod("two").equilibrium.points == b.rod("two").equilibrium.points);
  CHECK(a.iterations() == a.rods[0].equilibrium.iterations + a.rods[1].equilibrium.iterations);
  CHECK(a.energy().bend == Approx(a.rods[0].equilibrium.energy.bend + b.rods[0].equilibrium.energy.bend));
}

TEST_CASE("a warm start finds the same equilibrium in fewer steps", "[scene]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  const SceneEquilibrium cold = scene.solve();
  scene.rod("hose").release(1.2);
  scene.rod("hose").hold({1.2, Frame::looking({0.81, 0, 1}, {1, 0, 0})});
  const SceneEquilibrium again = scene.solve(), warm = scene.solve({}, {}, &cold);
  REQUIRE(warm.ok());
  CHECK(warm.iterations() <= again.iterations());
  for (std::size_t i = 0; i < warm.rods[0].equilibrium.points.size(); ++i)
    CHECK((warm.rods[0].equilibrium.points[i] - again.rods[0].equilibrium.points[i]).norm() < 1e-8);
  // The first equilibrium is a picture of its own time.
  CHECK(cold.rods[0].problem.holds[1].frame.at.x() == 0.8);
}

TEST_CASE("moving and turning the whole world moves the answer along", "[scene]") {
  const Vec3 axis = Vec3(1, 2, -1).normalized();
  const Frame world{{3, -1, 2}, exp_rotation(axis * 1.3)};
  Scene here(earth), there(world.rotation * earth);
  here.add(sagging_hose());
  const std::vector<Hold> holds = here.rods().front()->holds();
  there.add(PlacedRod("hose", here.rods().front()->rod(), world * holds[0].frame, world * holds[1].frame));
  const SceneEquilibrium a = here.solve(), b = there.solve();
  REQUIRE((a.ok() && b.ok()));
  for (std::size_t i = 0; i < a.rods[0].equilibrium.points.size(); ++i)
    CHECK((world * Frame{a.rods[0].equilibrium.points[i]}).at.isApprox(b.rods[0].equilibrium.points[i], 1e-8));
  CHECK(a.energy().bend == Approx(b.energy().bend).epsilon(1e-8));
}

TEST_CASE("a cancelled or late solve is a result, not an exception", "[scene]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  std::atomic<bool> cancel{true};
  RunContext cancelled;
  cancelled.cancel = &cancel;
  const SceneEquilibrium stopped = scene.solve({}, cancelled);
  CHECK_FALSE(stopped.ok());
  CHECK(stopped.status() == Status::cancelled);
  CHECK_THAT(stopped.message(), Contains("hose: "));
  RunContext late;
  late.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(scene.solve({}, late).status() == Status::timeout);
}

TEST_CASE("only obstacles that a rod can reach get a distance tree", "[scene]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  scene.add(sheet("near", {0, 0, 0.4}));
  scene.add(sheet("far", {0, 0, -40}));
  CHECK_FALSE(scene.obstacle("near").has_tree());
  const SceneEquilibrium eq = scene.solve();
  CHECK(scene.obstacle("near").has_tree());
  CHECK_FALSE(scene.obstacle("far").has_tree());
  REQUIRE(eq.obstacles.size() == 2);
  CHECK(eq.clearance(eq.rod("hose"), eq.obstacle("far")).value > 39);
}
