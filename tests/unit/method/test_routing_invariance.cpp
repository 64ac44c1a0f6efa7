// A whole scene moved and turned: the nominal route costs the same, and preformed hoses are the same set.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "method/preform/preform.h"
#include "method/route/nominal_routing.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

struct Motion {
  Quat turn = Quat::Identity();
  Vec3 by = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const { return turn * p + by; }
  Ends operator()(const Ends& ends) const {
    return {(*this)(ends.start), turn * ends.start_along, (*this)(ends.finish), turn * ends.finish_along};
  }
};

/// A post, a block and a ball between two connections; solids and a mesh.
Scene scene_moved(const Motion& move) {
  Scene scene;
  const auto add = [&](const char* name, decltype(Obstacle::shape) shape, const Vec3& at, const Quat& turn) {
    PlacedObstacle obstacle;
    obstacle.name = name;
    obstacle.body.shape = std::move(shape);
    obstacle.body.pose = Frame{move(at), move.turn * turn};
    scene.add(obstacle);
  };
  add("post", Solid(Cylinder{0.04, 1.5}), {-0.08, 0.01, 0}, Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX())));
  add("block", std::make_shared<const TriangleSurface>(test::box_mesh(Vec3(0.05, 0.09, 0.12), 4)), {0.14, -0.05, 0.03}, Quat(Eigen::AngleAxisd(0.5, Vec3(1, 2, 0).normalized())));
  add("ball", Solid(Sphere{0.07}), {0.03, 0.17, -0.02}, Quat::Identity());
  return scene;
}

const Ends connections{{-0.35, -0.02, 0.01}, {1, 0, 0}, {0.36, 0.05, -0.04}, Vec3(1, 0.4, 0.1).normalized()};

SpaceDemands space_demands(double weight) {
  SpaceDemands demands;
  demands.radius = 0.01;
  demands.clearance = 0.008;
  demands.clearance_weight = weight;
  return demands;
}

PccDemands curve_demands() {
  PccDemands demands;
  demands.radii = {0.05};
  demands.min_straight = demands.end_straight = 0.015;
  return demands;
}

NominalRoute nominal(const Motion& move, double weight) {
  const double grid = 20e-3;
  NominalOptions options;
  options.ends = move(connections);
  options.curve = curve_demands();
  const Scene scene = scene_moved(move);
  const FreeSpace space(scene, space_demands(weight), {options.ends.start, options.ends.finish}, 0.15);
  return nominal_routing(space, Roadmap(space, grid), StateLattice(grid, 0.05, 0.5 * grid), options);
}

preform::Result hoses(const Motion& move) {
  preform::Options options;
  options.ends = move(connections);
  options.curve = curve_demands();
  options.space = space_demands(0);
  options.max_bends = 5;
  return preform::run(scene_moved(move), options);
}

std::vector<Motion> motions() {
  test::Random random(29);
  std::vector<Motion> all{{Quat::Identity(), Vec3(0.313, -2.071, 0.77)}, {Quat(Eigen::AngleAxisd(0.5 * units::pi, Vec3::UnitZ())), Vec3::Zero()}};
  for (int i = 0; i < 3; ++i) all.push_back({random.rotation(), random.point(1)});
  return all;
}

}  // namespace

TEST_CASE("a nominal route costs the same wherever the scene stands and however it is turned", "[invariance]") {
  for (const double weight : {0.0, 1.0}) {
    const NominalRoute still = nominal({}, weight);
    REQUIRE(still.status == NominalRoute::Status::found);
    int number = 0;
    for (const Motion& move : motions()) {
      const NominalRoute moved = nominal(move, weight);
      CAPTURE(weight, number++, still.points.bends(), moved.points.bends());
      REQUIRE(moved.status == NominalRoute::Status::found);
      CHECK(moved.objective == Approx(still.objective).epsilon(5e-4));
      CHECK(moved.length == Approx(still.length).epsilon(2e-3));
    }
  }
}

TEST_CASE("preformed hoses are the same set wherever the scene stands and however it is turned", "[invariance]") {
  // Those within a fifth of the best: beyond, it is for the grid to say which of many detours it finds.
  const auto good = [](const preform::Result& result) {
    std::vector<preform::Hose> hoses;
    for (const preform::Hose& hose : result.hoses)
      if (hose.objective <= 1.2 * result.hoses.front().objective) hoses.push_back(hose);
    return hoses;
  };
  const preform::Result first = hoses({});
  REQUIRE(first.ok);
  const std::vector<preform::Hose> still = good(first);
  REQUIRE(still.size() >= 5);
  int number = 0;
  for (const Motion& move : motions()) {
    const preform::Result result = hoses(move);
    CAPTURE(number++);
    REQUIRE(result.ok);
    const std::vector<preform::Hose> moved = good(result);
    REQUIRE(moved.size() == still.size());
    for (std::size_t i = 0; i < still.size(); ++i) {
      CAPTURE(i);
      CHECK(moved[i].length == Approx(still[i].length).epsilon(2e-4));
      CHECK(moved[i].clearance.value == Approx(still[i].clearance.value).margin(3e-5));
      CHECK(moved[i].points.bends() == still[i].points.bends());
      CHECK(moved[i].passage == still[i].passage);
    }
  }
}
