// Which curves stay, in which order, in which passages and under which labels.
#include <catch2/catch.hpp>

#include "method/preform/pcc_filtering.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::preform;
using namespace tendril::testing;

namespace {

Optimized optimized(std::vector<Vec3> vertices, double radius = 0.05) {
  Optimized curve;
  curve.points.points.push_back({-0.6, 0, 0});
  for (const Vec3& v : vertices) curve.points.points.push_back(v);
  curve.points.points.push_back({0.6, 0, 0});
  curve.points.radii.assign(vertices.size(), radius);
  curve.length = curve.objective = curve.points.length();
  return curve;
}

Optimized infeasible(Optimized curve) {
  curve.violations.emplace_back();
  return curve;
}

Options options_of(double radius, double clearance = 0) {
  Options options;
  options.ends = {{-0.6, 0, 0}, Vec3::UnitX(), {0.6, 0, 0}, Vec3::UnitX()};
  options.space.radius = radius;
  options.space.clearance = clearance;
  options.curve.radii = {0.05};
  return options;
}

FreeSpace space_of(const Scene& scene, const Options& options) {
  return FreeSpace(scene, options.space, {options.ends.start, options.ends.finish}, 0.2);
}

}  // namespace

TEST_CASE("curve distance: symmetric, zero for equal, and by hand") {
  const unsigned seed = GENERATE(range(1u, 9u));
  CAPTURE(seed);
  Random random(seed);
  const PccPoints a = random_pcc(random, 3, 0.05), b = random_pcc(random, 5, 0.05), c = random_pcc(random, 2, 0.05);
  CHECK(curve_distance(a, a) == 0);
  CHECK(curve_distance(a, b) == curve_distance(b, a));
  CHECK(curve_distance(a, c) <= curve_distance(a, b) + curve_distance(b, c) + 1e-15);
  PccPoints shifted = a;
  const Vec3 by = random.point(0.1);
  for (Vec3& p : shifted.points) p += by;
  CHECK(curve_distance(a, shifted) == Approx(by.norm()).epsilon(1e-9));
  // Straights of 1 m and 0.7 m from one place: farthest apart at their ends.
  CHECK(curve_distance({{{0, 0, 0}, {1, 0, 0}}, {}}, {{{0, 0, 0}, {0.7, 0, 0}}, {}}) == Approx(0.3));
}

TEST_CASE("distinct: the best of those that are the same, fewer bends beside it, none that is infeasible") {
  const Options options = options_of(0.01);
  const Optimized best = optimized({{-0.2, 0.2, 0}, {0.2, 0.2, 0}});
  const Optimized near = optimized({{-0.2, 0.21, 0}, {0.2, 0.21, 0}});
  const Optimized far = optimized({{-0.2, 0, 0.3}, {0.2, 0, 0.3}});
  const std::vector<Optimized> curves{far, infeasible(best), near, best, best};
  CHECK(distinct(curves, options) == std::vector<int>{3, 0});
  CHECK(distinct({}, options).empty());
  CHECK(distinct({infeasible(best)}, options).empty());

  // The same shape with a bend more, shorter by less than 1 %: both stay until the last optimum is known.
  Optimized more = best;
  more.points = optimized({{-0.4, 0.1, 0}, {-0.2, 0.2, 0}, {0.2, 0.2, 0}}).points;
  more.objective = best.objective * (1 - 5e-3);
  CHECK(distinct({best, more}, options) == std::vector<int>{1, 0});
  more.objective = best.objective * (1 - 2e-2);
  CHECK(distinct({best, more}, options) == std::vector<int>{1});
  more.objective = best.objective * 1.01;
  CHECK(distinct({best, more}, options) == std::vector<int>{0});
  more.objective = NAN;
  CHECK(distinct({best, more}, options) == std::vector<int>{0});
}

TEST_CASE("filtering: one hose of two that are equally good, that with fewer bends") {
  const Options options = options_of(0.01);
  const FreeSpace space = space_of(Scene(), options);
  const Optimized best = optimized({{-0.2, 0.2, 0}, {0.2, 0.2, 0}});
  Optimized more = optimized({{-0.4, 0.1, 0}, {-0.2, 0.2, 0}, {0.2, 0.2, 0}});
  more.objective = best.objective * (1 - 0.9e-4);
  auto hoses = pcc_filtering(space, options, {more, best});
  REQUIRE(hoses.size() == 1);
  CHECK(hoses[0].points.bends() == 2);
  CHECK(hoses[0].label == "shortest");
  CHECK(hoses[0].passage == 1);
  CHECK(hoses[0].clearance.obstacle == -1);
  CHECK(hoses[0].clearance_to.empty());
  more.objective = best.objective * (1 - 1.1e-4);
  hoses = pcc_filtering(space, options, {more, best});
  REQUIRE(hoses.size() == 1);
  CHECK(hoses[0].points.bends() == 3);
  CHECK(pcc_filtering(space, options, {}).empty());
}

TEST_CASE("filtering: passages, clearances and labels around a post and a beam") {
  Scene scene;
  scene.add(solid_of("post", Cylinder{0.05, 4}, Vec3(0, 0, 0)));
  PlacedObstacle beam = solid_of("beam", Box{Vec3(0.05, 4, 0.05)}, Vec3(0.3, 0, 0.2));
  beam.clearance = 0.01;
  scene.add(std::move(beam));
  const Options options = options_of(0.01, 0.005);
  const FreeSpace space = space_of(scene, options);
  const std::vector<Optimized> curves{
      optimized({{-0.3, -0.13, 0}, {0.3, -0.13, 0}}),                                  // 0: right of the post
      optimized({{-0.3, 0.1, 0}, {0.3, 0.1, 0}}),                                      // 1: left of it, the shortest
      infeasible(optimized({})),                                                       // 2: through the post
      optimized({{-0.3, 0.1, 0}, {0, 0.1, -0.2}, {0.3, 0.1, 0}}),                      // 3: left, lower
      optimized({{-0.3, 0.2, 0}, {0, 0.2, 0.2}, {0.3, 0.2, 0.29}, {0.45, 0.1, 0.2}}, 0.04),  // 4: left, over the beam
  };
  for (int threads : {1, 2, 5}) {
    RunContext context;
    context.threads = threads;
    const std::vector<Hose> hoses = pcc_filtering(space, options, curves, context);
    REQUIRE(hoses.size() == 4);
    CHECK(hoses[0].length == curves[1].length);
    CHECK(hoses[0].label == "shortest");
    CHECK(hoses[0].clearance_to == "post");
    CHECK(hoses[0].clearance.value == Approx(0.04).margin(1e-5));
    CHECK(hoses[1].label == "+" + std::to_string(std::lround(1e3 * (curves[0].length - curves[1].length))) +
                                " mm, other side of 'post'");
    CHECK(hoses[2].label.rfind("+", 0) == 0);
    CHECK(hoses[2].label.find(" mm, 3 bends, ") != std::string::npos);
    CHECK(hoses[2].label.find(" mm below hose 1 at (0.0") != std::string::npos);
    CHECK(hoses[3].label.find("4 bends, other side of 'beam'") != std::string::npos);
    CHECK(hoses[3].clearance_to == "beam");
    for (int i = 0; i < 4; ++i) CHECK(hoses[i].passage == std::vector<int>({1, 2, 1, 3})[i]);
  }
}

TEST_CASE("filtering: where there is one obstacle the label says how far and which way") {
  const Mesh block = test::box_mesh(Vec3(0.1, 0.1, 0.1), 3);
  Scene scene;
  scene.add(obstacle_of("bay", block));
  const Options options = options_of(0.01);
  const FreeSpace space = space_of(scene, options);
  const auto hoses = pcc_filtering(space, options,
                                   {optimized({{-0.3, 0.13, 0}, {0.3, 0.13, 0}}), optimized({{-0.3, -0.15, 0}, {0.3, -0.15, 0}}),
                                    optimized({{-0.3, 0, 0.17}, {0.3, 0, 0.17}})});
  REQUIRE(hoses.size() == 3);
  CHECK(hoses[0].clearance.value == Approx(0.02).margin(1e-5));
  CHECK(hoses[0].clearance_to == "bay");
  CHECK(hoses[1].label.find(" mm towards -y of hose 1 at (") != std::string::npos);
  CHECK(hoses[1].label.find(", -0.15, 0.00)") != std::string::npos);
  CHECK(hoses[2].label.find(" mm above hose 1 at (") != std::string::npos);
  // All around the block there is one way from any to any, but not by straights through it.
  CHECK(hoses[2].passage == 3);
}

TEST_CASE("filtering: 'best' where more than the length counts; a stopped search still ranks") {
  Scene scene;
  scene.add(solid_of("post", Cylinder{0.05, 4}, Vec3(0, 0, 0)));
  Options options = options_of(0.01);
  options.space.clearance_weight = 1;
  const FreeSpace space = space_of(scene, options);
  Optimized dear = optimized({{-0.3, 0.1, 0}, {0.3, 0.1, 0}}), cheap = optimized({{-0.3, -0.2, 0}, {0.3, -0.2, 0}});
  dear.objective = 3;
  RunContext context;
  const std::atomic<bool> cancel{true};
  context.cancel = &cancel;
  const auto hoses = pcc_filtering(space, options, {dear, cheap}, context);
  REQUIRE(hoses.size() == 2);
  CHECK(hoses[0].label == "best");
  CHECK(hoses[0].length > hoses[1].length);
  CHECK(hoses[1].label.rfind("-", 0) == 0);
  CHECK(hoses[1].passage == 2);
}
