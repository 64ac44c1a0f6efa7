// What a harness is built to so that it keeps at rest what its route keeps: derivatives, known answers, clips.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/route/harness_clips.h"
#include "method/route/harness_model.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

namespace {

Section cable() { return Section::round(0.012, 0, Material::from_poisson(2e7, 0.4, 1500)); }

/// Connections in a plane z = 0, `out` from each other along x, two branches spread by `wide` along y.
HarnessOptions wye(double out, double wide) {
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(out, wide, 0), -Vec3::UnitX()),
                         Frame::looking(Vec3(out, -wide, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.03;
  options.end_straight = 0.01;
  options.bundling = 1;
  return options;
}

Scene over_floor(double depth) {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid_of("floor", Box{Vec3(4, 4, 2)}, Vec3(0, 0, -depth - 1)));
  return scene;
}

HarnessResult only_routed(const Scene& scene, HarnessOptions options) {
  options.equilibrium = false;
  HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  return r;
}

}  // namespace

TEST_CASE("slopes of a harness at rest are those of differences", "[harness]") {
  Scene scene = over_floor(0.03);
  scene.add(solid_of("post", Cylinder{0.03, 0.4}, Vec3(0.3, 0.1, 0)));
  HarnessOptions options = wye(0.6, 0.15);
  options.space.clearance = 0.005;
  options.space.clearance_weight = 0.5;
  options.space.preference_range = 0.15;
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.4), Vec3(1, 0.5, 0.4));
  const HarnessResult r = only_routed(scene, options);
  HarnessDesign design = design_as_routed(r);
  const bool clipped = GENERATE(false, true);
  if (clipped) {
    const Curve curve = r.branches[0].points.curve();
    design.clips = {{0, 0.4 * curve.length(), 0.4 * curve.length(), curve.at(0.4 * curve.length()), "post", 0}};
  }
  const HarnessSurroundings around(scene, r);
  const HarnessVariables variables(scene, r, design);
  CHECK(variables.size() == static_cast<int>(r.branches.size()) + 2 + (clipped ? 1 : 0));
  const RunContext context;
  HarnessModel model(around, r, variables, context);
  Eigen::VectorXd x = model.start();
  // Away from where it began, tilts and all.
  for (int v = 0; v < x.size(); ++v)
    x[v] += variables.variables()[v].kind == HarnessVariables::Variable::Kind::tilt ? 0.4 - 0.3 * (v % 2) : 0.3 + 0.1 * v;
  for (const Eigen::VectorXd& at : {model.start(), x}) {
    const bool found = model.evaluate(at).valid;
    INFO(model.candidate().equilibrium->message());
    REQUIRE(found);
    model.accept();
  }
  ConstrainedProblem::Linear linear;
  REQUIRE(model.linearise({}, linear));
  REQUIRE(linear.tags.size() > 5);
  constexpr double step = 1e-3;
  for (int v = 0; v < x.size(); ++v) {
    Eigen::VectorXd more = x, less = x;
    more[v] += step;
    less[v] -= step;
    const double cost_more = model.evaluate(more).cost;
    const Eigen::VectorXd up = model.slacks(linear.tags);
    const double cost_less = model.evaluate(less).cost;
    const Eigen::VectorXd down = model.slacks(linear.tags);
    CHECK(linear.cost[v] == Approx((cost_more - cost_less) / (2 * step)).epsilon(2e-3).margin(1e-6));
    for (std::size_t i = 0; i < linear.tags.size(); ++i) {
      INFO("variable " << v << ", constraint " << linear.tags[i].kind << " at " << linear.tags[i].place);
      CHECK(linear.slopes(static_cast<int>(i), v) == Approx((up[i] - down[i]) / (2 * step)).epsilon(5e-3).margin(2e-4));
    }
  }
}
