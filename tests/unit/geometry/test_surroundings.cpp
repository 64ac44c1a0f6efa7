#include <catch2/catch.hpp>
#include <thread>

#include "base/error.h"
#include "base/units.h"
#include "geometry/surroundings.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;

namespace {

std::shared_ptr<const TriangleSurface> share(Mesh mesh) { return std::make_shared<const TriangleSurface>(std::move(mesh)); }

}  // namespace

TEST_CASE("the closest of several obstacles, by number", "[surroundings]") {
  Surroundings field;
  CHECK(field.closest({0, 0, 0}, 3).obstacle == -1);
  CHECK(field.closest({0, 0, 0}, 3).distance == 3);
  CHECK(field.add({share(box_mesh({1, 1, 1})), {{5, 0, 0}, Quat::Identity()}, 0}) == 0);
  CHECK(field.add({Solid(Sphere{1}), {{0, 4, 0}, Quat::Identity()}, 0}) == 1);
  CHECK(field.add({Solid(HalfSpace{}), Frame::looking({0, 0, -6}, {0, 0, 1}), 0}) == 2);
  CHECK(field.size() == 3);
  const ClosestPoint near = field.closest({0, 0, 0}, 100);
  CHECK(near.obstacle == 1);
  CHECK(near.distance == Approx(3));
  CHECK(near.point.isApprox(Vec3(0, 3, 0)));
  CHECK(field.closest({2, 0, 0}, 100).obstacle == 0);
  CHECK(field.closest({0, 0, -5}, 100).obstacle == 2);
  CHECK(field.closest({0, 0, 0}, 2.9).obstacle == -1);
  CHECK(field.closest({0, 3.5, 0}, 100).distance == Approx(-0.5));
  CHECK(field.closest({0, 3.5, 0}, 0.1).distance == Approx(-0.5));
  CHECK(field.closest_on(2, {0, 0, 0}, 100).distance == Approx(6));
  CHECK(field.closest({std::nan(""), 0, 0}, 1).obstacle == -1);
  CHECK(field.box().max().x() == Approx(6));
}

TEST_CASE("one surface in several places shares one tree, built by the first query that comes near", "[surroundings]") {
  Random random(91);
  const auto surface = share(box_mesh({0.3, 0.2, 0.1}, 3));
  Surroundings field, other;
  std::vector<Frame> poses;
  for (int i = 0; i < 5; ++i) {
    poses.push_back({random.point(2), random.rotation()});
    field.add({surface, poses.back(), 0});
  }
  other.add({surface, {}, 0});
  CHECK(field.closest({50, 0, 0}, 1).obstacle == -1);
  CHECK_FALSE(field.ray({50, 0, 0}, {60, 0, 0}));
  std::vector<DistanceTerm> none;
  field.terms({50, 0, 0}, 1, none);
  CHECK_FALSE(surface->has_tree());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random.point(2);
    double expected = 1e9;
    for (const Frame& pose : poses) {
      const Frame local = pose.inverse() * Frame{p, Quat::Identity()};
      expected = std::min(expected, other.closest(local.at, 1e9).distance);
    }
    CHECK(field.closest(p, 1e9).distance == Approx(expected));
  }
  CHECK(surface->has_tree());
  CHECK_FALSE(surface->has_topology());
}

TEST_CASE("an obstacle that is moved answers as one put there at first", "[surroundings]") {
  Random random(92);
  Surroundings moved;
  moved.add({share(box_mesh({0.3, 0.2, 0.1}, 3)), {random.point(2), random.rotation()}, 0});
  moved.add({Solid(Cylinder{0.2, 0.5}), {random.point(2), random.rotation()}, 0});
  for (int round = 0; round < 10; ++round) {
    Surroundings fresh;
    for (int k = 0; k < 2; ++k) {
      Obstacle there = moved.obstacle(k);
      there.pose = {random.point(1), random.rotation()};
      moved.move(k, there.pose);
      fresh.add(there);
      CHECK(moved.box_of(k).min() == fresh.box_of(k).min());
      CHECK(moved.box_of(k).max() == fresh.box_of(k).max());
    }
    const Vec3 p = random.point(1.5), q = random.point(1.5);
    CHECK(moved.closest(p, 9).distance == fresh.closest(p, 9).distance);
    CHECK(moved.closest(p, 9).point == fresh.closest(p, 9).point);
    CHECK(moved.ray(p, q).has_value() == fresh.ray(p, q).has_value());
  }
  CHECK_THROWS_WITH(moved.move(0, {{0, std::nan(""), 0}, Quat::Identity()}), Catch::Matchers::Contains("the pose is not a frame"));
  CHECK_THROWS_WITH(moved.move(1, {{0, 0, 0}, Quat(1, 1, 0, 0)}), Catch::Matchers::Contains("the pose is not a frame"));
}

TEST_CASE("rays meet the nearest obstacle in world axes", "[surroundings]") {
  Surroundings field;
  field.add({share(box_mesh({1, 1, 1})), {{5, 0, 0}, Quat(Eigen::AngleAxisd(units::pi / 4, Vec3::UnitZ()))}, 0});
  field.add({Solid(Sphere{0.5}), {{2, 0, 0}, Quat::Identity()}, 0.3});
  const auto ball = field.ray({0, 0, 0}, {10, 0, 0});
  REQUIRE(ball);
  CHECK(ball->obstacle == 1);
  CHECK(ball->point.isApprox(Vec3(1.5, 0, 0)));
  CHECK(ball->normal.isApprox(-Vec3::UnitX()));
  const auto box = field.ray({10, 0.2, 0}, {0, 0.2, 0});
  REQUIRE(box);
  CHECK(box->obstacle == 0);
  CHECK(box->point.x() == Approx(5 + std::sqrt(2) - 0.2));
  CHECK(box->normal.isApprox(Vec3(1, 1, 0).normalized()));
  CHECK(box->share == Approx((10 - box->point.x()) / 10));
  CHECK_FALSE(field.ray({0, 0, 3}, {10, 0, 3}));
  CHECK_FALSE(field.ray({2, 0, 0}, {2, 3, 0}));   // out of a solid
  CHECK(field.ray({5, 0, 0}, {5, 5, 0}));         // out of a mesh
}

TEST_CASE("a polyline that crosses a sheet or a solid is found out", "[surroundings]") {
  Mesh sheet;
  sheet.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  Surroundings field;
  field.add({share(sheet), {}, 0});
  field.add({Solid(Sphere{1}), {{0, 0, 5}, Quat::Identity()}, 0});
  CHECK_FALSE(first_crossing(field, {}));
  CHECK_FALSE(first_crossing(field, {{0, 0, 1}, {2, 0, 1}, {2, 0, -1}, {0, 0, -1}}));
  const auto through = first_crossing(field, {{2, 0, 1}, {0.5, 0, 1}, {0.5, 0.1, -1}, {0.5, 0.1, -2}});
  REQUIRE(through);
  CHECK(through->segment == 1);
  CHECK(through->hit.obstacle == 0);
  CHECK(through->hit.point.isApprox(Vec3(0.5, 0.05, 0)));
  CHECK(first_crossing(field, {{0, 0, 2}, {0, 0, 4.5}})->hit.obstacle == 1);
  const auto inside = first_crossing(field, {{0, 0, 4.5}, {0, 0, 2}});
  REQUIRE(inside);
  CHECK(inside->segment == 0);
  CHECK(inside->hit.share == 0);
}

TEST_CASE("several threads ask a fresh surface at once and all get the same answers", "[surroundings]") {
  const auto surface = share(box_mesh({1, 1, 1}, 40));
  Surroundings field;
  field.add({surface, {}, 0});
  const auto all = [&] {
    Random random(99);
    double sum = 0;
    std::vector<DistanceTerm> terms;
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random.point(1.5);
      sum += field.closest(p, 1e9).distance;
      terms.clear();
      field.terms(p, 0.2, terms);
      for (const DistanceTerm& t : terms) sum += t.weight * t.distance;
    }
    return sum;
  };
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  for (double& sum : sums) threads.emplace_back([&] { sum = all(); });
  for (std::thread& thread : threads) thread.join();
  for (double sum : sums) CHECK(sum == sums[0]);
}

TEST_CASE("obstacles that cannot be are refused", "[surroundings]") {
  Surroundings field;
  CHECK_THROWS_WITH(field.add({std::shared_ptr<const TriangleSurface>(), {}, 0}), "obstacle: no mesh was given");
  CHECK_THROWS_WITH(field.add({Solid(Sphere{0}), {}, 0}), "obstacle: radius is 0; a finite length above 0 expected (m)");
  CHECK_THROWS_WITH(field.add({Solid(Sphere{1}), {}, std::nan("")}),
                    "obstacle: the clearance is nan m; at least 0 expected");
  CHECK_THROWS_WITH(field.add({Solid(Sphere{1}), {{std::nan(""), 0, 0}, Quat::Identity()}, 0}),
                    "obstacle: the pose is not a frame; a finite place and a unit rotation expected");
  CHECK_THROWS_AS(field.add({Solid(Sphere{1}), {{0, 0, 0}, Quat(2, 0, 0, 0)}, 0}), UsageError);
  CHECK(field.size() == 0);
}
