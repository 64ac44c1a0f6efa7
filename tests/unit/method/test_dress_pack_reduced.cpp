// Optimised paths for dress packs: derivatives, the trust region, limits, and a best path that is known from a scan.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/dress_pack/reduced.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;
using Catch::Matchers::Contains;

namespace {

PackDemands all_demands() {
  PackDemands demands;
  demands.force = {20, 10};
  demands.twist = {1, 0.5};
  demands.curvature = {4, 1};
  return demands;
}

/// The arm unfolds sideways; straight in the joints it pulls the hose taut on the way.
JointPath planar_path(int via) {
  return JointPath({degrees({10, 60}), degrees({60, -60})}).resampled(via);
}

double objective_of(const PackProblem& pack, const JointPath& path, int steps, const PackDemands& demands, const PathWeights& weights) {
  ReducedProblem problem(pack, path, steps, demands, weights);
  const PackFollower::Outcome way = problem.start({});
  return way.ok() && way.snaps.empty() ? problem.objective() : INFINITY;
}

Eigen::VectorXd random_vector(int size, Random& random) { return test::random_values(size, 1, random); }

}  // namespace

TEST_CASE("soft excess: nothing below the limit, a straight line above, its own slope", "[dress_pack]") {
  const Demand demand{10, 2};
  CHECK(soft_excess(0, demand).value < 1e-10);
  CHECK(soft_excess(30, demand).value == Approx(10));
  CHECK(soft_excess(30, demand).slope == Approx(0.5));
  CHECK(soft_excess(1e9, demand).value == Approx(0.5 * (1e9 - 10)));
  CHECK(soft_excess(1e9, Demand{}).value == 0);
  for (double v = 6; v < 16; v += 0.37) {
    const double e = 1e-6, slope = (soft_excess(v + e, demand).value - soft_excess(v - e, demand).value) / (2 * e);
    CHECK(soft_excess(v, demand).slope == Approx(slope).epsilon(1e-6).margin(1e-9));
  }
}

TEST_CASE("trust step: Newton's step where it may be made, the edge where not", "[dress_pack]") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 1 + random.below(8);
    Eigen::MatrixXd root(n, n);
    for (int k = 0; k < n; ++k) root.col(k) = random_vector(n, random);
    const Eigen::MatrixXd convex = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n), saddle = root + root.transpose();
    const Eigen::VectorXd g = random_vector(n, random), x = Eigen::VectorXd::Zero(n);
    const LinearLimits none{Eigen::MatrixXd(0, n), Eigen::VectorXd(0)};
    const TrustStep newton = trust_step(g, convex, none, x, 1e6);
    CHECK((convex * newton.step + g).norm() < 1e-9);
    CHECK(!newton.at_edge);
    CHECK(newton.reduction == Approx(-0.5 * g.dot(newton.step)));
    for (const Eigen::MatrixXd& h : {convex, saddle}) {
      const TrustStep cut = trust_step(g, h, none, x, 1e-3);
      CHECK(cut.step.norm() == Approx(1e-3).epsilon(1e-4));
      CHECK(cut.at_edge);
      // So short a step is downhill by its slope alone.
      CHECK(cut.reduction > 0);
      CHECK(trust_step(g, h, none, x, 2).reduction > 0);
    }
  }
}

TEST_CASE("trust step: the least of a convex model within bounds, to the conditions of optimality", "[dress_pack]") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int n = 2 + random.below(6);
    Eigen::MatrixXd root(n, n);
    for (int k = 0; k < n; ++k) root.col(k) = random_vector(n, random);
    const Eigen::MatrixXd h = root * root.transpose() + 0.2 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd g = 4 * random_vector(n, random);
    LinearLimits box{Eigen::MatrixXd(2 * n, n), Eigen::VectorXd::Constant(2 * n, 0.5)};
    box.rows << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    double before = INFINITY;
    for (int round = 0; round < 30; ++round) {
      x += trust_step(g + h * x, h, box, x, 10).step;
      CHECK(x.cwiseAbs().maxCoeff() <= 0.5 + 1e-12);
      const double value = g.dot(x) + 0.5 * x.dot(h * x);
      CHECK(value <= before + 1e-12);
      before = value;
    }
    const Eigen::VectorXd slope = g + h * x;
    for (int k = 0; k < n; ++k) {
      if (x[k] < 0.5 - 1e-9) CHECK(slope[k] > -1e-7);
      if (x[k] > -0.5 + 1e-9) CHECK(slope[k] < 1e-7);
    }
  }
}

TEST_CASE("reduced problem: gradient and second derivative against finite differences", "[dress_pack]") {
  PathWeights weights;
  weights.joints = {1, 2, 1, 0.5, 1, 0};
  for (const int via : {4, 8}) {
    CAPTURE(via);
    const PackProblem pack = six_axis_pack();
    ReducedProblem problem(pack, problematic_path(via), 20, all_demands(), weights);
    REQUIRE(problem.start({}).ok());
    Eigen::VectorXd gradient, alone;
    Eigen::MatrixXd hessian;
    REQUIRE(problem.derivatives(gradient, hessian, {}));
    REQUIRE(problem.gradient(alone));
    CHECK((gradient - alone).norm() < 1e-12 * gradient.norm());
    const Eigen::VectorXd u = problem.values();
    const double e = 1e-4;
    for (int i = 0; i < u.size(); ++i) {
      const Eigen::VectorXd by = e * Eigen::VectorXd::Unit(u.size(), i);
      const double slope = (problem.try_values(u + by, {}).objective - problem.try_values(u - by, {}).objective) / (2 * e);
      CHECK(gradient[i] == Approx(slope).epsilon(1e-5).margin(1e-6 * gradient.norm()));
    }
    CHECK((hessian - hessian.transpose()).norm() < 1e-12 * hessian.norm());
    for (int i = 0; i < u.size(); i += 7) {
      const Eigen::VectorXd by = e * Eigen::VectorXd::Unit(u.size(), i);
      Eigen::VectorXd ahead, behind;
      REQUIRE(problem.try_values(u + by, {}).ok());
      problem.accept();
      REQUIRE(problem.gradient(ahead));
      REQUIRE(problem.try_values(u - by, {}).ok());
      problem.accept();
      REQUIRE(problem.gradient(behind));
      REQUIRE(problem.try_values(u, {}).ok());
      problem.accept();
      CHECK(((ahead - behind) / (2 * e) - hessian.col(i)).norm() < 1e-2 * hessian.col(i).norm());
    }
  }
}

TEST_CASE("reduced problem: the objective of moved states is that of a path followed anew", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  ReducedProblem problem(pack, problematic_path(5), 20, all_demands(), {});
  REQUIRE(problem.start({}).ok());
  Random random(3);
  for (int trial = 0; trial < 4; ++trial) {
    const Eigen::VectorXd u = problem.values() + 0.3 * random_vector(problem.variables(), random);
    const ReducedProblem::Trial moved = problem.try_values(u, {});
    REQUIRE(moved.ok());
    CHECK(moved.objective == Approx(objective_of(pack, problem.path_with(u), 20, all_demands(), {})).epsilon(1e-7));
  }
}

TEST_CASE("optimised path: of a two-link arm, the best of a fine scan", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  ReducedOptions options;
  options.steps = 12;
  options.demands.force = {20, 20};
  options.weights.effort = 0.2;
  const JointPath path = planar_path(3);
  const ReducedResult found = optimise(pack, path, options);
  REQUIRE(found.ok());
  CHECK(found.objective < 0.9 * found.objective_before);
  // The only free via point on a grid that is made finer around its best place.
  JointVector best = path.via()[1];
  double least = INFINITY, spacing = 0.3;
  for (int round = 0; round < 3; ++round, spacing *= 0.2) {
    const JointVector centre = best;
    for (int a = -8; a <= 8; ++a)
      for (int b = -8; b <= 8; ++b) {
        const JointVector at = centre + spacing * Eigen::Vector2d(a, b);
        if (std::abs(at[0]) > units::pi || std::abs(at[1]) > units::pi) continue;
        const double f = objective_of(pack, JointPath({path.via()[0], at, path.via()[2]}), options.steps, options.demands, options.weights);
        if (f < least) least = f, best = at;
      }
  }
  CHECK(found.objective <= least + 1e-9);
  CHECK(found.objective >= least * 0.999);
  CHECK((found.path.via()[1] - best).norm() < 0.02);
}

TEST_CASE("optimised path: limits hold at every iterate, and the ends stay", "[dress_pack]") {
  PackProblem pack = planar_pack(12);
  std::vector<Joint> joints = pack.robot->joints();
  joints[1].upper = 65 * units::deg;   // less than the best path wants
  joints[0].velocity = joints[1].velocity = 1.1;
  pack.robot = std::make_shared<const Robot>("limited", pack.robot->links(), joints);
  const JointPath path = planar_path(6);
  ReducedOptions options;
  options.steps = 15;
  options.seconds = 2.2;
  options.demands.force = {5, 5};
  options.weights.effort = 0.001;
  double before = INFINITY;
  bool meets_limit = false;
  for (int most = 1; most <= 12; ++most) {
    options.most_iterations = most;
    const ReducedResult found = optimise(pack, path, options);
    CAPTURE(most, found.message);
    CHECK(beyond_robot(found.path, *pack.robot, options.seconds) == "");
    CHECK(found.path.via().front() == path.via().front());
    CHECK(found.path.via().back() == path.via().back());
    CHECK(found.objective <= found.objective_before);
    CHECK(found.objective <= before + 1e-12);
    before = found.objective;
    meets_limit |= found.path.largest_speeds(2.2).maxCoeff() > 1.1 * (1 - 1e-6);
  }
  CHECK(meets_limit);
}

TEST_CASE("optimised path: of a six-axis robot", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  ReducedOptions options;
  options.demands = all_demands();
  const ReducedResult found = optimise(pack, problematic_path(), options);
  REQUIRE(found.ok());
  CHECK(found.message == "solved");
  CHECK(found.objective < found.objective_before);
  CHECK(found.path.points() == 8);
  REQUIRE(found.after.steps.size() == 41);
  for (const PackStep& step : found.after.steps) CHECK(step.residual < 1e-5);
  double last = found.objective_before;
  for (const ReducedIteration& one : found.history) {
    CHECK(one.objective <= last);
    last = one.objective;
  }
  // Twice and five times the time steps judge the same path alike.
  for (const int steps : {80, 200})
    CHECK(objective_of(pack, found.path, steps, options.demands, options.weights) == Approx(found.objective).epsilon(0.005));
  // No direction leads on: the gradient is zero but for what the tolerance leaves.
  ReducedProblem problem(pack, found.path, options.steps, options.demands, options.weights);
  REQUIRE(problem.start({}).ok());
  Eigen::VectorXd gradient;
  REQUIRE(problem.gradient(gradient));
  CHECK(gradient.norm() < 1e-3);
  // The same bits again.
  const ReducedResult again = optimise(pack, problematic_path(), options);
  CHECK(again.objective == found.objective);
  for (int k = 0; k < 8; ++k) CHECK(again.path.via()[k] == found.path.via()[k]);
}

TEST_CASE("optimised path: a path without free via points is left as it is", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  for (const int via : {2, 0}) {
    ReducedOptions options;
    options.via = via;
    const ReducedResult found = optimise(pack, planar_path(2), options);
    REQUIRE(found.ok());
    CHECK(found.objective == found.objective_before);
    CHECK(found.iterations == 0);
  }
}

TEST_CASE("optimised path: what cannot begin is refused with the reason", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  const ReducedResult beyond = optimise(pack, JointPath({degrees({0, 60}), degrees({0, 200})}));
  CHECK(beyond.status == Status::infeasible);
  CHECK_THAT(beyond.message, Contains("via point 1") && Contains("joint_2"));
  std::vector<Joint> joints = pack.robot->joints();
  joints[1].velocity = 0.1;
  PackProblem slow = pack;
  slow.robot = std::make_shared<const Robot>("slow", pack.robot->links(), joints);
  ReducedOptions options;
  options.seconds = 2;
  const ReducedResult fast = optimise(slow, planar_path(4), options);
  CHECK(fast.status == Status::infeasible);
  CHECK_THAT(fast.message, Contains("joint_2 moves at") && Contains("at most 0.1"));
  // A hose much too short for the arm is torn, not stretched: its segments are too long for that tension.
  PackProblem torn = planar_pack(12);
  torn.rods[0] = hose(0.3, 12);
  const ReducedResult taut = optimise(torn, planar_path(4));
  CHECK(taut.status == Status::infeasible);
  CHECK_THAT(taut.message, Contains("the rods cannot follow the path") && Contains("no equilibrium"));
}

TEST_CASE("optimised path: interrupted, the best so far is kept", "[dress_pack]") {
  const PackProblem pack = six_axis_pack();
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  ReducedOptions options;
  options.demands = all_demands();
  int calls = 0;
  context.progress = [&](double, const char* what) {
    if (std::string(what) == "optimisation" && ++calls == 2) cancel = true;
  };
  const ReducedResult found = optimise(pack, problematic_path(), options, context);
  CHECK(found.status == Status::cancelled);
  CHECK_THAT(found.message, Contains("best path so far"));
  CHECK(found.iterations == 2);
  CHECK(found.objective < found.objective_before);
  CHECK(objective_of(pack, found.path, options.steps, options.demands, options.weights) == Approx(found.objective).epsilon(1e-6));
  cancel = true;
  CHECK(optimise(pack, problematic_path(), options, context).status == Status::cancelled);
}

TEST_CASE("optimised path: options that make no sense are refused", "[dress_pack]") {
  const PackProblem pack = planar_pack(12);
  auto refuses = [&](auto change, const char* says) {
    ReducedOptions options;
    change(options);
    CHECK_THROWS_WITH(optimise(pack, planar_path(4), options), Contains(says));
  };
  refuses([](ReducedOptions& o) { o.steps = 0; }, "0 time steps");
  refuses([](ReducedOptions& o) { o.via = 1; }, "1 via points, expected at least 2");
  refuses([](ReducedOptions& o) { o.seconds = -1; }, "the path takes -1 s");
  refuses([](ReducedOptions& o) { o.weights.effort = NAN; }, "the weight of the path is nan");
  refuses([](ReducedOptions& o) { o.weights.joints = {1, 2, 3}; }, "3 weights for 2 joints");
  refuses([](ReducedOptions& o) { o.weights.joints = {1, -2}; }, "the weight of a joint is -2");
  refuses([](ReducedOptions& o) { o.demands.force.limit = -1; }, "the limit of force is -1 N");
  refuses([](ReducedOptions& o) { o.demands.twist = {1, 0}; }, "the scale of twist is 0 rad/m");
  refuses([](ReducedOptions& o) { o.demands.curvature.limit = NAN; }, "the limit of curvature is nan 1/m");
  refuses([](ReducedOptions& o) { o.tolerance = 0; }, "tolerance and radius must be positive");
}
