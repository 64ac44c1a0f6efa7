// Whatever a start: what is returned as solved is an equilibrium, and stable.
//
// Rods between random clamps start from shapes that have nothing to do with them: straight, crumpled, a far equilibrium of
// another problem. Judged with the elements' energies alone, by finite differences.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

#include "base/units.h"
#include "rod_families.h"
#include "statics/rod_network.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

using Random = std::mt19937_64;

Equilibrium as_start(const std::vector<double>& s, const std::function<Frame(double)>& shape) {
  Equilibrium start;
  start.s = s;
  for (const double place : s) {
    const Frame frame = shape(place);
    start.points.push_back(frame.at);
    start.rotations.push_back(frame.rotation);
  }
  return start;
}

std::vector<double> even(double length, int segments) {
  std::vector<double> s;
  for (int i = 0; i <= segments; ++i) s.push_back(length * i / segments);
  return s;
}

/// Straight from the start clamp along some direction, its frames turned anyhow about it.
Equilibrium straight_start(Random& random, const RodProblem& problem, bool along_clamp) {
  const Frame& clamp = problem.holds[0].frame;
  Frame from = clamp;
  if (!along_clamp) from.rotation = test::random_rotation(random);
  const double twist = test::random_between(random, -10, 10);
  return as_start(even(problem.rod.length, problem.rod.segments), [=](double s) {
    return from * Frame{Vec3(0, 0, s), exp_rotation(Vec3(0, 0, along_clamp ? 0 : twist * s))};
  });
}

/// A random walk of places and turns.
Equilibrium crumpled_start(Random& random, const RodProblem& problem) {
  Frame at = problem.holds[0].frame;
  const double h = problem.rod.length / problem.rod.segments;
  return as_start(even(problem.rod.length, problem.rod.segments), [&, first = true](double) mutable {
    if (!first) {
      const Vec3 turn = test::random_between(random, 0, 0.6) * test::random_direction(random);
      at = at * Frame{Vec3(0, 0, h), exp_rotation(turn)};
    }
    first = false;
    return at;
  });
}

/// What is left of the energy when the free nodes move: places and body rotations, by finite differences.
struct Judge {
  RodNetwork network;
  RodState state;

  Judge(const RodProblem& problem, const SolveOptions& options, const Equilibrium& e)
      : network({{problem}, {}}, options, {problem.rod.segments}, 1) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < e.points.size(); ++i) frames.push_back({e.points[i], e.rotations[i]});
    state = network.state_from({frames}, {});
  }

  double energy(const std::vector<Vec6>& step, double share) {
    RodState moved = state;
    moved.apply(step, share);
    std::vector<Vec6> unused;
    return network.gradient(moved, unused);
  }

  std::vector<Vec6> random_step(Random& random) {
    std::vector<Vec6> step(network.nodes(), Vec6::Zero());
    for (int i = 0; i < network.nodes(); ++i) {
      const Vec3 move = test::random_between(random, 0, 1) * test::random_direction(random);
      const Vec3 turn = test::random_between(random, 0, 1) * test::random_direction(random);
      for (int k = 0; k < 6; ++k)
        if (!(network.held()[i] >> k & 1)) step[i][k] = k < 3 ? move[k] : turn[k - 3];
    }
    return step;
  }

  /// A smooth step: bends and moves the rod as a whole, so that stretch does not hide the bending energy.
  std::vector<Vec6> smooth_step(Random& random, double length) {
    std::vector<Vec6> step(network.nodes(), Vec6::Zero());
    const Vec3 axis = test::random_direction(random), way = test::random_direction(random);
    const double waves = std::floor(test::random_between(random, 1, 4));
    for (int i = 1; i + 1 < network.nodes(); ++i) {
      const double t = double(i) / (network.nodes() - 1);
      const double share = std::sin(waves * units::pi * t) * std::sin(waves * units::pi * t);
      step[i].head<3>() = 0.1 * length * share * way;
      step[i].tail<3>() = share * axis;
    }
    return step;
  }
};

void judge(Random& random, const RodProblem& problem, const SolveOptions& options, const Equilibrium& e) {
  const double length = problem.rod.length, EI = problem.rod.parts[0].section.EI1;
  CHECK(e.stable);
  CHECK(e.negative_pivots == 0);
  CHECK(std::isfinite(e.energy.total()));
  // Newton's tolerance times the stretch stiffness of a segment bounds what is left of the forces.
  const double stiffest = problem.rod.parts[0].section.EA * problem.rod.segments;
  CHECK(e.residual < 1e-7 * stiffest + 1e-6 * EI / (length * length));
  for (const Hold& hold : problem.holds) {
    const Frame there = hold.at == 0 ? Frame{e.points.front(), e.rotations.front()} : Frame{e.points.back(), e.rotations.back()};
    CHECK((there.at - hold.frame.at).norm() < 1e-9 * length);
    CHECK(there.rotation.angularDistance(hold.frame.rotation) < 1e-7);
  }
  if (options.element == Element::staggered) {
    // Its rotations live on the segments and are not part of the result. It must stay where it is.
    const Equilibrium again = solve(problem, options, {}, &e);
    CHECK(again.ok());
    CHECK(again.energy.total() == Approx(e.energy.total()).epsilon(1e-6).margin(1e-9 * EI / length));
    return;
  }
  Judge judge(problem, options, e);
  for (int trial = 0; trial < 4; ++trial) {
    const bool smooth = trial % 2 == 0;
    const std::vector<Vec6> step = smooth ? judge.smooth_step(random, length) : judge.random_step(random);
    // First and second derivative of the energy along the step, of the fourth order.
    const double t = smooth ? 1e-4 : 1e-5;
    const double here = judge.energy(step, 0), plus = judge.energy(step, t), minus = judge.energy(step, -t);
    const double far_plus = judge.energy(step, 2 * t), far_minus = judge.energy(step, -2 * t);
    const double slope = (8 * (plus - minus) - (far_plus - far_minus)) / (12 * t);
    const double bend = (16 * (plus + minus) - 30 * here - (far_plus + far_minus)) / (12 * t * t);
    const double rounding = 1e-15 * (std::abs(here) + EI / length) / (t * t);
    CAPTURE(trial, slope, bend, here, EI);
    CHECK(bend > -50 * rounding - 1e-6 * EI);
    // The slope left is what Newton's last step, at most its tolerance, leaves of the curvature.
    CHECK(std::abs(slope) < 1e-6 * (std::abs(bend) + EI / length) + 100 * rounding * t);
  }
}

RodProblem random_problem(Random& random, int segments) {
  const auto families = test::rod_families();
  for (;;) {
    const auto& family = families[static_cast<std::size_t>(test::random_between(random, 0, families.size() - 1e-9))];
    if (family.name.find("w L^3") != std::string::npos || family.name.find("1e+12") != std::string::npos) continue;
    RodProblem problem = family.make(random);
    problem.rod.segments = segments;
    return problem;
  }
}

}  // namespace

TEST_CASE("from straight and odd starts nothing is called solved but a stable equilibrium") {
  int solved = 0, runs = 0;
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 300; ++member) {
      auto random = test::stream_of(500, member);
      const RodProblem problem = random_problem(random, member % 3 == 0 ? 20 : 40);
      const int kind = member % 4;
      const Equilibrium start = kind == 0   ? straight_start(random, problem, true)
                                : kind == 1 ? straight_start(random, problem, false)
                                : kind == 2 ? crumpled_start(random, problem)
                                            : solve(random_problem(random, problem.rod.segments));
      SolveOptions options;
      options.element = element;
      const Equilibrium e = solve(problem, options, {}, &start);
      CAPTURE(member, kind, static_cast<int>(element), e.iterations, e.fallbacks, e.message);
      ++runs;
      if (!e.ok()) {
        CHECK(e.status == Status::stalled);
        CHECK(e.message.find("no equilibrium found") == 0);
        CHECK_FALSE(e.stable);
        continue;
      }
      ++solved;
      if (e.message != "solved") options.element = Element::staggered;  // it says that the other element stands in
      judge(random, problem, options, e);
    }
  CAPTURE(solved, runs);
  CHECK(solved > 0.95 * runs);  // the others say that nothing was found
}

TEST_CASE("asked for the nearest equilibrium, a saddle is told from a stable one") {
  // Exact straight compression above the buckling load: an equilibrium, but no stable one.
  RodProblem problem;
  problem.rod = test::slender_rod(100);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1, start.moved({0.95, 0, 0})}};
  const Equilibrium straight = as_start(even(1, 40), [&](double s) { return start.moved({0.95 * s, 0, 0}); });
  for (const Element element : {Element::se3, Element::staggered}) {
    SolveOptions options;
    options.element = element;
    options.stable_only = false;
    const Equilibrium saddle = solve(problem, options, {}, &straight);
    REQUIRE(saddle.ok());
    CHECK(std::abs(saddle.points[20].z()) + std::abs(saddle.points[20].y()) < 1e-6);
    CHECK_FALSE(saddle.stable);
    CHECK(saddle.negative_pivots > 0);
    options.stable_only = true;
    const Equilibrium buckled = solve(problem, options, {}, &straight);
    REQUIRE(buckled.ok());
    CHECK(buckled.stable);
    CHECK(std::hypot(buckled.points[20].z(), buckled.points[20].y()) > 0.1);
    CHECK(buckled.energy.total() < 0.2 * saddle.energy.total());
  }
}
