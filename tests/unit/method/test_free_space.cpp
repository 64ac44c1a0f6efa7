// Free space: gaps against brute force, the field's bounds, straights, zones and walls, costs, and what is refused.
#include <catch2/catch.hpp>

#include <atomic>
#include <limits>

#include "base/error.h"
#include "method/free_space/free_space.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using namespace tendril::routing;
using tendril::test::box_mesh;
using tendril::test::Random;
using tendril::test::triangle_soup;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PlacedObstacle placed(const std::string& name, decltype(Obstacle::shape) shape, const Frame& pose = {}, double clearance = 0,
                      Preference prefer = Preference::neutral) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = std::move(shape);
  obstacle.body.pose = pose;
  obstacle.clearance = clearance;
  obstacle.prefer = prefer;
  return obstacle;
}

std::shared_ptr<const TriangleSurface> share(Mesh mesh) { return std::make_shared<const TriangleSurface>(std::move(mesh)); }

Frame at(double x, double y, double z) { return {{x, y, z}, Quat::Identity()}; }

/// Meshes and solids with clearances of their own.
void fill(Scene& scene, Random& random) {
  for (int i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i);
    scene.add(placed("soup " + number, share(triangle_soup(40, 0.3, random).moved(Vec3::Zero(), Quat::Identity(), 0.4)),
                     {random.point(0.5), random.rotation()}, i * 0.05, Preference::avoid));
    scene.add(placed("box " + number, Solid(Box{{0.2, 0.3, 0.1}}), {random.point(0.7), random.rotation()}, i * 0.04, Preference::near));
    scene.add(placed("ball " + number, Solid(Sphere{0.15}), {random.point(0.7), Quat::Identity()}, 0, Preference::avoid));
  }
  scene.add(placed("floor", Solid(HalfSpace{}), at(0, 0, -0.9)));
}

SpaceDemands demands_with_zones() {
  SpaceDemands demands;
  demands.radius = 0.01;
  demands.clearance = 0.015;
  demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.95, -infinity, -1.2), Vec3(0.9, 0.8, infinity));
  demands.keep_out = {{Vec3(0.1, 0.1, 0.1), Vec3(0.4, 0.3, 0.2)}, {Vec3(-0.5, -0.5, -0.5), Vec3(-0.4, 0.5, 0.5)}};
  return demands;
}

/// By the scene's obstacles one after the other, from the definitions.
double brute_force(const Scene& scene, const SpaceDemands& demands, const Vec3& p) {
  double least = infinity;
  for (const PlacedObstacle& obstacle : scene.obstacles()) {
    const Frame& pose = obstacle.body.pose;
    const Vec3 local = pose.rotation.conjugate() * (p - pose.at);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape);
    const double distance = mesh ? (*mesh)->tree().closest(local).distance : distance_to(std::get<Solid>(obstacle.body.shape), local).distance;
    least = std::min(least, distance - std::max(obstacle.clearance, demands.clearance));
  }
  for (const Eigen::AlignedBox3d& zone : demands.keep_out)
    least = std::min(least, distance_to(Box{zone.sizes()}, p - zone.center()).distance);
  if (demands.keep_in)
    for (int k = 0; k < 3; ++k) least = std::min({least, p[k] - demands.keep_in->min()[k], demands.keep_in->max()[k] - p[k]});
  return least - demands.radius;
}

}  // namespace

TEST_CASE("the gap is the smallest of all that limits a place, and the bounds hold it", "[free_space]") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Scene scene;
    fill(scene, random);
    const SpaceDemands demands = demands_with_zones();
    const FreeSpace space(scene, demands, {Vec3(-0.8, 0, 0), Vec3(0.8, 0, 0)}, 0.1);
    int free = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(1.2);
      const double expected = brute_force(scene, demands, p);
      CAPTURE(p.transpose(), expected);
      const Gap gap = space.gap(p, infinity);
      REQUIRE(gap.value == Approx(expected).margin(1e-12));
      REQUIRE(gap.obstacle >= 0);
      // The closest point of a mesh or from outside a solid is where the gap says.
      if (gap.value > 0) {
        const double clearance = gap.obstacle < space.surroundings().size() ? space.surroundings().obstacle(gap.obstacle).clearance : 0;
        REQUIRE((p - gap.on).norm() == Approx(gap.value + clearance + demands.radius).margin(1e-12));
      }
      REQUIRE(space.gap(p, expected - 1e-6).obstacle == -1);
      REQUIRE(space.gap(p, expected - 1e-6).value == expected - 1e-6);
      const DistanceField::Bounds bounds = space.bounds(p);
      REQUIRE(bounds.low <= expected + 1e-12);
      REQUIRE(bounds.high >= expected - 1e-12);
      for (const double least : {0.0, 0.02, -0.005, expected + 1e-6, expected - 1e-6})
        REQUIRE(space.is_free(p, least) == (expected >= least));
      free += expected >= 0;
    }
    CHECK(free > 100);
    CHECK(free < 2900);
  }
}

TEST_CASE("the gradient of the gap is that of finite differences", "[free_space]") {
  Random random(11);
  Scene scene;
  fill(scene, random);
  const FreeSpace space(scene, demands_with_zones(), {Vec3(-0.8, 0, 0)}, 0.1);
  int smooth = 0, walls = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.point(0.9);
    const Gap gap = space.gap(p, infinity);
    const double h = 1e-6;
    Vec3 expected;
    double kink = 0;
    for (int k = 0; k < 3; ++k) {
      const double up = space.gap(p + h * Vec3::Unit(k), infinity).value, down = space.gap(p - h * Vec3::Unit(k), infinity).value;
      expected[k] = (up - down) / (2 * h);
      kink = std::max(kink, std::abs(up + down - 2 * gap.value) / h);
    }
    REQUIRE(gap.gradient.norm() == Approx(1).epsilon(1e-9));
    if (kink > 1e-3) continue;
    REQUIRE((gap.gradient - expected).norm() < 1e-4);
    ++smooth;
    walls += space.name(gap.obstacle) == "keep_in";
  }
  CHECK(smooth > 1800);
  CHECK(walls > 50);
}

TEST_CASE("names are those of obstacles, zones and walls", "[free_space]") {
  Scene scene;
  scene.add(placed("engine", Solid(Sphere{0.1}), at(0, 0, 0)));
  SpaceDemands demands;
  demands.radius = 0.01;
  demands.keep_out = {{Vec3(1, 0, 0), Vec3(1.1, 0.1, 0.1)}, {Vec3(2, 0, 0), Vec3(2.1, 0.1, 0.1)}};
  demands.keep_in = Eigen::AlignedBox3d(Vec3(-3, -3, -3), Vec3(3, 3, 3));
  const FreeSpace space(scene, demands, {Vec3(0.5, 0, 0)}, 0.1);
  const auto name = [&](const Vec3& p) { return space.name(space.gap(p, infinity).obstacle); };
  CHECK(name({0.3, 0, 0}) == "engine");
  CHECK(name({0.9, 0, 0}) == "keep_out 1");
  CHECK(name({2.2, 0, 0}) == "keep_out 2");
  CHECK(name({0, 2.5, 0}) == "keep_in");
  CHECK(space.gap({0, 2.5, 0}, infinity).value == Approx(0.49));
  CHECK(space.gap({0, 2.5, 0}, infinity).on.isApprox(Vec3(0, 3, 0)));
  CHECK(space.gap({std::nan(""), 0, 0}, 1).obstacle == -1);
  CHECK_FALSE(space.is_free({std::nan(""), 0, 0}));
}

TEST_CASE("a place at exactly the distance that is demanded is free", "[free_space]") {
  Scene scene;
  scene.add(placed("wall", share(box_mesh({0.1, 0.5, 0.5})), at(0, 0, 0)));
  scene.add(placed("post", Solid(Cylinder{0.1, 1}), at(1, 0, 0)));
  SpaceDemands demands;
  demands.radius = 0.01;
  demands.clearance = 0.02;
  demands.keep_in = Eigen::AlignedBox3d(Vec3(-2, -2, -2), Vec3(2, 2, 2));
  const FreeSpace space(scene, demands, {Vec3(0.5, 0, 0)}, 0.1);
  CHECK(space.is_free(Vec3(0.13, 0, 0)));
  CHECK_FALSE(space.is_free(Vec3(0.13 - 2e-9, 0, 0)));
  CHECK(space.is_free(Vec3(0.87, 0, 0)));
  CHECK_FALSE(space.is_free(Vec3(0.87 + 2e-9, 0, 0)));
  CHECK(space.is_free(Vec3(0.5, 1.99, 0)));
  CHECK_FALSE(space.is_free(Vec3(0.5, 1.99 + 2e-9, 0)));
  // Along the wall at exactly that distance.
  CHECK(space.is_free(Vec3(0.13, -0.45, 0.1), Vec3(0.13, 0.45, -0.3)));
  CHECK_FALSE(space.is_free(Vec3(0.13 - 3e-5, -0.45, 0.1), Vec3(0.13 - 3e-5, 0.45, -0.3)));
  CHECK(space.is_free(Vec3(0.5, 1.99, -1.5), Vec3(0.5, 1.99, 1.5)));
}

TEST_CASE("a straight is free when all its places are", "[free_space]") {
  for (unsigned seed = 21; seed <= 24; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Scene scene;
    fill(scene, random);
    const SpaceDemands demands = demands_with_zones();
    const FreeSpace space(scene, demands, {Vec3(-0.8, 0, 0), Vec3(0.8, 0, 0)}, 0.1);
    int free = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 a = random.point(0.8), b = i % 9 == 0 ? a : i % 2 ? random.point(0.8) : Vec3(a + 0.1 * random.direction());
      const double leasts[] = {0, 0.03, -0.01, -0.02};
      const double least = leasts[random.below(4)];
      double lowest = infinity;
      const int samples = 400;
      for (int k = 0; k <= samples; ++k) lowest = std::min(lowest, brute_force(scene, demands, a + k / double(samples) * (b - a)));
      CAPTURE(i, a.transpose(), b.transpose(), least, lowest);
      const bool judged = space.is_free(a, b, least);
      // Between the samples the gap may be lower by half their distance at most.
      if (judged) REQUIRE(lowest >= least - FreeSpace::straight_tolerance);
      else REQUIRE(lowest <= least + 0.5 * (b - a).norm() / samples + FreeSpace::straight_tolerance);
      free += judged;
    }
    CHECK(free > 20);
    CHECK(free < 380);
  }
}

TEST_CASE("a straight never slips through a thin sheet", "[free_space]") {
  Mesh sheet;
  sheet.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  Scene scene;
  scene.add(placed("sheet", share(sheet), at(0, 0, 0)));
  for (const double radius : {0.0, 1e-4, 0.02}) {
    SpaceDemands demands;
    demands.radius = radius;
    const FreeSpace space(scene, demands, {Vec3(0.5, 0, 0)}, 0.2);
    Random random(31);
    for (int i = 0; i < 200; ++i) {
      const Vec3 a(random.in(-0.5, -0.001), random.in(-0.9, 0.9), random.in(-0.9, 0.9)), b(random.in(0.001, 0.5), random.in(-0.9, 0.9), random.in(-0.9, 0.9));
      // Without a radius the sheet itself is at a gap of 0: free, but not with anything on top.
      REQUIRE_FALSE(space.is_free(a, b, radius > 0 ? 0 : 2e-5));
    }
  }
}

TEST_CASE("the region holds obstacles, zones and ends with a margin, within keep_in", "[free_space]") {
  Scene none;
  SpaceDemands demands;
  const FreeSpace empty(none, demands, {Vec3(0, 0, 0), Vec3(1, 2, 3)}, 0.5);
  CHECK(empty.region().min().isApprox(Vec3(-0.5, -0.5, -0.5)));
  CHECK(empty.region().max().isApprox(Vec3(1.5, 2.5, 3.5)));
  CHECK_FALSE(empty.has_obstacles());
  CHECK(empty.gap({0, 0, 0}, 7).value == 7);
  CHECK(empty.bounds({0, 0, 0}).low == infinity);
  CHECK(empty.is_free(Vec3(0, 0, 0), Vec3(100, 0, 0), 3));
  Scene scene;
  scene.add(placed("box", Solid(Box{{2, 2, 2}}), at(0, 0, 0)));
  scene.add(placed("floor", Solid(HalfSpace{}), at(0, 0, -9)));
  demands.keep_out = {{Vec3(3, 0, 0), Vec3(4, 1, 1)}};
  const FreeSpace space(scene, demands, {Vec3(0, 5, 0)}, 0.5);
  CHECK(space.region().min().isApprox(Vec3(-1.5, -1.5, -1.5)));
  CHECK(space.region().max().isApprox(Vec3(4.5, 5.5, 1.5)));
  demands.keep_in = Eigen::AlignedBox3d(Vec3(-1.2, -infinity, -5), Vec3(infinity, 5.1, 5));
  const FreeSpace within(scene, demands, {Vec3(0, 5, 0)}, 0.5);
  CHECK(within.region().min().isApprox(Vec3(-1.2, -1.5, -1.5)));
  CHECK(within.region().max().isApprox(Vec3(4.5, 5.1, 1.5)));
}

TEST_CASE("costs follow their definition, and their gradients finite differences", "[free_space]") {
  for (const bool near : {false, true}) {
    Random random(41);
    Scene scene;
    fill(scene, random);
    SpaceDemands demands;
    demands.radius = 0.02;
    demands.clearance = 0.3;  // costs do not know it
    demands.preference = near ? 2 : 0;
    demands.clearance_weight = near ? 0 : 3;
    demands.preference_range = 0.25;
    const FreeSpace space(scene, demands, {Vec3(0, 0, 0)}, 0.1);
    CHECK(space.has_preferences());
    int smooth = 0, sloping = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = random.point(1);
      double sum = 0, least = infinity;
      for (const PlacedObstacle& obstacle : scene.obstacles()) {
        Surroundings one;
        Obstacle body = obstacle.body;
        one.add(body);
        const double gap = one.closest(p, infinity).distance - demands.radius, x = std::max(0.0, 1 - gap / demands.preference_range);
        if (obstacle.prefer == Preference::avoid) sum += x * x;
        if (obstacle.prefer == Preference::near) sum += std::max(0.0, 1 - x * x);
        if (obstacle.prefer != Preference::near) least = std::min(least, gap);
      }
      const double x = std::max(0.0, 1 - least / demands.preference_range);
      Vec3 gradient, expected;
      const double cost = space.cost(p, &gradient);
      REQUIRE(cost == Approx(1 + demands.preference * sum + demands.clearance_weight * x * x).epsilon(1e-9));
      REQUIRE(cost >= 1);
      REQUIRE(space.cost(p) == cost);
      double kink = 0;
      const double h = 1e-6;
      for (int k = 0; k < 3; ++k) {
        const double up = space.cost(p + h * Vec3::Unit(k)), down = space.cost(p - h * Vec3::Unit(k));
        expected[k] = (up - down) / (2 * h);
        kink = std::max(kink, std::abs(up + down - 2 * cost) / h);
      }
      if (kink > 1e-2) continue;
      REQUIRE((gradient - expected).norm() < 1e-3 * (1 + expected.norm()));
      ++smooth;
      sloping += expected.norm() > 0.1;
    }
    CHECK(smooth > 1700);
    CHECK(sloping > 500);
  }
}

TEST_CASE("without a weight or an obstacle that it concerns every place costs the same", "[free_space]") {
  Scene scene;
  scene.add(placed("ball", Solid(Sphere{0.1}), at(0, 0, 0), 0, Preference::near));
  SpaceDemands demands;
  demands.clearance_weight = 2;
  CHECK_FALSE(FreeSpace(scene, demands, {Vec3(1, 0, 0)}, 0.1).has_preferences());
  demands.preference = 1;
  CHECK(FreeSpace(scene, demands, {Vec3(1, 0, 0)}, 0.1).has_preferences());
  demands.preference = demands.clearance_weight = 0;
  const FreeSpace space(scene, demands, {Vec3(1, 0, 0)}, 0.1);
  Vec3 gradient(1, 1, 1);
  CHECK(space.cost({0.15, 0, 0}, &gradient) == 1);
  CHECK(gradient == Vec3::Zero());
}

TEST_CASE("objects with other demands share one field", "[free_space]") {
  Random random(51);
  Scene scene;
  fill(scene, random);
  scene.add(placed("bay", share(box_mesh({1, 1, 1}, 40)), at(0, 0, 0)));
  SpaceDemands demands;
  demands.radius = 0.02;
  const auto field_of = [&] { return scene.fields().get(); };
  const FieldStore* const store = field_of();
  const FreeSpace first(scene, demands, {Vec3(0.5, 0, 0)}, 0.1);
  CHECK(std::get<std::shared_ptr<const TriangleSurface>>(scene.obstacle("bay").body.shape)->has_tree());
  demands.radius = 0.015;
  demands.keep_out = {{Vec3(0, 0, 0), Vec3(0.2, 0.2, 0.2)}};
  const FreeSpace second(scene, demands, {Vec3(-0.5, 0, 0)}, 0.1);
  CHECK(field_of() == store);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random.point(1);
    const double expected = brute_force(scene, demands, p);
    REQUIRE(second.bounds(p).low <= expected);
    REQUIRE(second.bounds(p).high >= expected);
  }
}

TEST_CASE("a stopped space still answers, by the trees", "[free_space]") {
  Random random(61);
  Scene scene;
  fill(scene, random);
  const std::atomic<bool> cancelled = true;
  RunContext context;
  context.cancel = &cancelled;
  const SpaceDemands demands = demands_with_zones();
  const FreeSpace space(scene, demands, {Vec3(-0.8, 0, 0)}, 0.1, context);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random.point(1);
    REQUIRE(space.is_free(p) == (brute_force(scene, demands, p) >= 0));
  }
}

TEST_CASE("demands that make no sense are refused", "[free_space]") {
  Scene scene;
  const auto message = [&](const SpaceDemands& demands, const std::vector<Vec3>& ends = {Vec3(0, 0, 0)}, double margin = 0.1) -> std::string {
    try {
      const FreeSpace space(scene, demands, ends, margin);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [](auto change) {
    SpaceDemands demands;
    change(demands);
    return demands;
  };
  CHECK(message({}).empty());
  CHECK(message(with([](auto& d) { d.radius = -1; })) == "free space: 'radius' is -1 m; a finite length of at least 0 expected");
  CHECK(message(with([](auto& d) { d.clearance = std::nan(""); })) == "free space: 'clearance' is nan m; a finite length of at least 0 expected");
  CHECK(message({}, {Vec3(0, 0, 0)}, infinity) == "free space: 'margin' is inf m; a finite length of at least 0 expected");
  CHECK(message(with([](auto& d) { d.preference_range = 0; })) == "free space: 'preference_range' is 0 m; a length above 0 expected");
  CHECK(message(with([](auto& d) { d.preference = -2; })) == "free space: the weight 'preference' is -2; a finite number of at least 0 expected");
  CHECK(message(with([](auto& d) { d.clearance_weight = infinity; })) ==
        "free space: the weight 'clearance_weight' is inf; a finite number of at least 0 expected");
  CHECK(message(with([](auto& d) { d.keep_out = {{Vec3(0, 0, 0), Vec3(1, 0, 1)}}; })) ==
        "free space: keep_out 1 is the box from (0, 0, 0) m to (1, 0, 1) m; the lower corner first, finite and with volume, expected");
  CHECK(message(with([](auto& d) { d.keep_in = Eigen::AlignedBox3d(Vec3(1, 1, 1), Vec3(0, 0, 0)); })) ==
        "free space: keep_in is the box from (1, 1, 1) m to (0, 0, 0) m; the lower corner first, and volume, expected");
  CHECK(message(with([](auto& d) { d.keep_in = Eigen::AlignedBox3d(Vec3(1, 1, 1), Vec3(2, 2, 2)); })) ==
        "free space: the end at (0, 0, 0) m lies outside keep_in, from (1, 1, 1) m to (2, 2, 2) m; make that larger");
  CHECK(message({}, {Vec3(0, std::nan(""), 0)}) == "free space: an end is at (0, nan, 0) m; a finite place expected");
  CHECK(message({}, {}) == "free space: there is neither an end nor an obstacle; at least one expected");
  scene.add(placed("ball", Solid(Sphere{0.1})));
  CHECK(message(with([](auto& d) { d.keep_in = Eigen::AlignedBox3d(Vec3(1, 1, 1), Vec3(2, 2, 2)); }), {}) ==
        "free space: keep_in lies away from all obstacles; an end within it expected");
}
