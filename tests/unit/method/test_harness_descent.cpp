// What junctions are moved by: derivatives of a branch's cost by its ends, and of ends that may have any direction.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/pcc/pcc_terms.h"
#include "method/route/harness_descent.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

TEST_CASE("derivatives of a curve's cost by its ends", "[harness]") {
  Scene scene;
  scene.add(solid_of("ball", Sphere{0.06}, Vec3(0.05, 0, 0)));
  scene.add(solid_of("box", Box{Vec3(0.1, 0.1, 0.1)}, Vec3(-0.2, 0.1, 0)));
  SpaceDemands space_demands;
  space_demands.radius = 0.01;
  const FreeSpace space(scene, space_demands, {Vec3::Constant(-1), Vec3::Constant(1)}, 0.1);
  Random random(5);
  for (int run = 0; run < 40; ++run) {
    INFO("run " << run);
    const int bends = 2 + run % 3;
    const PccPoints curve = random_pcc(random, bends, 0.03, 1.5);
    Ends ends = ends_of(curve);
    PccDemands demands;
    demands.radii = {0.03};
    demands.end_straight = 0.08;  // mostly missed: its penalty counts
    demands.start_cone = run % 4 / 2 ? units::pi : 0;
    demands.finish_cone = run % 2 ? units::pi : 0;
    PccUnknowns unknowns(demands, ends, curve.radii);
    CHECK(unknowns.size() == 3 * bends - (run % 4 / 2 ? 0 : 2) - (run % 2 ? 0 : 2));
    PccTerms terms(space, demands, unknowns, 0.02);
    terms.weight = 3;
    const Eigen::VectorXd x = unknowns.nearest(curve);
    terms.plan(x, 0.0213);
    PccShape shape;
    unknowns.evaluate(x, shape);
    for (int i = 0; i < bends + 2; ++i) CHECK((shape.points[i] - curve.points[i]).norm() < 1e-12);
    Eigen::VectorXd gradient, unused;
    terms(x, gradient);
    const Ends by = terms.by_ends(x);
    constexpr double step = 1e-7;
    for (int i = 0; i < x.size(); ++i) {
      Eigen::VectorXd more = x, less = x;
      more[i] += step;
      less[i] -= step;
      const double up = terms(more, unused), down = terms(less, unused);
      CHECK(gradient[i] == Approx((up - down) / (2 * step)).epsilon(1e-5).margin(1e-5));
    }
    const auto with = [&](const Ends& moved) {
      unknowns.move(moved);
      return terms(x, unused);
    };
    for (int k = 0; k < 3; ++k) {
      const Vec3 move = step * Vec3::Unit(k);
      Ends more = ends, less = ends;
      more.start += move;
      less.start -= move;
      const double by_start = (with(more) - with(less)) / (2 * step);
      more = less = ends;
      more.finish += move;
      less.finish -= move;
      const double by_finish = (with(more) - with(less)) / (2 * step);
      // Directions stay unit vectors: only what is normal to them shows.
      more = less = ends;
      more.start_along = (ends.start_along + move).normalized();
      less.start_along = (ends.start_along - move).normalized();
      const double by_start_along = (with(more) - with(less)) / (2 * step);
      more = less = ends;
      more.finish_along = (ends.finish_along + move).normalized();
      less.finish_along = (ends.finish_along - move).normalized();
      const double by_finish_along = (with(more) - with(less)) / (2 * step);
      const auto normal = [](const Vec3& v, const Vec3& along) -> Vec3 { return v - along.dot(v) * along; };
      CHECK(by.start[k] == Approx(by_start).epsilon(1e-5).margin(1e-5));
      CHECK(by.finish[k] == Approx(by_finish).epsilon(1e-5).margin(1e-5));
      CHECK(normal(by.start_along, ends.start_along)[k] == Approx(by_start_along).epsilon(1e-5).margin(1e-5));
      CHECK(normal(by.finish_along, ends.finish_along)[k] == Approx(by_finish_along).epsilon(1e-5).margin(1e-5));
    }
  }
}

TEST_CASE("a junction goes to where its branches cost least, from wherever it starts", "[harness]") {
  // The trunk from 120 to 240 degrees bends about the junction, the third branch is straight. With the bends' vertices l = straight +
  // R tan(15 degrees) beside the junction, the cost is stationary at x = -(0.15 - (0.3 sin 60 - l) / sqrt(3)).
  HarnessOptions options;
  for (const double angle : {0.0, 120.0, 240.0}) {
    const Vec3 out(std::cos(angle * units::deg), std::sin(angle * units::deg), 0);
    options.connections.push_back(Frame::looking(0.3 * out, -out));
  }
  options.section = Section::round(0.012, 0, Material::from_poisson(2e7, 0.4, 1500));
  options.space.radius = 0.006;
  options.min_bend_radius = 0.03;
  options.end_straight = 0.01;
  options.bundling = 1;
  const FreeSpace space(Scene(), options.space, {options.connections[0].at, options.connections[1].at, options.connections[2].at}, 0.2);
  const double beside = 0.01 + 0.03 * std::tan(15 * units::deg);
  const double x = -(0.15 - (0.3 * std::sin(60 * units::deg) - beside) / std::sqrt(3.0));
  for (const Vec3& start : {Vec3(-0.03, 0, 0), Vec3(0, 0, 0), Vec3(0.02, 0, 0), Vec3(0.01, 0.02, 0.01)}) {
    HarnessShape shape;
    shape.junctions = {{start, {1, 2, 0}, {Vec3::UnitY(), -Vec3::UnitY(), Vec3::UnitX()}}};
    for (int c = 0; c < 3; ++c) {
      ShapeBranch branch{{true, 0}, {false, c}, {c}, 1, {}, {}};
      branch.points = {{start, options.connections[c].at}, {}};
      shape.branches.push_back(branch);
    }
    const HarnessShape best = descend_together(space, options, shape);
    INFO("from " << start.transpose() << " to " << best.junctions[0].at.transpose());
    CHECK((best.junctions[0].at - Vec3(x, 0, 0)).norm() < 2e-3);
    CHECK(std::abs(best.junctions[0].leaving[0].dot(Vec3::UnitY())) > 1 - 1e-4);
    CHECK(best.cost() == Approx(0.9044).epsilon(1e-3));
  }
}
