// The local optimum of curves of straights and arcs: gradients by finite differences, lengths by closed forms.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "method/pcc/bfgs.h"
#include "method/pcc/pcc_terms.h"
#include "unit/method/pcc_cases.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

/// Obstacles near a curve, with preferences.
Scene some_obstacles() {
  Scene scene;
  PlacedObstacle ball{"ball", {}, 0};
  ball.body.shape = Sphere{0.08};
  ball.body.pose.at = Vec3(0.3, 0.05, 0.02);
  ball.prefer = Preference::avoid;
  scene.add(ball);
  PlacedObstacle block{"block", {}, 0.005};
  block.body.shape = Box{Vec3(0.05, 0.1, 0.05)};
  block.body.pose = Frame().moved(Vec3(0.65, -0.1, 0.1), Vec3::UnitZ(), 0.4);
  block.prefer = Preference::near;
  scene.add(block);
  return scene;
}

PccPoints random_seed(std::mt19937& random, const Ends& ends, int bends, double radius) {
  std::uniform_real_distribution<double> any(-1, 1);
  PccPoints seed{{ends.start}, std::vector<double>(bends, radius)};
  for (int i = 1; i <= bends; ++i) {
    const double share = i / (bends + 1.0);
    seed.points.push_back((1 - share) * ends.start + share * ends.finish + 0.12 * Vec3(any(random), any(random), any(random)));
  }
  seed.points.push_back(ends.finish);
  return seed;
}

/// Central differences of order four against the gradient, relative to its largest entry. The best of three steps: the others
/// may reach across a place where a penalty sets in.
template <class Function>
double gradient_error(Function& function, const Eigen::VectorXd& x, double step) {
  Eigen::VectorXd gradient, unused;
  function(x, gradient);
  double worst = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto error = [&](double h) {
      const auto at = [&](double by) {
        Eigen::VectorXd moved = x;
        moved[i] += by;
        return function(moved, unused);
      };
      return std::abs((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h) - gradient[i]);
    };
    worst = std::max(worst, std::min({error(step), error(0.07 * step), error(0.005 * step)}));
  }
  return worst / gradient.lpNorm<Eigen::Infinity>();
}

}  // namespace

TEST_CASE("BFGS: a quadratic, Rosenbrock's valley, a kink") {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(6, 3.0);
  const auto quadratic = [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    gradient.resize(6);
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
      const double weight = std::pow(10.0, i);
      gradient[i] = 2 * weight * (at[i] - i);
      sum += weight * (at[i] - i) * (at[i] - i);
    }
    return sum;
  };
  CHECK(minimize(quadratic, x, {}).converged);
  for (int i = 0; i < 6; ++i) CHECK(x[i] == Approx(i).margin(1e-8));

  Eigen::VectorXd y = Eigen::Vector2d(-1.2, 1);
  const auto valley = [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    const double a = 1 - at[0], b = at[1] - at[0] * at[0];
    gradient = Eigen::Vector2d(-2 * a - 400 * b * at[0], 200 * b);
    return a * a + 100 * b * b;
  };
  CHECK(minimize(valley, y, {}).converged);
  CHECK((y - Eigen::Vector2d(1, 1)).norm() < 1e-7);

  // |x| + (y - x)^2: its minimum is where the gradient jumps.
  Eigen::VectorXd z = Eigen::Vector2d(0.7, -2);
  const auto kink = [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    const double d = at[1] - at[0];
    gradient = Eigen::Vector2d((at[0] > 0 ? 1 : -1) - 2 * d, 2 * d);
    return std::abs(at[0]) + d * d;
  };
  CHECK(minimize(kink, z, {}).value < 1e-6);
}

TEST_CASE("descent: gradients of every term against finite differences") {
  const Scene scene = some_obstacles();
  Ends ends{Vec3::Zero(), Vec3(1, 0.2, -0.1).normalized(), Vec3(0.9, 0.1, 0.2), Vec3(0.7, 0.3, 0.5).normalized()};
  PccDemands demands;
  demands.min_straight = 0.08;
  demands.end_straight = 0.05;
  demands.max_turn = 0.4;
  demands.min_length = 3;
  struct Case {
    const char* what;
    double start_cone, finish_cone, preference, max_length, free_ends;
  };
  for (const Case& c : {Case{"fixed ends", 0, 0, 0, 10, 0}, Case{"cones", 0.05, 0.1, 0, 10, 0.05}, Case{"start cone", 0.1, 0, 0, 0.5, 0},
                        Case{"preference", 0, 0, 2, 10, 0.1}, Case{"all", 0.02, 0.02, 1, 0.7, 0.02}}) {
    demands.start_cone = c.start_cone;
    demands.finish_cone = c.finish_cone;
    demands.max_length = c.max_length;
    demands.free_ends = c.free_ends;
    SpaceDemands asked{0.01, 0.01, {}, {}, c.preference, 0.3};
    const FreeSpace space(scene, asked, {ends.start, ends.finish}, 0.2);
    std::mt19937 random(11);
    for (int trial = 0; trial < 60; ++trial) {
      const int bends = 1 + trial % 6;
      const PccPoints seed = random_seed(random, ends, bends, 0.03 + 0.02 * (trial % 2));
      PccUnknowns unknowns(demands, ends, seed.radii);
      PccTerms terms(space, demands, unknowns, 0.004);
      terms.weight = 100;
      Eigen::VectorXd x = unknowns.nearest(seed);
      x += 0.003 * Eigen::VectorXd::Random(x.size());
      terms.plan(x, 0.0213);
      INFO(c.what << ", " << bends << " bends, seed 11, trial " << trial);
      CHECK(gradient_error(terms, x, 1e-5) < 2e-6);
      // And with multipliers.
      Eigen::VectorXd gradient;
      terms(x, gradient);
      terms.update_multipliers(true);
      CHECK(gradient_error(terms, x, 1e-5) < 2e-6);
    }
  }
}

TEST_CASE("descent: gradients from straight to turns of nearly pi") {
  const FreeSpace space(some_obstacles(), {0.01, 0.3, {}, {}, 1, 0.5}, {Vec3::Zero()}, 1);
  PccDemands demands;
  demands.min_straight = 0.01;
  for (const double turn : {1e-6, 1e-5, 1e-3, 0.1, 1.0, 2.0, 2.74, 2.76, 3.0, 3.1, M_PI - 1e-3}) {
    // Two equal turns out of the plane of each other.
    const Vec3 vertex(0.3, 0, 0), second = vertex + 0.4 * Vec3(std::cos(turn), std::sin(turn), 0);
    const Quat again(Eigen::AngleAxisd(turn, Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * Vec3(0, 0.6, 0.8)));
    const Vec3 last = again * Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * Vec3::UnitX();
    const Ends ends{Vec3::Zero(), Vec3::UnitX(), second + 0.3 * last, last};
    const PccPoints seed{{ends.start, vertex, second, ends.finish}, {0.04, 0.05}};
    PccUnknowns unknowns(demands, ends, seed.radii);
    PccTerms terms(space, demands, unknowns, 0);
    terms.weight = 100;
    const Eigen::VectorXd x = unknowns.nearest(seed);
    terms.plan(x, 0.0213);
    INFO("turn " << turn);
    // The step stays below what makes the turn zero, where the tangent lengths have a kink.
    CHECK(gradient_error(terms, x, std::min(1e-5, 0.02 * turn)) < (turn < 1e-3 ? 1e-4 : 2e-6));
  }
  // Turns of 0 and 1e-9: finite, and what the straight has.
  for (const double off : {0.0, 1e-9}) {
    const Ends ends{Vec3::Zero(), Vec3::UnitX(), Vec3(1, off, 0), Vec3::UnitX()};
    const PccPoints seed{{ends.start, Vec3(0.3, 0, 0), Vec3(0.7, off, 0), ends.finish}, {0.05, 0.05}};
    PccUnknowns unknowns(demands, ends, seed.radii);
    PccTerms terms(space, demands, unknowns, 0);
    const Eigen::VectorXd x = unknowns.nearest(seed);
    terms.plan(x, 0.02);
    Eigen::VectorXd gradient;
    CHECK(std::isfinite(terms(x, gradient)));
    CHECK(gradient.allFinite());
    CHECK(gradient.norm() < 10);
  }
}

TEST_CASE("descent: all six words of Dubins to 1e-6 from disturbed seeds") {
  const FreeSpace space = empty_space();
  const double radius = 0.05;
  PccDemands demands;
  demands.radii = {radius};
  DescentOptions options;
  options.polish = true;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const std::string word : {"LSL", "RSR", "LSR", "RSL", "LRL", "RLR"}) {
    int found = 0;
    for (int trial = 0; trial < 200 && found < 12; ++trial) {
      const double reach = word[1] == 'S' ? 6 : 2.5, x = reach * any(random), y = reach * any(random), heading = M_PI * any(random);
      DubinsPath path;
      if (!dubins(word, x, y, heading, path)) continue;
      // Words whose arcs go more than once round are no local optimum of filleted vertices that turn up to 150 degrees each.
      if (path.parts[0] > 4.5 || path.parts[2] > 4.5 || path.parts[0] < 0.1 || path.parts[2] < 0.1) continue;
      ++found;
      PccPoints seed = vertices_of(path, radius);
      CHECK((seed.points.back() - radius * Vec3(x, y, 0)).norm() < 1e-12);
      CHECK(seed.length() == Approx(radius * path.length()).epsilon(1e-12));
      const Ends ends{Vec3::Zero(), Vec3::UnitX(), seed.points.back(), Vec3(std::cos(heading), std::sin(heading), 0)};
      for (std::size_t i = 1; i + 1 < seed.points.size(); ++i) seed.points[i] += 0.1 * radius * Vec3(any(random), any(random), 0);
      const DescentResult result = descend(space, demands, ends, seed, options);
      INFO(word << " to " << x << " " << y << " heading " << heading << ": " << path.parts[0] << " " << path.parts[1] << " "
                << path.parts[2] << "; " << result.iterations << " iterations");
      CHECK(result.length == Approx(radius * path.length()).epsilon(1e-6));
    }
    INFO(word);
    CHECK(found >= 6);
  }
}
