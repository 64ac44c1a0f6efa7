#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <random>

#include "base/error.h"
#include "base/units.h"
#include "statics/block_ldlt.h"
#include "statics/network_solver.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

Rod hose(double length, int segments = 16) {
  Section section;
  const double radius = 0.006, young = 5e6, area = units::pi * radius * radius;
  section.EA = young * area;
  section.GA1 = section.GA2 = section.EA / 3;
  section.EI1 = section.EI2 = young * units::pi * std::pow(radius, 4) / 4;
  section.GJ = section.EI1 * 2 / 3;
  section.mass = 1100 * area;
  section.outer = 2 * radius;
  Rod rod;
  rod.length = length;
  rod.segments = segments;
  rod.parts = {{length, section}};
  return rod;
}

RodProblem heavy(const Rod& rod, std::vector<Hold> holds) {
  RodProblem problem;
  problem.rod = rod;
  problem.holds = std::move(holds);
  problem.gravity = {0, 0, -9.81};
  return problem;
}

/// Clamp with d1 = +y, d2 = +z, d3 = +x.
Frame clamp(double x, double y, double z) { return {{x, y, z}, Quat(0.5, 0.5, 0.5, 0.5)}; }

Frame turned(double angle, const Vec3& axis, const Vec3& at = Vec3::Zero()) {
  return {at, Quat(Eigen::AngleAxisd(angle, axis))};
}

/// Three hoses at one branch point, a Y held at three clamps.
SystemProblem harness(int segments = 16) {
  SystemProblem problem;
  const Rod rod = hose(0.4, segments);
  problem.rods = {heavy(rod, {{0, clamp(0, 0, 0)}}), heavy(rod, {{0.4, clamp(0.6, 0.3, 0)}}),
                  heavy(rod, {{0.4, clamp(0.6, -0.3, 0.1)}})};
  BranchPoint branch;
  branch.sections = {{0, 0.4, {}},
                     {1, 0, turned(30 * units::deg, Vec3::UnitY())},
                     {2, 0, turned(-30 * units::deg, Vec3::UnitY())}};
  problem.branches = {branch};
  return problem;
}

double largest_difference(const Equilibrium& a, const Equilibrium& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) largest = std::max(largest, (a.points[i] - b.points[i]).norm());
  return largest;
}

}  // namespace

TEST_CASE("network: the elimination order of random trees and loops solves as a dense solver does", "[statics]") {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 60; ++trial) {
    BlockPattern pattern;
    pattern.nodes = 1 + static_cast<int>(random() % 25);
    for (int i = 1; i < pattern.nodes; ++i)
      if (random() % 8) pattern.edges.push_back({static_cast<int>(random() % i), i});
    const int loops = static_cast<int>(random() % 4);
    for (int k = 0; k < loops && pattern.nodes > 2; ++k) {
      const int a = static_cast<int>(random() % pattern.nodes), b = static_cast<int>(random() % pattern.nodes);
      if (a != b) pattern.edges.push_back({a, b});
    }
    const int n = pattern.nodes;
    BlockSystem s;
    s.resize(n, static_cast<int>(pattern.edges.size()));
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    Eigen::VectorXd g(6 * n);
    for (int i = 0; i < n; ++i) {
      const Mat6 d = Mat6::NullaryExpr([&] { return normal(random); });
      s.diagonal[i] = d + d.transpose() + (trial % 2 ? 3.0 : 30.0) * Mat6::Identity();
      s.gradient[i] = Vec6::NullaryExpr([&] { return normal(random); });
      m.block<6, 6>(6 * i, 6 * i) = s.diagonal[i];
      g.segment<6>(6 * i) = s.gradient[i];
    }
    for (std::size_t e = 0; e < pattern.edges.size(); ++e) {
      const auto [a, b] = pattern.edges[e];
      s.upper[e] = Mat6::NullaryExpr([&] { return normal(random); });
      m.block<6, 6>(6 * a, 6 * b) += s.upper[e];
      m.block<6, 6>(6 * b, 6 * a) += s.upper[e].transpose();
    }
    CAPTURE(trial, n, pattern.edges.size());
    BlockLdlt ldlt(pattern);
    const int negative = ldlt.factor(s);
    CHECK(negative == (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().array() < 0).count());
    const Eigen::VectorXd expected = -m.fullPivLu().solve(g);
    std::vector<Vec6> step, x = s.gradient;
    ldlt.newton_step(step);
    ldlt.solve(x);
    double wrong = 0;
    for (int i = 0; i < n; ++i)
      wrong = std::max({wrong, (step[i] - expected.segment<6>(6 * i)).norm(), (x[i] + expected.segment<6>(6 * i)).norm()});
    CHECK(wrong < 1e-7 * expected.norm());
  }
}

TEST_CASE("network: trees are eliminated without fill, a ring of n nodes with n - 3 further blocks", "[statics]") {
  BlockPattern star;
  star.nodes = 31;
  for (int arm = 0; arm < 3; ++arm)
    for (int i = 0; i < 10; ++i) star.edges.push_back({i == 0 ? 0 : 10 * arm + i, 10 * arm + i + 1});
  CHECK(Elimination(star).links().size() == 30);
  BlockPattern ring = BlockPattern::chain(20);
  ring.edges.push_back({19, 0});
  CHECK(Elimination(ring).links().size() == 20 + 17);
}

TEST_CASE("network: gradient and second derivative of a joined lever agree with finite differences", "[statics]") {
  SystemProblem problem = harness(4);
  problem.branches[0].sections[1].relative.at = {0.02, -0.01, 0.03};
  problem.branches[0].sections[2].relative.at = {-0.02, 0.02, 0.01};
  const Element element = GENERATE(Element::se3, Element::staggered);
  SolveOptions options;
  options.element = element;
  NetworkSolver solver(problem, options);
  RodNetwork& network = solver.network();
  RodState state = solver.starting_state(nullptr);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto random_step = [&] {
    std::vector<Vec6> step(network.nodes(), Vec6::Zero());
    for (int i = 0; i < network.nodes(); ++i)
      for (int c = 0; c < 6; ++c)
        if (!(network.held()[i] >> c & 1)) step[i][c] = normal(random) * (c < 3 ? 0.01 : 0.1);
    for (const int node : network.dummies()) step[node].setZero();
    network.complete(state, step);
    return step;
  };
  network.apply(state, random_step(), 1);
  StepSystem linear(network);
  network.assemble(state, Stress::actual, linear.block);
  network.join(state, Stress::actual, linear.block);
  linear.take_out_held(state);
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<Vec6> d = random_step();
    const auto energy_at = [&](double t) {
      RodState there = state;
      network.apply(there, d, t);
      std::vector<Vec6> gradient;
      return network.gradient(there, gradient);
    };
    double slope = 0, curvature = 0;
    for (int i = 0; i < network.nodes(); ++i) {
      slope += linear.block.gradient[i].dot(d[i]);
      curvature += d[i].dot(linear.block.diagonal[i] * d[i]);
    }
    for (const Joints::Joint& joint : network.joints())
      for (int c = 0; c < 6; ++c)
        if (joint.part >> c & 1) curvature -= d[joint.section][c] * d[joint.section][c];  // the dummies' unit diagonal
    for (std::size_t e = 0; e < network.pattern().edges.size(); ++e) {
      const auto [a, b] = network.pattern().edges[e];
      if (a >= 0) curvature += 2 * d[a].dot(linear.block.upper[e] * d[b]);
    }
    const double h = 1e-3;
    const double e0 = energy_at(0), ep = energy_at(h), em = energy_at(-h), ep2 = energy_at(2 * h), em2 = energy_at(-2 * h);
    CHECK(slope == Approx((8 * (ep - em) - (ep2 - em2)) / (12 * h)).epsilon(1e-7));
    CHECK(curvature == Approx((16 * (ep + em) - (ep2 + em2) - 30 * e0) / (12 * h * h)).epsilon(1e-4));
  }
}

TEST_CASE("network: three hoses at a branch point agree with the shooting solution", "[statics]") {
  // Force and moment on the rods' clamped ends, place of the branch point: an independent multiple-shooting solution.
  const SystemEquilibrium eq = solve(harness(40));
  REQUIRE(eq.ok());
  CHECK(eq.rods[0].stable);
  CHECK(eq.rods[0].iterations <= 15);
  CHECK((eq.branches[0].at - Vec3(0.39123404402, -0.016035315391, -0.052366145434)).norm() < 1e-6);
  const Quat reference(0.58575756141693, 0.40034184574546, 0.47504884413448, 0.52052193179009);
  CHECK(log_rotation(eq.branches[0].rotation.conjugate() * reference).norm() < 1e-6);
  CHECK((eq.rods[0].reactions[0].force - Vec3(-0.29626170965817, 0.034703780062783, 0.39596571702603)).norm() < 1e-5);
  CHECK((eq.rods[1].reactions[0].force - Vec3(0.11105572469132, 0.8312422685582, 0.36472040414362)).norm() < 1e-5);
  CHECK((eq.rods[2].reactions[0].moment - Vec3(0.00130783329266, 0.05433671108483, 0.07861896934235)).norm() < 1e-6);
  // What the branch point does to rod 2, and that it bears nothing itself.
  CHECK((eq.rods[1].reactions[1].force - Vec3(-0.11105572469132, -0.8312422685582, 0.12345293493476)).norm() < 1e-5);
  CHECK(eq.branch_supports[0].force.norm() < 1e-9);
  CHECK(eq.branch_supports[0].moment.norm() < 1e-9);
}

TEST_CASE("network: a rod that is cut and joined again is the same rod", "[statics]") {
  const Element element = GENERATE(Element::se3, Element::staggered);
  SolveOptions options;
  options.element = element;
  options.tolerance = 1e-11;
  const Frame a = clamp(0, 0, 0), b{{0.74, 0.1, 0.1}, (clamp(0, 0, 0) * turned(0.5, Vec3(0.3, 0.8, 0.2).normalized())).rotation};
  const Rod whole = hose(0.8, 32), half = hose(0.4, 16);
  const Equilibrium expected = solve(heavy(whole, {{0, a}, {0.8, b}}), options);
  SystemProblem cut;
  cut.rods = {heavy(half, {{0, a}}), heavy(half, {{0.4, b}})};
  cut.branches = {{{{0, 0.4, {}}, {1, 0, {}}}, {}}};
  const SystemEquilibrium joined = solve(cut, options);
  REQUIRE(expected.ok());
  REQUIRE(joined.ok());
  // The staggered element's ghost frames at the cut make another discretisation of the same rod.
  const double tolerance = element == Element::se3 ? 1e-8 : 2e-3;
  for (std::size_t i = 0; i < joined.rods[0].points.size(); ++i) {
    CHECK((joined.rods[0].points[i] - expected.points[i]).norm() < tolerance);
    CHECK((joined.rods[1].points[i] - expected.points[16 + i]).norm() < tolerance);
  }
}

TEST_CASE("network: a ring closed at a held branch point is a rod between two clamps", "[statics]") {
  const Rod rod = hose(0.6, 24);
  const Frame place = clamp(0.1, 0.2, 0.3), back = turned(0.4, Vec3::UnitY(), {0.05, 0, -0.01});
  const Equilibrium clamped = solve(heavy(rod, {{0, place}, {0.6, place * back}}));
  SystemProblem ring;
  ring.rods = {heavy(rod, {})};
  ring.branches = {{{{0, 0, {}}, {0, 0.6, back}}, place, true, true}};
  const SystemEquilibrium closed = solve(ring);
  REQUIRE(clamped.ok());
  REQUIRE(closed.ok());
  CHECK(largest_difference(clamped, closed.rods[0]) < 1e-9);
  CHECK((closed.branch_supports[0].force - Vec3(0, 0, 9.81 * rod.mass())).norm() < 1e-8);
}

TEST_CASE("network: two rods joined at both ends, a closed loop in the middle", "[statics]") {
  SystemProblem loop;
  const Rod arm = hose(0.3, 12), bow = hose(0.5, 20);
  loop.rods = {heavy(arm, {{0, clamp(0, 0, 0)}}), heavy(bow, {}), heavy(bow, {}), heavy(arm, {{0.3, clamp(0.9, 0, 0)}})};
  const Frame left = turned(0.7, Vec3::UnitX()), right = turned(-0.7, Vec3::UnitX());
  loop.branches = {{{{0, 0.3, {}}, {1, 0, left}, {2, 0, right}}, clamp(0.3, 0, 0)},
                   {{{1, 0.5, right}, {2, 0.5, left}, {3, 0, {}}}, clamp(0.7, 0, 0)}};
  const SystemEquilibrium eq = solve(loop);
  REQUIRE(eq.ok());
  CHECK(eq.rods[0].stable);
  Vec3 support = Vec3::Zero();
  double weight = 0;
  for (const Equilibrium& rod : eq.rods) weight += 9.81 * rod.s.back() * arm.parts[0].section.mass;
  support = eq.rods[0].reactions[0].force + eq.rods[3].reactions[0].force;
  CHECK((support - Vec3(0, 0, weight)).norm() < 1e-8);
  for (const Reaction& free : eq.branch_supports) CHECK(free.force.norm() + free.moment.norm() < 1e-8);
  // The clamps' moments about the origin balance the weight's.
  Vec3 moment = Vec3::Zero();
  for (const int k : {0, 3}) {
    const Reaction& r = eq.rods[k].reactions[0];
    moment += r.moment + (k == 0 ? Vec3(0, 0, 0) : Vec3(0.9, 0, 0)).cross(r.force);
  }
  for (const Equilibrium& rod : eq.rods)
    for (std::size_t i = 0; i + 1 < rod.s.size(); ++i) {
      const double h = rod.s[i + 1] - rod.s[i];
      const Frame a{rod.points[i], rod.rotations[i]}, b{rod.points[i + 1], rod.rotations[i + 1]};
      const Vec3 middle = 0.5 * (a.at + b.at) + h / 12 * (a.d3() - b.d3());  // fourth order, as the element's rule
      moment += middle.cross(Vec3(0, 0, -9.81 * h * arm.parts[0].section.mass));
    }
  CHECK(moment.norm() < 1e-5);
}

TEST_CASE("network: interior places of a rod join too, and staggered rods say that theirs do not", "[statics]") {
  SystemProblem tee;
  tee.rods = {heavy(hose(0.8, 32), {{0, clamp(0, 0, 0)}, {0.8, clamp(0.7, 0, 0)}}), heavy(hose(0.2, 8), {})};
  tee.branches = {{{{0, 0.3, {}}, {1, 0, turned(units::pi / 2, Vec3::UnitY())}}, {}}};
  const SystemEquilibrium eq = solve(tee);
  REQUIRE(eq.ok());
  const Vec3 support = eq.rods[0].reactions[0].force + eq.rods[0].reactions[1].force;
  CHECK((support - Vec3(0, 0, 9.81 * (tee.rods[0].rod.mass() + tee.rods[1].rod.mass()))).norm() < 1e-8);
  SolveOptions staggered;
  staggered.element = Element::staggered;
  CHECK_THROWS_WITH(solve(tee, staggered), Catch::Contains("joins rods at their ends only"));
}

TEST_CASE("network: moving and turning the whole harness moves the solution with it", "[statics]") {
  const SystemProblem base = harness();
  const SystemEquilibrium here = solve(base);
  const Frame motion = turned(0.9, Vec3::UnitZ(), {3, -2, 1});  // about the vertical: gravity stays
  SystemProblem moved = base;
  for (RodProblem& rod : moved.rods)
    for (Hold& hold : rod.holds) hold.frame = motion * hold.frame;
  const SystemEquilibrium there = solve(moved);
  REQUIRE(here.ok());
  REQUIRE(there.ok());
  for (std::size_t k = 0; k < here.rods.size(); ++k)
    for (std::size_t i = 0; i < here.rods[k].points.size(); ++i)
      CHECK((motion * Frame{here.rods[k].points[i], Quat::Identity()}).at.isApprox(there.rods[k].points[i], 1e-8));
}

TEST_CASE("network: what cannot be joined is refused with a reason", "[statics]") {
  SystemProblem problem = harness(4);
  problem.rods[0].holds.push_back({0.4, clamp(0.4, 0, 0)});
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("held as well; hold the branch point instead"));
  problem = harness(4);
  problem.branches.push_back(problem.branches[0]);
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("joined twice"));
  problem = harness(4);
  problem.branches[0].sections[1].rod = 7;
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("joins rod 8 of 3"));
  problem = harness(4);
  problem.branches[0].sections[1].at = 0.9;
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("outside the rod"));
  problem = harness(4);
  for (RodProblem& rod : problem.rods) rod.holds.clear();
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("is not held at any place"));
  problem = harness(4);
  problem.branches[0].sections[1].relative.at.x() = NAN;
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("finite"));
  problem.branches[0].sections.clear();
  CHECK_THROWS_WITH(solve(problem), Catch::Contains("joins no rod"));
}
