// The direct formulation: its derivatives, and that it finds what the reduced one finds.
#include <catch2/catch.hpp>

#include <thread>

#include "base/error.h"
#include "method/dress_pack/direct.h"
#include "method/dress_pack/direct_problem.h"
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

JointPath planar_path(int via) { return JointPath({degrees({10, 60}), degrees({60, -60})}).resampled(via); }

JointPath easy_path(int via) {
  return JointPath({degrees({0, 0, 0, 0, 30, 0}), degrees({20, 10, 10, 20, 20, 20})}).resampled(via);
}

ReducedOptions planar_options() {
  ReducedOptions options;
  options.steps = 12;
  options.demands.force = {20, 20};
  options.weights.effort = 0.2;
  return options;
}

Eigen::MatrixXd dense(DirectProblem& problem, const Eigen::VectorXd& x) {
  Eigen::VectorXd values(problem.jacobian_entries.size());
  REQUIRE(problem.jacobian(x, values));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(problem.rows(), problem.variables());
  for (std::size_t k = 0; k < problem.jacobian_entries.size(); ++k)
    out(problem.jacobian_entries[k].row, problem.jacobian_entries[k].column) += values[k];
  return out;
}

Eigen::MatrixXd dense_hessian(DirectProblem& problem, const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd values(problem.hessian_entries.size());
  REQUIRE(problem.hessian(x, factor, multipliers, values));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(problem.variables(), problem.variables());
  for (std::size_t k = 0; k < problem.hessian_entries.size(); ++k) {
    const NonlinearProgram::Entry& e = problem.hessian_entries[k];
    REQUIRE(e.row >= e.column);
    out(e.row, e.column) += values[k];
    if (e.row != e.column) out(e.column, e.row) += values[k];
  }
  return out;
}

/// Least x + y on the circle of radius sqrt(2): -2 at (-1, -1).
struct Circle : NonlinearProgram {
  bool throws = false;
  Circle() {
    start = Eigen::Vector2d(-2, 0.5);
    lower = Eigen::Vector2d::Constant(-INFINITY);
    upper = Eigen::Vector2d::Constant(INFINITY);
    row_lower = row_upper = Eigen::VectorXd::Constant(1, 2);
    jacobian_entries = {{0, 0}, {0, 1}};
    hessian_entries = {{0, 0}, {1, 1}};
  }
  bool value(In x, double& f) override {
    if (throws) throw UsageError("circle: broken");
    f = x.sum();
    return true;
  }
  bool slope(In, Out g) override {
    g.setOnes();
    return true;
  }
  bool constraints(In x, Out c) override {
    c[0] = x.squaredNorm();
    return true;
  }
  bool jacobian(In x, Out entries) override {
    entries = 2 * x;
    return true;
  }
  bool hessian(In, double, In multipliers, Out entries) override {
    entries.setConstant(2 * multipliers[0]);
    return true;
  }
};

}  // namespace

TEST_CASE("non-linear program: solved, limited, stopped, and what it throws", "[dress_pack]") {
  Circle circle;
  const NonlinearOutcome found = solve_nonlinear(circle, {}, {});
  REQUIRE(found.status == Status::solved);
  CHECK(found.value == Approx(-2));
  CHECK((found.x - Eigen::Vector2d(-1, -1)).norm() < 1e-6);
  CHECK(found.violation < 1e-7);
  NonlinearOptions once;
  once.most_iterations = 1;
  const NonlinearOutcome cut = solve_nonlinear(circle, once, {});
  CHECK(cut.status == Status::stalled);
  CHECK(cut.message == "out of iterations");
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(solve_nonlinear(circle, {}, context).status == Status::cancelled);
  RunContext late;
  late.deadline = RunContext::Clock::now();
  CHECK(solve_nonlinear(circle, {}, late).status == Status::timeout);
  circle.lower = Eigen::Vector2d(2, 2);
  circle.start = Eigen::Vector2d(3, 3);
  const NonlinearOutcome apart = solve_nonlinear(circle, {}, {});
  CHECK(apart.status == Status::infeasible);
  CHECK(apart.violation > 1);
  circle.throws = true;
  CHECK_THROWS_WITH(solve_nonlinear(circle, {}, {}), "circle: broken");
}

TEST_CASE("direct program: it begins at the reduced problem's objective with all equations satisfied", "[dress_pack]") {
  const PackProblem pack = six_axis_pack(8);
  ReducedProblem start(pack, problematic_path(5), 12, all_demands(), {});
  REQUIRE(start.start({}).ok());
  DirectProblem problem(pack, start, 12, all_demands(), {}, 0);
  double f = 0;
  REQUIRE(problem.value(problem.start, f));
  CHECK(f == Approx(start.objective()).epsilon(1e-12));
  Eigen::VectorXd c(problem.rows());
  REQUIRE(problem.constraints(problem.start, c));
  CHECK(problem.violation(problem.start, c) < 1e-6);
  // 6 numbers for each of the 9 nodes and 8 segments, and two forces, at the 11 steps that move; as many equations.
  CHECK(problem.variables() == 3 * 6 + 11 * (6 * 17 + 6));
  CHECK(problem.rows() == 11 * (6 * 17 + 6));
}

TEST_CASE("direct program: first and second derivatives against finite differences", "[dress_pack]") {
  PathWeights weights;
  weights.joints = {1, 2, 1, 0.5, 1, 0};
  PackProblem pack = six_axis_pack(4);
  std::vector<Joint> joints = pack.robot->joints();
  for (Joint& joint : joints) joint.velocity = 2;
  pack.robot = std::make_shared<const Robot>("limited", pack.robot->links(), joints);
  ReducedProblem start(pack, problematic_path(4), 6, all_demands(), weights);
  REQUIRE(start.start({}).ok());
  DirectProblem problem(pack, start, 6, all_demands(), weights, 4);
  const unsigned seed = 3;
  CAPTURE(seed);
  Random random(seed);
  Eigen::VectorXd x = problem.start, multipliers(problem.rows());
  for (double& v : x) v += 0.02 * random.in(-1, 1);
  for (double& v : multipliers) v = random.in(-1, 1);
  const double factor = 0.7, e = 1e-5;
  Eigen::VectorXd slope(x.size()), ahead(x.size()), behind(x.size()), c(problem.rows()), d(problem.rows());
  REQUIRE(problem.slope(x, slope));
  const Eigen::MatrixXd first = dense(problem, x), second = dense_hessian(problem, x, factor, multipliers);
  for (int j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd by = e * Eigen::VectorXd::Unit(x.size(), j);
    double more = 0, less = 0;
    REQUIRE((problem.value(x + by, more) && problem.value(x - by, less)));
    CHECK(slope[j] == Approx((more - less) / (2 * e)).epsilon(1e-6).margin(1e-8));
    REQUIRE((problem.constraints(x + by, c) && problem.constraints(x - by, d)));
    CHECK(((c - d) / (2 * e) - first.col(j)).norm() < 1e-8 * (1 + first.col(j).norm()));
    REQUIRE((problem.slope(x + by, ahead) && problem.slope(x - by, behind)));
    const Eigen::VectorXd rate = (factor * (ahead - behind) + (dense(problem, x + by) - dense(problem, x - by)).transpose() * multipliers) / (2 * e);
    CHECK((rate - second.col(j)).norm() < 1e-6 * (1 + second.col(j).norm()));
  }
}

TEST_CASE("direct path: what the reduced formulation finds, on a planar arm and a six-axis robot", "[dress_pack]") {
  struct Case {
    PackProblem pack;
    JointPath path;
    ReducedOptions options;
  };
  ReducedOptions six;
  six.steps = 16;
  six.demands = all_demands();
  for (const Case& one : {Case{planar_pack(12), planar_path(3), planar_options()}, Case{planar_pack(12), planar_path(5), planar_options()},
                          Case{six_axis_pack(10), easy_path(4), six}}) {
    const ReducedResult reduced = optimise(one.pack, one.path, one.options);
    const DirectResult direct = optimise_direct(one.pack, one.path, one.options);
    CAPTURE(direct.message);
    REQUIRE(reduced.ok());
    REQUIRE(direct.ok());
    CHECK(direct.objective_before == reduced.objective_before);
    CHECK(direct.objective == Approx(reduced.objective).epsilon(1e-6));
    CHECK(direct.objective < 0.95 * direct.objective_before);
    for (int k = 0; k < direct.path.points(); ++k) CHECK((direct.path.via()[k] - reduced.path.via()[k]).norm() < 0.01);
    CHECK(direct.violation < 1e-6);
    CHECK(direct.after.ok());
    double last = direct.objective_before;
    for (const ReducedIteration& round : direct.history) {
      CHECK(round.objective <= last);
      last = round.objective;
    }
  }
}

TEST_CASE("direct path: joint and speed limits hold, and the ends stay", "[dress_pack]") {
  PackProblem pack = planar_pack(8);
  std::vector<Joint> joints = pack.robot->joints();
  joints[1].upper = 65 * units::deg;
  joints[0].velocity = joints[1].velocity = 1.1;
  pack.robot = std::make_shared<const Robot>("limited", pack.robot->links(), joints);
  ReducedOptions options = planar_options();
  options.seconds = 2.2;
  options.demands.force = {5, 5};
  options.weights.effort = 0.001;
  const JointPath path = planar_path(5);
  const ReducedResult reduced = optimise(pack, path, options);
  const DirectResult direct = optimise_direct(pack, path, options);
  REQUIRE(direct.ok());
  CHECK(beyond_robot(direct.path, *pack.robot, options.seconds) == "");
  CHECK(direct.path.largest_speeds(2.2).maxCoeff() > 1.1 * (1 - 1e-4));
  CHECK(direct.path.via().front() == path.via().front());
  CHECK(direct.path.via().back() == path.via().back());
  CHECK(direct.objective == Approx(reduced.objective).epsilon(1e-4));
}

TEST_CASE("direct path: two searches at once wait for each other", "[dress_pack]") {
  const PackProblem pack = planar_pack(6);
  const DirectResult alone = optimise_direct(pack, planar_path(3), planar_options());
  REQUIRE(alone.ok());
  DirectResult found[2];
  std::thread other([&] { found[0] = optimise_direct(pack, planar_path(3), planar_options()); });
  found[1] = optimise_direct(pack, planar_path(3), planar_options());
  other.join();
  for (const DirectResult& one : found) {
    CHECK(one.ok());
    CHECK(one.objective == alone.objective);
  }
}

TEST_CASE("direct path: interrupted, the best so far is kept", "[dress_pack]") {
  const PackProblem pack = six_axis_pack(8);
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  ReducedOptions options;
  options.steps = 10;
  options.demands = all_demands();
  options.first_radius = 0.02;
  int calls = 0;
  context.progress = [&](double, const char* what) {
    if (std::string(what) == "optimisation" && ++calls == 40) cancel = true;
  };
  const DirectResult found = optimise_direct(pack, easy_path(4), options, context);
  CHECK(found.status == Status::cancelled);
  CHECK_THAT(found.message, Contains("best path so far"));
  CHECK(!found.history.empty());
  CHECK(found.objective < found.objective_before);
  const DirectResult never = optimise_direct(pack, easy_path(4), options, context);
  CHECK(never.status == Status::cancelled);
}

TEST_CASE("direct path: what cannot begin is refused with the reason", "[dress_pack]") {
  const PackProblem pack = planar_pack(8);
  const auto refuses = [&](auto change, const char* says) {
    ReducedOptions options = planar_options();
    change(options);
    CHECK_THROWS_WITH(optimise_direct(pack, planar_path(3), options), Contains(says));
  };
  refuses([](ReducedOptions& o) { o.demands.clearance = 0.01; }, "the direct formulation keeps no clearance");
  refuses([](ReducedOptions& o) { o.demands.robot_clearance = 0; }, "the direct formulation keeps no clearance");
  refuses([](ReducedOptions& o) { o.steps = 0; }, "0 time steps");
  refuses([](ReducedOptions& o) { o.weights.effort = NAN; }, "the weight of the path is nan");
  const DirectResult beyond = optimise_direct(pack, JointPath({degrees({0, 60}), degrees({0, 200})}));
  CHECK(beyond.status == Status::infeasible);
  CHECK_THAT(beyond.message, Contains("via point 1"));
  PackProblem torn = planar_pack(8);
  torn.rods[0] = hose(0.3, 8);
  const DirectResult taut = optimise_direct(torn, planar_path(4));
  CHECK(taut.status == Status::infeasible);
  CHECK_THAT(taut.message, Contains("the rods cannot follow the path"));
  const DirectResult none = optimise_direct(pack, planar_path(2), planar_options());
  CHECK(none.ok());
  CHECK(none.objective == none.objective_before);
}
