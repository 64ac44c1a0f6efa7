#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>

#include "statics/first_guess.h"
#include "statics/solve.h"
#include "statics/network_solver.h"

using namespace tendril;

namespace {

RodProblem hose(int segments = 40) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), segments);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

SolveOptions with(Element element, bool error = false) {
  SolveOptions options;
  options.element = element;
  options.error = error;
  return options;
}

}  // namespace

TEST_CASE("solve: what an equilibrium holds") {
  for (const Element element : {Element::se3, Element::staggered}) {
    const Equilibrium e = solve(hose(), with(element));
    REQUIRE(e.ok());
    CHECK(e.message == "solved");
    CHECK(e.stable);
    CHECK(e.fallbacks == 0);
    CHECK(e.last_step < 1e-2);
    CHECK(e.residual < 1e-6);
    CHECK(e.seconds > 0);
    CHECK(e.s.size() == 41);
    CHECK(e.points.size() == 41);
    CHECK(e.rotations.size() == 41);
    CHECK(e.forces.size() == 40);
    CHECK(e.strains.size() == 40);
    CHECK(e.moments.size() == 40);
    CHECK(e.radii == std::vector<double>(40, 0.008));
    CHECK(e.reactions.size() == 2);
    CHECK_FALSE(e.error);
    CHECK(e.energy.total() == Approx(-0.340873).epsilon(element == Element::se3 ? 1e-4 : 2e-2));
    // The end tangents are held, the middle sags.
    CHECK(e.points[20].z() == Approx(-0.39937).epsilon(5e-3));
    for (const Quat& q : e.rotations) CHECK(q.norm() == Approx(1));
  }
}

TEST_CASE("solve: a warm start takes fewer iterations and finds the same") {
  RodProblem problem = hose();
  const Equilibrium cold = solve(problem);
  problem.holds[1].frame.at.x() += 1e-3;
  const Equilibrium warm = solve(problem, {}, {}, &cold), fresh = solve(problem);
  REQUIRE(warm.ok());
  CHECK(warm.iterations <= fresh.iterations);
  for (std::size_t i = 0; i < warm.points.size(); ++i) CHECK((warm.points[i] - fresh.points[i]).norm() < 1e-8);
  // From another mesh, and from another element.
  const Equilibrium finer = solve(hose(60), {}, {}, &cold), other = solve(hose(), with(Element::staggered), {}, &cold);
  CHECK(finer.ok());
  CHECK(other.ok());
}

TEST_CASE("solve: cancelled and out of time return the best state with that status") {
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const Equilibrium cancelled = solve(hose(), {}, context);
  CHECK(cancelled.status == Status::cancelled);
  CHECK(cancelled.points.size() == 41);
  CHECK_THAT(cancelled.message, Catch::Matchers::Contains("interrupted"));
  RunContext late;
  late.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  const Equilibrium timeout = solve(hose(), {}, late);
  CHECK(timeout.status == Status::timeout);
  CHECK_THAT(timeout.message, Catch::Matchers::Contains("out of time"));
  SolveOptions few;
  few.max_iterations = 2;
  const Equilibrium stalled = solve(hose(), few);
  CHECK(stalled.status == Status::stalled);
  CHECK_THAT(stalled.message, Catch::Matchers::Contains("no equilibrium found"));
  for (const Vec3& p : stalled.points) CHECK(all_finite(p));
}

TEST_CASE("solve: saddles are left unless asked to stay") {
  // Straight, 20 % compressed: an equilibrium, but not a stable one.
  RodProblem problem = hose();
  problem.gravity.setZero();
  problem.holds[1].frame.at.x() = 0.96;
  Equilibrium straight;
  for (int i = 0; i <= 40; ++i) {
    straight.s.push_back(1.2 * i / 40);
    straight.points.push_back({0.96 * i / 40, 0, 0});
    straight.rotations.push_back(problem.holds[0].frame.rotation);
  }
  for (const Element element : {Element::se3, Element::staggered}) {
    SolveOptions any = with(element);
    any.stable_only = false;
    const Equilibrium saddle = solve(problem, any, {}, &straight);
    REQUIRE(saddle.ok());
    CHECK_FALSE(saddle.stable);
    CHECK(saddle.negative_pivots > 0);
    CHECK(std::abs(saddle.points[20].z()) < 1e-9);
    const Equilibrium bent = solve(problem, with(element), {}, &straight);
    REQUIRE(bent.ok());
    CHECK(bent.stable);
    CHECK(std::hypot(bent.points[20].z(), bent.points[20].y()) > 0.2);
    CHECK(bent.energy.total() < 0.1 * saddle.energy.total());
  }
}

TEST_CASE("solve: one segment, and a hold at every vertex") {
  RodProblem one = hose(1);
  const Equilibrium single = solve(one);
  CHECK(single.ok());
  CHECK(single.points.size() == 2);
  RodProblem every = hose(4);
  every.holds.clear();
  for (int i = 0; i <= 4; ++i) every.holds.push_back({0.3 * i, Frame::looking({0.3 * i, 0, 0}, {1, 0, 0}, {0, 0, 1})});
  const Equilibrium straight = solve(every);
  REQUIRE(straight.ok());
  CHECK(straight.energy.bend < 1e-15);
  // Each interior hold carries the weight of one span.
  const double span = 0.3 * every.rod.parts[0].section.mass * 9.81;
  CHECK(straight.reactions[2].force.z() == Approx(span));
}

TEST_CASE("error estimate: true to the reference, and not valid where the mesh is hopeless") {
  // Middle of the hose by an independent method: (0.4, 0, -0.3993731449504).
  const Vec3 middle(0.4, 0, -0.3993731449504);
  for (const Element element : {Element::se3, Element::staggered})
    for (const int segments : {20, 40, 80}) {
      const Equilibrium e = solve(hose(segments), with(element, true));
      REQUIRE(e.error);
      CHECK(e.error->valid);
      CHECK(e.error->order == Approx(element == Element::se3 ? 4 : 2).margin(0.8));
      const double off = (e.points[segments / 2] - middle).norm();
      CHECK(e.error->value > 0.3 * off);
      CHECK(e.error->value < 10 * off);  // the middle need not be the worst place
    }
  // A rope: its bending is confined to a hundredth of the length at the clamps.
  RodProblem rope = hose(10);
  rope.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e4, 0.5, 1100)), 10);
  const Equilibrium hopeless = solve(rope, with(Element::staggered, true));
  REQUIRE(hopeless.ok());
  REQUIRE(hopeless.error);
  CHECK_FALSE(hopeless.error->valid);
  CHECK_FALSE(hopeless.error->why.empty());
}

TEST_CASE("first guess: through every hold, of about the rod's length") {
  RodProblem problem = hose();
  problem.holds.insert(problem.holds.begin() + 1, {0.5, {{0.4, 0.1, -0.2}, Quat::Identity()}, true, false});
  const RodMesh mesh = cut_into_segments(problem, 40);
  const std::vector<Frame> guess = first_guess(problem, mesh);
  REQUIRE(static_cast<int>(guess.size()) == mesh.vertices());
  for (std::size_t k = 0; k < problem.holds.size(); ++k) {
    const Frame& there = guess[mesh.hold_vertex[k]];
    CHECK((there.at - problem.holds[k].frame.at).norm() < 1e-12);
    if (problem.holds[k].orientation) CHECK(there.rotation.angularDistance(problem.holds[k].frame.rotation) < 1e-6);
  }
  double length = 0;
  for (std::size_t i = 0; i + 1 < guess.size(); ++i) length += (guess[i + 1].at - guess[i].at).norm();
  CHECK(length == Approx(1.2).epsilon(0.02));
  for (const Frame& frame : guess) CHECK(frame.rotation.norm() == Approx(1));
}

TEST_CASE("first guess: turns are spread as twist") {
  RodProblem problem = hose();
  problem.holds[1].turns = 2;
  const RodMesh mesh = cut_into_segments(problem, 40);
  const std::vector<Frame> guess = first_guess(problem, mesh);
  double twist = 0;
  for (std::size_t i = 0; i + 1 < guess.size(); ++i) twist += log_rotation(guess[i].rotation.conjugate() * guess[i + 1].rotation).z();
  CHECK(twist == Approx(4 * 3.14159265358979).epsilon(5e-3));
}

TEST_CASE("solve: a dead moment in space keeps Newton's convergence quadratic") {
  // The moment has no energy: with a wrong antisymmetric part the steps still shrink, but by a constant factor each.
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.016, 0, Material::from_poisson(5e6, 0.4, 1100)), 20);
  const double EI = problem.rod.parts[0].section.EI1;
  problem.holds = {{0, Frame{}}};
  problem.gravity = {0, 0, -1};
  problem.loads = {{1, {0.01, 0, 0}, {0.5 * EI, 0.15 * EI, 0.25 * EI}}};
  SolveOptions options;
  options.tolerance = 1e-12;
  const Equilibrium e = solve(problem, options);
  REQUIRE(e.ok());
  CHECK(e.fallbacks == 0);
  CHECK(e.iterations <= 9);
  CHECK(e.residual < 1e-9);
}
