// Hoses checked again by nothing but their curve and the triangles: fine samples with brute-force distances.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/preform/preform.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::preform;
using namespace tendril::testing;

namespace {

/// Closed boxes and loose triangles between two places 0.8 m apart.
Mesh clutter(Random& random) {
  Mesh mesh = test::triangle_soup(25, 0.12, random);
  for (Vec3& v : mesh.vertices) v *= 0.35;
  for (int k = 0; k < 6; ++k) {
    const Mesh box = test::box_mesh(Vec3(random.in(0.02, 0.08), random.in(0.02, 0.08), random.in(0.02, 0.08)))
                         .moved(0.28 * random.point(1), random.rotation());
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (const auto& t : box.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

/// The smallest distance of places at most 0.2 mm apart.
double sampled_distance(const Mesh& mesh, const Curve& curve) {
  double least = 1e9;
  for (const Vec3& p : curve.sampled(2e-4)) least = std::min(least, brute_distance(mesh, p));
  return least;
}

}  // namespace

TEST_CASE("preform: every hose again by fine samples and all triangles") {
  const unsigned seed = GENERATE(range(1u, 7u));
  CAPTURE(seed);
  Random random(seed);
  const Mesh mesh = clutter(random);
  Scene scene;
  scene.add(obstacle_of("clutter", mesh));
  Options options;
  options.ends = {{-0.4, 0, 0}, Vec3::UnitX(), {0.4, 0.05, 0}, Vec3::UnitX()};
  options.space.radius = 0.01;
  options.space.clearance = 0.005;
  options.curve.radii = {0.04, 0.06};
  options.curve.min_straight = 0.01;
  options.curve.end_straight = 0.02;
  options.max_bends = 5;
  const double kept_clear = options.space.radius + options.space.clearance;

  const Result result = run(scene, options);
  INFO(result.message);
  REQUIRE(result.ok);
  for (const Hose& hose : result.hoses) {
    const PccPoints& p = hose.points;
    const Curve curve = p.curve();  // throws where arcs do not fit
    const double distance = sampled_distance(mesh, curve);
    CHECK(distance >= kept_clear - 1e-5);
    CHECK(hose.length == Approx(curve.length()).epsilon(1e-9));
    if (hose.clearance.obstacle >= 0) CHECK(distance - options.space.radius == Approx(hose.clearance.value).margin(1.1e-4));

    CHECK((p.points.front() - options.ends.start).norm() < 1e-9);
    CHECK((p.points.back() - options.ends.finish).norm() < 1e-9);
    CHECK((curve.at(0).d3() - options.ends.start_along).norm() < 1.1e-5);
    CHECK((curve.at(curve.length()).d3() - options.ends.finish_along).norm() < 1.1e-5);
    CHECK(p.bends() <= options.max_bends);
    for (const double radius : p.radii)
      CHECK(std::min(std::abs(radius - 0.04), std::abs(radius - 0.06)) <= 1e-5);
    // Straights, from the curve's own breaks: they alternate with bends.
    std::vector<double> breaks{0};
    breaks.insert(breaks.end(), curve.breaks().begin(), curve.breaks().end());
    breaks.push_back(curve.length());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const bool straight = std::isinf(curve.bend_radius(0.5 * (breaks[i] + breaks[i + 1])));
      const bool at_end = i == 0 || i + 2 == breaks.size();
      if (straight) CHECK(breaks[i + 1] - breaks[i] >= (at_end ? 0.02 : 0.01) - 1.1e-5);
      else CHECK(!at_end);
    }
  }
}
