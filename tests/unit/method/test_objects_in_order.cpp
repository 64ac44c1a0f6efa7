// Several objects in order, and the front of alternatives.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "geometry/triangle_surface.h"
#include "method/route/objects_in_order.h"
#include "method/route/pareto_front.h"
#include "scene/formed_rod.h"

using namespace tendril;
using namespace tendril::route;

namespace {

constexpr double mm = units::mm;

PlacedObstacle solid(const char* name, const Solid& shape, const Frame& pose = {}) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = shape;
  obstacle.body.pose = pose;
  return obstacle;
}

/// A moulded cable along a direction through the origin.
ObjectToRoute object(const char* name, const Vec3& along) {
  ObjectToRoute object;
  object.name = name;
  Options& o = object.options;
  o.from = Frame::looking(-0.2 * along, along);
  o.to = Frame::looking(0.2 * along, along);
  o.section = Section::round(10 * mm, 0, Material::from_poisson(20e6, 0.4, 1200));
  o.preformed = true;
  o.space.radius = 5 * mm;
  o.space.clearance = 3 * mm;
  o.curve.radii = {40 * mm};
  o.curve.end_straight = 10 * mm;
  return object;
}

Route alternative(double length, double clearance, bool ok = true) {
  Route route;
  route.design.rod.length = length;
  route.nominal_clearance.gap.value = clearance;
  route.nominal_clearance.to = "wall";
  route.ok = ok;
  return route;
}

/// Smallest distance between two polylines' points, spaced finely; m.
double distance_between(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double least = 1e9;
  for (const Vec3& p : a)
    for (const Vec3& q : b) least = std::min(least, (p - q).norm());
  return least;
}

}  // namespace

TEST_CASE("objects in order: the first runs as if alone, the next ones keep clear of it", "[route]") {
  const Scene scene;
  std::vector<ObjectToRoute> objects{object("feed", {1, 0, 0}), object("return", {0, 1, 0}), object("third", Vec3(1, 1, 0).normalized())};
  objects[2].apart = 6 * mm;
  const ObjectsResult result = run_in_order(scene, objects);
  INFO(result.message);
  REQUIRE(result.ok);
  REQUIRE(result.objects.size() == 3);
  CHECK(result.message == "3 of 3 objects");
  std::vector<std::vector<Vec3>> lines;
  for (const RoutedObject& o : result.objects) lines.push_back(o.result.routes[o.chosen].refined.equilibrium->rods[0].equilibrium.points);
  CHECK(result.objects[0].result.routes[0].length() == Approx(0.4).margin(1e-6));
  // Points lie up to a segment apart: what a chord hides is less than 0.05 mm at these distances.
  CHECK(distance_between(lines[0], lines[1]) >= 2 * 5 * mm + 3 * mm - 0.05 * mm);
  CHECK(distance_between(lines[0], lines[2]) >= 2 * 5 * mm + 6 * mm - 0.05 * mm);
  CHECK(distance_between(lines[1], lines[2]) >= 2 * 5 * mm + 6 * mm - 0.05 * mm);
  CHECK(distance_between(lines[0], lines[1]) < 2 * 5 * mm + 3 * mm + 1.0 * mm);
  const Scene all = scene_of(scene, result);
  CHECK(all.rods().size() == 3);
  CHECK(all.solve().ok());
}

TEST_CASE("objects in order: one way round for both is found by taking the first one's next alternative", "[route]") {
  // Two openings in a wall, each of which one object fills: both run shortest through the lower one, but the second fits there alone.
  Scene scene;
  const auto block = [&](const char* name, double y_low, double y_high, double z_low, double z_high) {
    scene.add(solid(name, Box{{20 * mm, y_high - y_low, z_high - z_low}}, {{0, 0.5 * (y_low + y_high), 0.5 * (z_low + z_high)}, Quat::Identity()}));
  };
  block("below", -1, 1, -1, -12 * mm);
  block("between", -1, 1, 12 * mm, 60 * mm);
  block("above", -1, 1, 150 * mm, 1);
  block("left", -1, -12 * mm, -12 * mm, 12 * mm);
  block("right", 12 * mm, 1, -12 * mm, 12 * mm);
  block("upper left", -1, -60 * mm, 60 * mm, 150 * mm);
  block("upper right", 60 * mm, 1, 60 * mm, 150 * mm);
  ObjectToRoute first = object("first", {1, 0, 0}), second = object("second", {1, 0, 0});
  second.options.from.at.y() = second.options.to.at.y() = 25 * mm;
  for (ObjectToRoute* o : {&first, &second}) {
    o->options.refine = false;
    o->options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.3, -0.2, -0.2), Vec3(0.3, 0.2, 0.2));
  }
  second.options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.3, -0.2, -0.2), Vec3(0.3, 0.2, 55 * mm));  // it cannot use the upper one
  first.options.weights = {{1, 0}, {1, 30}};
  first.options.space.preference_range = 0.1;
  const ObjectsResult result = run_in_order(scene, {first, second});
  INFO(result.message);
  REQUIRE(result.ok);
  CHECK(result.objects[0].chosen == 1);
  CHECK(result.steps[1].counts[0].second == 2);  // attempts
  double highest = 0;
  for (const Vec3& p : result.objects[0].result.routes[1].nominal.curve().sampled(2 * mm)) highest = std::max(highest, p.z());
  CHECK(highest > 60 * mm);

  first.options.weights = {{1, 0}};
  const ObjectsResult stuck = run_in_order(scene, {first, second});
  CHECK_FALSE(stuck.ok);
  CHECK(stuck.status == Status::infeasible);
  CHECK_THAT(stuck.message, Catch::Contains("'second'") && Catch::Contains("another order"));
  CHECK(stuck.objects.size() == 2);
}

TEST_CASE("objects in order: the surface of a design holds the true one, and hardly more", "[route]") {
  ObjectToRoute one = object("one", {1, 0, 0});
  one.options.from = Frame::looking({0, 0, 0}, {1, 0, 0});
  one.options.to = Frame::looking({0.2, 0.15, 0.05}, {0, 1, 0});
  for (const bool settled : {false, true}) {
    one.options.refine = settled;
    const Result result = run(Scene(settled ? Vec3(0, 0, -9.81) : Vec3(0, 0, 0)), one.options);
    REQUIRE(result.ok);
    const Route& route = result.routes[0];
    const TriangleSurface surface(surface_of(route, 10 * mm));
    const double length = settled ? route.refined.equilibrium->rods[0].equilibrium.s.back() : route.nominal_length;
    double least = 1e9, most = 0;
    for (int i = 50; i <= 950; ++i) {
      const double s = length * i / 1000.0;
      const Vec3 at = settled ? route.refined.equilibrium->rods[0].equilibrium.frame_at(s).at : route.nominal.curve().at(s).at;
      const double distance = surface.tree().closest(at).distance;
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
    CHECK(least >= 5 * mm);
    CHECK(most <= 5.05 * mm);
  }
}

TEST_CASE("objects in order: what makes no sense, and being stopped", "[route]") {
  Scene scene;
  scene.add(solid("wall", Box{{1, 1, 1}}, {{5, 0, 0}, Quat::Identity()}));
  CHECK_THROWS_WITH(run_in_order(scene, {}), Catch::Contains("no objects"));
  CHECK_THROWS_WITH(run_in_order(scene, {object("", {1, 0, 0})}), Catch::Contains("needs a name"));
  CHECK_THROWS_WITH(run_in_order(scene, {object("wall", {1, 0, 0})}), Catch::Contains("already something named 'wall'"));
  CHECK_THROWS_WITH(run_in_order(scene, {object("a", {1, 0, 0}), object("a", {0, 1, 0})}), Catch::Contains("named 'a'"));
  ObjectToRoute far = object("far", {1, 0, 0});
  far.apart = NAN;
  CHECK_THROWS_WITH(run_in_order(scene, {far}), Catch::Contains("apart"));
  RunContext context;
  context.deadline = RunContext::Clock::now();
  const ObjectsResult late = run_in_order(scene, {object("a", {1, 0, 0}), object("b", {0, 1, 0})}, context);
  CHECK_FALSE(late.ok);
  CHECK(late.status == Status::timeout);
}

TEST_CASE("the front: no alternative is beaten in both length and clearance", "[route]") {
  const std::vector<Route> routes{alternative(1.2, 0.02), alternative(1.0, 0.01), alternative(1.1, 0.01),        // the third is longer for nothing
                                  alternative(1.2, 0.03), alternative(0.9, 0.05, false), alternative(1.0, 0.01)};  // one that keeps nothing; a twin
  CHECK(pareto_front(routes) == std::vector<int>{1, 3});
  CHECK(pareto_front({}).empty());
  CHECK(pareto_front({alternative(1, 0.1, false)}).empty());
}
