// What a settled harness's run costs is what routing would have it cost.
#include <catch2/catch.hpp>

#include "method/free_space/place_cost.h"
#include "scene/quantities.h"
#include "unit/robot/robots.h"
#include "unit/scene/fixtures.h"

using namespace tendril;

TEST_CASE("quantities: the cost of a run is the integral of routing's cost") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    test::Random random(seed);
    Scene scene;
    for (int k = 0; k < 5; ++k) {
      PlacedObstacle ball = testing::solid(("ball " + std::to_string(k)).c_str(), Sphere{random.in(0.02, 0.06)},
                                           {random.in(0, 1), random.in(0.1, 0.2), random.in(-0.1, 0.1)});
      ball.prefer = Preference(random.below(3));
      scene.add(ball);
    }
    scene.add(PlacedRod("rod", Rod::uniform(1, testing::soft_section(), 20), Frame::looking({0, 0, 0}, {1, 0, 0}),
                        Frame::looking({1, 0, 0}, {1, 0, 0})));
    const SceneEquilibrium eq = scene.solve();
    routing::SpaceDemands demands;
    demands.radius = 0.01;
    demands.clearance_weight = random.in(0, 2);
    demands.preference = random.in(0, 3);
    demands.preference_range = random.in(0.05, 0.2);
    const Eigen::AlignedBox3d box(Vec3(-1, -1, -1), Vec3(2, 1, 1));
    const routing::PlaceCost cost(scene, demands, box, box, 0.01);
    double integral = 0;
    constexpr int places = 4000;
    for (int i = 0; i < places; ++i) integral += cost.exact({(i + 0.5) / places, 0, 0}) / places;
    const Quantities q = quantities_of(
        eq, {.clearance = demands.clearance_weight, .preference = demands.preference, .range = demands.preference_range});
    CHECK(q.total.cost == Approx(integral).epsilon(1e-4));
    CHECK(q.total.cost >= 1 - 1e-9);
  }
}
