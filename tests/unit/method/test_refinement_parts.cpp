// Parts of local refinement: quadratic programs, constrained descent, signs of distances, design spaces, exact derivatives.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include <Eigen/LU>

#include "method/route/constrained_descent.h"
#include "method/route/design_model.h"
#include "method/route/quadratic_program.h"
#include "method/route/signed_gap.h"
#include "method/route/straight_finish.h"
#include "unit/method/refinement_cases.h"
#include "scene/formed_rod.h"

using namespace tendril;
using namespace tendril::routing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The best of all choices of binding rows: at most n of few.
double least_by_enumeration(const QuadraticProgram& p) {
  const int n = static_cast<int>(p.gradient.size()), m = static_cast<int>(p.bounds.size());
  double best = INFINITY;
  for (int set = 0; set < (1 << m); ++set) {
    std::vector<int> rows;
    for (int i = 0; i < m; ++i)
      if (set >> i & 1) rows.push_back(i);
    const int w = static_cast<int>(rows.size());
    if (w > n) continue;
    MatrixXd kkt = MatrixXd::Zero(n + w, n + w);
    VectorXd right(n + w);
    kkt.topLeftCorner(n, n) = p.hessian;
    right.head(n) = -p.gradient;
    for (int k = 0; k < w; ++k) {
      kkt.row(n + k).head(n) = p.rows.row(rows[k]);
      kkt.col(n + k).head(n) = p.rows.row(rows[k]).transpose();
      right[n + k] = p.bounds[rows[k]];
    }
    const Eigen::FullPivLU<MatrixXd> lu(kkt);
    if (!lu.isInvertible()) continue;
    const VectorXd x = lu.solve(right).head(n);
    if ((p.rows * x - p.bounds).minCoeff() < -1e-9) continue;
    best = std::min(best, 0.5 * x.dot(p.hessian * x) + p.gradient.dot(x));
  }
  return best;
}

/// minimise -x - y in a disc of radius `radius` about the origin, and beyond the line x >= `wall`.
class Disc final : public ConstrainedProblem {
 public:
  Disc(double radius, double wall) : radius_(radius), wall_(wall) {}
  const VectorXd& lower() const override { return lower_; }
  const VectorXd& upper() const override { return upper_; }
  Value evaluate(const VectorXd& x) override {
    candidate_ = x;
    ++evaluations;
    return {true, -x.sum(), std::max(0.0, -slacks({{0, 0}, {1, 0}}).minCoeff())};
  }
  void accept() override { at_ = candidate_; }
  bool linearise(const std::vector<Tag>& always, Linear& out) override {
    out.cost = -VectorXd::Ones(2);
    out.tags = always;
    for (int kind : {0, 1})
      if (std::none_of(always.begin(), always.end(), [&](const Tag& t) { return t.kind == kind; })) out.tags.push_back({kind, 0});
    candidate_ = at_;
    out.slacks = slacks(out.tags);
    out.slopes = MatrixXd(out.tags.size(), 2);
    for (std::size_t i = 0; i < out.tags.size(); ++i)
      out.slopes.row(i) = out.tags[i].kind == 0 ? Eigen::RowVector2d(-2 * at_[0], -2 * at_[1]) : Eigen::RowVector2d(1, 0);
    return true;
  }
  VectorXd slacks(const std::vector<Tag>& tags) override {
    VectorXd all(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
      all[i] = tags[i].kind == 0 ? radius_ * radius_ - candidate_.squaredNorm() : candidate_[0] - wall_;
    return all;
  }
  int evaluations = 0;

 private:
  double radius_, wall_;
  VectorXd lower_ = VectorXd::Constant(2, -3), upper_ = VectorXd::Constant(2, 3), candidate_, at_;
};

}  // namespace

TEST_CASE("quadratic programs: the answer of trying all binding rows", "[refinement]") {
  const unsigned seed = 7;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 4, m = 2 + trial % 7;
    QuadraticProgram p;
    const MatrixXd root = MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    p.hessian = root * root.transpose() + 0.05 * MatrixXd::Identity(n, n);
    p.gradient = 3 * VectorXd::NullaryExpr(n, [&] { return normal(random); });
    p.rows = MatrixXd::NullaryExpr(m, n, [&] { return normal(random); });
    const VectorXd start = VectorXd::NullaryExpr(n, [&] { return normal(random); });
    p.bounds = p.rows * start - VectorXd::NullaryExpr(m, [&] { return std::abs(normal(random)); });
    const QuadraticSolution got = solve(p, start);
    REQUIRE(got.converged);
    CHECK((p.rows * got.x - p.bounds).minCoeff() > -1e-9);
    const double value = 0.5 * got.x.dot(p.hessian * got.x) + p.gradient.dot(got.x);
    CHECK(value == Approx(least_by_enumeration(p)).margin(1e-9));
    // Karush, Kuhn, Tucker.
    CHECK((p.hessian * got.x + p.gradient - p.rows.transpose() * got.multipliers).norm() < 1e-7);
    CHECK(got.multipliers.minCoeff() >= 0);
    CHECK(std::abs(got.multipliers.dot(p.rows * got.x - p.bounds)) < 1e-7);
  }
}

TEST_CASE("constrained descent: curved and straight constraints, and none that can be kept", "[refinement]") {
  const RunContext context;
  DescentOptions options;
  options.tolerance = 1e-12;
  {
    Disc disc(1, -3);
    const DescentOutcome out = descend(disc, Eigen::Vector2d(0.3, -0.8), options, context);
    CHECK(out.converged);
    CHECK((out.x - Eigen::Vector2d(std::sqrt(0.5), std::sqrt(0.5))).norm() < 1e-5);
    CHECK(out.evaluations == disc.evaluations);
    CHECK(out.evaluations < 40);
  }
  {
    Disc disc(1, 0.9);
    const DescentOutcome out = descend(disc, Eigen::Vector2d(-2, -1), options, context);
    CHECK((out.x - Eigen::Vector2d(0.9, std::sqrt(1 - 0.81))).norm() < 1e-6);
    CHECK(out.value.violation < 1e-8);
  }
  {
    // The disc ends before the wall begins: the violations -slack meet at 1 - x^2 = x - 2 on the axis.
    Disc disc(1, 2);
    const DescentOutcome out = descend(disc, Eigen::Vector2d(-2, -1), options, context);
    const double least = 2 - 0.5 * (std::sqrt(13.0) - 1);  // x = (sqrt(13) - 1) / 2, violation 2 - x
    CHECK(out.value.violation == Approx(least).margin(1e-3));
  }
}

TEST_CASE("signed gaps: behind a mesh is below its face", "[refinement]") {
  auto field = std::make_shared<Surroundings>();
  Obstacle plate;
  plate.shape = std::make_shared<const TriangleSurface>(
      Mesh{"plate", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  plate.clearance = 0.01;
  field->add(plate);
  Obstacle ball;
  ball.shape = Solid(Sphere{0.1});
  ball.pose.at = {0, 0, 0.5};
  ball.clearance = 0.02;
  field->add(ball);
  const SignedGap gap(field);
  const Vec3 outside(0.3, 0.2, 0.2);
  const auto check = [&](const Vec3& p, double value, const Vec3& normal, int obstacle) {
    const SignedGap::Value got = gap.at(p, outside, 1);
    CHECK(got.gap == Approx(value).margin(1e-12));
    CHECK((got.normal - normal).norm() < 1e-9);
    CHECK(got.obstacle == obstacle);
  };
  check({0.3, 0.2, 0.05}, 0.04, {0, 0, 1}, 0);
  check({0.31, 0.18, -0.05}, -0.06, {0, 0, 1}, 0);
  check({0.31, 0.18, -0.5}, -0.51, {0, 0, 1}, 0);
  check({0.13, 0, 0.5}, 0.03 - 0.02, {1, 0, 0}, 1);
  check({0.05, 0, 0.5}, -0.05 - 0.02, {1, 0, 0}, 1);  // a solid's distance is signed by itself
  CHECK(gap.at({5, 5, 5}, outside, 0.5).obstacle == -1);
  CHECK(gap.at({5, 5, 5}, outside, 0.5).gap == 0.5);
  CHECK(SignedGap(nullptr).at({0, 0, 0}, outside, 0.5).gap == 0.5);
}

TEST_CASE("a preformed shape gets longer at its finish and keeps its bends", "[refinement]") {
  const Curve curve = Curve::pcc({{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.3, 0}, {0.3, 0.3, 0.4}, {0.5, 0.6, 0.4}}, {0.05, 0.08, 0.06});
  for (const double by : {-0.1, 0.0, 0.2}) {
    const Curve moved = with_finish_moved(curve, by);
    CHECK(moved.length() == Approx(curve.length() + by).margin(1e-12));
    for (const double share : {0.1, 0.4, 0.5, 0.7}) {
      const double s = share * curve.length();
      CHECK((moved.at(s).at - curve.at(s).at).norm() < 1e-12);
      CHECK((moved.curvature(s) - curve.curvature(s)).norm() < 1e-9);
    }
  }
  // Two bends in one plane and of one radius that follow each other without a straight.
  const double t = 0.1 * std::tan(0.25 * 3.14159265358979323846);
  const Curve turned = Curve::pcc({{0, 0, 0}, {0.2 + t, 0, 0}, {0.2 + t, 2 * t, 0}, {-0.2, 2 * t, 0}}, {0.1, 0.1});
  const Curve longer = with_finish_moved(turned, 0.05);
  CHECK(longer.length() == Approx(turned.length() + 0.05).margin(1e-9));
  CHECK(longer.min_bend_radius() == Approx(0.1));
  CHECK(straight_finish(Curve::spline({{0, 0, 0}, {0.2, 0.1, 0}, {0.4, 0, 0}})) == 0);
  CHECK(straight_finish(Curve::pcc({{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.2, 0}}, 0.05)) == Approx(0.15));

  Design design = u_design(0.6);
  form(design.rod, Curve::spline({{0, 0, 0}, {0.2, 0.1, 0}, {0.4, 0, 0}}));
  design.rod.parts.back().upto = design.rod.length;
  CHECK_THROWS_WITH(DesignSpace(design, {}),
                    Catch::Contains("expected a shape of straights and bends (curve.pcc) that ends with a straight"));
}

TEST_CASE("design spaces: first-order changes are those of the design", "[refinement]") {
  const Design design = clipped_design();
  RefinementOptions options = everything();
  const DesignSpace space(design, options);
  std::vector<std::string> names;
  VectorXd x(space.size());
  for (int j = 0; j < space.size(); ++j) {
    names.push_back(space.variables()[j].name);
    x[j] = space.variables()[j].start + 0.05 * (j % 3 - 1) + 0.01;
  }
  CHECK(names == std::vector<std::string>{"length", "from.turn", "to.turn", "from.tilt.1", "from.tilt.2", "to.tilt.1", "to.tilt.2",
                                          "clip.1", "clip.2"});
  for (int j = 0; j < space.size(); ++j) {
    INFO(names[j]);
    const double step = 1e-6;
    VectorXd more = x, less = x;
    more[j] += step;
    less[j] -= step;
    SystemProblem a, b;
    a.rods = {space.problem(space.design(more), {0, 0, -9.81})};
    b.rods = {space.problem(space.design(less), {0, 0, -9.81})};
    for (const auto& [parameter, weight] : space.direction(j, x)) {
      change(b, parameter, 2 * step * weight);
    }
    for (std::size_t h = 0; h < a.rods[0].holds.size(); ++h) {
      CHECK(a.rods[0].holds[h].at == Approx(b.rods[0].holds[h].at).margin(1e-12));
      CHECK((a.rods[0].holds[h].frame.at - b.rods[0].holds[h].frame.at).norm() < 1e-12);
      CHECK(log_rotation(a.rods[0].holds[h].frame.rotation.conjugate() * b.rods[0].holds[h].frame.rotation).norm() < 1e-10);
    }
    CHECK(a.rods[0].rod.length == Approx(b.rods[0].rod.length).margin(1e-12));
  }
}

TEST_CASE("design spaces: clips stay in order inside the rod, whatever is tried", "[refinement]") {
  Design design = clipped_design();
  RefinementOptions options;
  options.adjust.clips = true;
  const DesignSpace space(design, options);
  REQUIRE(space.size() == 3);
  CHECK(space.in_order(Eigen::Vector3d(1, 0.3, 0.62)));
  CHECK_FALSE(space.in_order(Eigen::Vector3d(1, 0.63, 0.62)));
  CHECK_FALSE(space.in_order(Eigen::Vector3d(1, 0.62, 0.62)));
  CHECK_FALSE(space.in_order(Eigen::Vector3d(0.6, 0.3, 0.62)));
  CHECK_FALSE(space.in_order(Eigen::Vector3d(1, 0.3, 1.01)));
  CHECK_FALSE(space.in_order(Eigen::Vector3d(1, 0, 0.62)));

  // Clips close to each other and to the finish, which shifts of 0.1 m bring out of order.
  for (unsigned seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<> off(-0.02, 0.02);
    Design close;
    close.rod = Rod::uniform(1.0, soft_hose(), 60);
    close.from = Frame::looking({0, 0, 0.3}, {1, 0, 0});
    close.to = Frame::looking({0.9, 0, 0.3}, {1, 0, 0});
    for (const double at : {0.45, 0.5, 0.93, 0.97})
      close.clips.push_back({at + 0.5 * off(random), Frame::looking({0.9 * at, off(random), 0.3 + off(random)}, {1, off(random), 0})});
    options.min_bend_radius = 0.1;
    options.solver = seed % 2 ? RefinementSolver::gradient : RefinementSolver::gradient_free;
    options.max_evaluations = 60;
    const RefinementResult result = refine(hall(), close, options);
    double last = 0;
    for (const Hold& clip : result.design.clips) {
      CHECK(clip.at > last);
      last = clip.at;
    }
    CHECK(result.design.rod.length > last);
  }
}

TEST_CASE("design models: slopes of cost and constraints against differences", "[refinement]") {
  struct Case {
    const char* name;
    Scene scene;
    Design design;
    RefinementOptions options;
  };
  std::vector<Case> cases;
  RefinementOptions all = everything();
  all.min_bend_radius = 0.08;
  all.clearance = 0.02;
  all.clearance_weight = 0.7;
  all.preference_weight = 0.4;
  all.range = 0.3;
  all.max_tension = 2;
  all.max_strain = 0.1;
  cases.push_back({"hanging over a floor, a ball beside", hall(), u_design(0.75), all});
  cases.push_back({"with clips", hall(), clipped_design(), all});
  cases.push_back({"preformed", hall(), preformed_design(), all});
  RefinementOptions touching = all;
  touching.clearance = 0;
  cases.push_back({"lying on the floor", hall(0), u_design(1.2), touching});
  for (Case& c : cases) {
    INFO(c.name);
    const SurroundingsByUse around(c.scene, c.options);
    const DesignSpace space(c.design, c.options);
    const RunContext context;
    c.options.solve.tolerance = 1e-12;
    DesignModel model(around, c.scene.gravity(), space, c.options, context);
    VectorXd x = model.start();
    for (int j = 0; j < x.size(); ++j) x[j] += 0.06 * (j % 3 - 1) + 0.02;
    REQUIRE(model.begin(x));
    REQUIRE(model.evaluate(x).valid);
    model.accept();
    ConstrainedProblem::Linear linear;
    REQUIRE(model.linearise({}, linear));
    REQUIRE(linear.tags.size() >= 3);
    for (int j = 0; j < x.size(); ++j) {
      const double step = 2e-5;
      VectorXd more = x, less = x;
      more[j] += step;
      less[j] -= step;
      const auto above = model.evaluate(more);
      const VectorXd slacks_above = model.slacks(linear.tags);
      const auto below = model.evaluate(less);
      const VectorXd slacks_below = model.slacks(linear.tags);
      INFO(space.variables()[j].name);
      REQUIRE((above.valid && below.valid));
      const double digits = model.accepted().rod().contacts.empty() ? 1e-4 : 5e-4;
      CHECK((above.cost - below.cost) / (2 * step) == Approx(linear.cost[j]).epsilon(digits).margin(2e-5));
      int wrong = 0;
      for (std::size_t i = 0; i < linear.tags.size(); ++i) {
        const double difference = (slacks_above[i] - slacks_below[i]) / (2 * step), exact = linear.slopes(i, j);
        if (std::abs(difference - exact) > 1e-3 * std::abs(exact) + 1e-3) {
          UNSCOPED_INFO("constraint of kind " << linear.tags[i].kind << " at " << linear.tags[i].place << ": " << difference
                                              << " against " << exact);
          ++wrong;
        }
      }
      CHECK(wrong == 0);
    }
  }
}
