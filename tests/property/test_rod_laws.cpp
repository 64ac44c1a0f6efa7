// Laws that an equilibrium obeys whatever the rod: invariance, balance, energy as work, orders of convergence.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "rod_families.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

SolveOptions options_of(Element element) {
  SolveOptions options;
  options.element = element;
  options.tolerance = 1e-12;
  return options;
}

/// A hose with unequal bending stiffnesses, weight, an interior clip, a force and two parts.
RodProblem rich_problem(std::mt19937_64& random, int segments) {
  Rod rod = test::slender_rod(60, segments);
  Section first = rod.parts[0].section;
  first.EI2 *= 1.7;
  first.GA2 *= 0.8;
  first.mass = 0.6 * first.EI1;
  Section second = first;
  second.EI1 *= 0.5;
  second.GJ *= 0.7;
  second.mass *= 2;
  rod.parts = {{0.6, first}, {1.0, second}};
  RodProblem problem;
  problem.rod = rod;
  const Quat start = test::random_rotation(random);
  const Vec3 along = start * Vec3::UnitZ();
  problem.holds = {{0, {Vec3::Zero(), start}},
                   {0.4, {0.37 * along + 0.05 * test::random_direction(random), start}, true, false},
                   {1, {0.8 * along + 0.1 * test::random_direction(random),
                        start * exp_rotation(0.6 * test::random_direction(random))}}};
  problem.gravity = 9.81 * test::random_direction(random);
  problem.loads = {{0.75, 0.2 * first.EI1 * test::random_direction(random), Vec3::Zero()}};
  return problem;
}

Vec3 total_force(const Equilibrium& e) {
  Vec3 sum = Vec3::Zero();
  for (const Reaction& reaction : e.reactions) sum += reaction.force;
  return sum;
}

double largest_distance(const Equilibrium& a, const Equilibrium& b, int ratio) {
  double largest = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) largest = std::max(largest, (a.points[i] - b.points[i * ratio]).norm());
  return largest;
}

}  // namespace

TEST_CASE("laws: rigid motion moves the equilibrium and turns its reactions") {
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 20; ++member) {
      auto random = test::stream_of(100, member);
      RodProblem problem = rich_problem(random, 40);
      const Equilibrium before = solve(problem, options_of(element));
      const Frame motion{3 * test::random_direction(random), test::random_rotation(random)};
      for (Hold& hold : problem.holds) hold.frame = motion * hold.frame;
      for (PointLoad& load : problem.loads) load.force = motion.rotation * load.force;
      problem.gravity = motion.rotation * problem.gravity;
      // Several equilibria exist; start from the moved one, a little off.
      Equilibrium start = before;
      for (std::size_t i = 0; i < start.s.size(); ++i) {
        const Frame there = motion * Frame{before.points[i] + 1e-4 * test::random_direction(random), before.rotations[i]};
        start.points[i] = there.at;
        start.rotations[i] = there.rotation;
      }
      const Equilibrium after = solve(problem, options_of(element), {}, &start);
      CAPTURE(member, static_cast<int>(element), before.message, after.message);
      REQUIRE(before.ok());
      REQUIRE(after.ok());
      for (std::size_t i = 0; i < before.points.size(); ++i)
        CHECK(((motion * Frame{before.points[i], Quat::Identity()}).at - after.points[i]).norm() < 1e-9);
      for (std::size_t k = 0; k < before.reactions.size(); ++k) {
        const double scale = before.reactions[k].force.norm() + before.reactions[k].moment.norm();
        CHECK((motion.rotation * before.reactions[k].force - after.reactions[k].force).norm() < 1e-6 * scale);
        CHECK((motion.rotation * before.reactions[k].moment - after.reactions[k].moment).norm() < 1e-6 * scale);
      }
    }
}

TEST_CASE("laws: a rod read from its other end has the same equilibrium") {
  // Reversal turns every frame by half a turn about d1, so that d3 points the other way.
  const Quat flip = exp_rotation(Vec3(units::pi, 0, 0));
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 20; ++member) {
      auto random = test::stream_of(101, member);
      const RodProblem problem = rich_problem(random, 40);
      RodProblem reversed = problem;
      reversed.rod.parts = {{0.4, problem.rod.parts[1].section}, {1.0, problem.rod.parts[0].section}};
      for (Hold& hold : reversed.holds) {
        hold.at = 1 - hold.at;
        hold.frame.rotation = hold.frame.rotation * flip;
      }
      for (PointLoad& load : reversed.loads) load.at = 1 - load.at;
      const Equilibrium a = solve(problem, options_of(element));
      REQUIRE(a.ok());
      Equilibrium start = a;  // several equilibria exist; start from the reversed one, a little off
      const std::size_t last = a.s.size() - 1;
      for (std::size_t i = 0; i <= last; ++i) {
        start.s[i] = 1 - a.s[last - i];
        start.points[i] = a.points[last - i] + 1e-4 * test::random_direction(random);
        start.rotations[i] = a.rotations[last - i] * flip;
      }
      const Equilibrium b = solve(reversed, options_of(element), {}, &start);
      CAPTURE(member, static_cast<int>(element), a.message, b.message);
      REQUIRE(b.ok());
      REQUIRE(a.points.size() == b.points.size());
      for (std::size_t i = 0; i < a.points.size(); ++i)
        CHECK((a.points[i] - b.points[b.points.size() - 1 - i]).norm() < 1e-9);
      CHECK(a.energy.total() == Approx(b.energy.total()).epsilon(1e-8));
    }
}

TEST_CASE("laws: reactions carry weight and loads, and their moments balance about any point") {
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 20; ++member) {
      auto random = test::stream_of(102, member);
      const RodProblem problem = rich_problem(random, 40);
      const Equilibrium e = solve(problem, options_of(element));
      CAPTURE(member, static_cast<int>(element));
      REQUIRE(e.ok());
      const Vec3 weight = problem.rod.mass() * problem.gravity;
      CHECK((total_force(e) + weight + problem.loads[0].force).norm() < 1e-7 * weight.norm());
      // The weight's moment: exact lumping at the vertices for the staggered element; the other corrects it to fourth order.
      const Vec3 about(0.3, -0.4, 0.2);
      Vec3 moment = Vec3::Zero();
      for (std::size_t k = 0; k < e.reactions.size(); ++k)
        moment += e.reactions[k].moment + (e.frame_at(problem.holds[k].at).at - about).cross(e.reactions[k].force);
      moment += (e.frame_at(0.75).at - about).cross(problem.loads[0].force);
      for (std::size_t i = 0; i + 1 < e.s.size(); ++i) {
        const double h = e.s[i + 1] - e.s[i];
        const Vec3 w = h * problem.rod.section_at(0.5 * (e.s[i] + e.s[i + 1])).mass * problem.gravity;
        Vec3 middle = 0.5 * (e.points[i] + e.points[i + 1]);
        if (element == Element::se3)
          middle += h / 12 * (e.rotations[i] * Vec3::UnitZ() - e.rotations[i + 1] * Vec3::UnitZ());
        moment += (middle - about).cross(w);
      }
      CHECK(moment.norm() < 1e-7 * weight.norm());
    }
}

TEST_CASE("laws: the energy's change with a hold's displacement is the reaction") {
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 10; ++member) {
      auto random = test::stream_of(103, member);
      const RodProblem problem = rich_problem(random, 40);
      const Equilibrium middle = solve(problem, options_of(element));
      REQUIRE(middle.ok());
      for (const std::size_t hold : {0, 1, 2}) {
        const Vec3 way = test::random_direction(random), axis = test::random_direction(random);
        auto energy_after = [&](double step, bool turn) {
          RodProblem moved = problem;
          Frame& frame = moved.holds[hold].frame;
          if (turn)
            frame.rotation = exp_rotation(step * axis) * frame.rotation;
          else
            frame.at += step * way;
          const Equilibrium e = solve(moved, options_of(element), {}, &middle);
          REQUIRE(e.ok());
          return e.energy.total();
        };
        auto slope = [&](bool turn) {
          const double h = 1e-3;
          const double near = energy_after(h, turn) - energy_after(-h, turn);
          const double far = energy_after(2 * h, turn) - energy_after(-2 * h, turn);
          return (8 * near - far) / (12 * h);
        };
        CAPTURE(member, hold, static_cast<int>(element));
        const double scale = middle.reactions[hold].force.norm() + middle.reactions[hold].moment.norm() + 1e-3;
        CHECK(std::abs(slope(false) - middle.reactions[hold].force.dot(way)) < 1e-5 * scale);
        if (problem.holds[hold].orientation)
          CHECK(std::abs(slope(true) - middle.reactions[hold].moment.dot(axis)) < 1e-5 * scale);
      }
    }
}

TEST_CASE("laws: pinned ends carry no moment, free ends nothing") {
  for (const Element element : {Element::se3, Element::staggered})
    for (int member = 0; member < 20; ++member) {
      auto random = test::stream_of(104, member);
      RodProblem problem;
      problem.rod = test::slender_rod(80);
      problem.rod.parts[0].section.EI2 *= 1.4;
      problem.rod.parts[0].section.mass = 2 * problem.rod.parts[0].section.EI1;
      problem.gravity = {0, 0, -9.81};
      const Vec3 far = test::random_between(random, 0.4, 0.9) * test::random_direction(random);
      problem.holds = {{0, {Vec3::Zero(), test::random_rotation(random)}}, {0.8, {0.8 * far, Quat::Identity()}, true, false}};
      const Equilibrium e = solve(problem, options_of(element));
      CAPTURE(member, static_cast<int>(element), e.message);
      REQUIRE(e.ok());
      CHECK(e.reactions[1].moment.norm() == 0);
      CHECK((e.points[32] - 0.8 * far).norm() < 1e-12);
      // Beyond the pin the rod hangs free: at its last segment the force is the weight of what is behind.
      const Vec3 rest = problem.rod.parts[0].section.mass * 0.5 / 40 * problem.gravity;
      CHECK((e.forces.back() - rest).norm() < 1e-6 * problem.rod.mass() * 9.81);
    }
}

TEST_CASE("laws: orders of convergence with clips, parts and loads") {
  for (int member = 0; member < 10; ++member) {
    auto random = test::stream_of(105, member);
    auto at = [&](Element element, int segments) {
      auto same = random;
      return solve(rich_problem(same, segments), options_of(element));
    };
    for (const Element element : {Element::se3, Element::staggered}) {
      const Equilibrium a = at(element, 20), b = at(element, 40), c = at(element, 80);
      CAPTURE(member, static_cast<int>(element));
      REQUIRE((a.ok() && b.ok() && c.ok()));
      const double first = largest_distance(a, b, 2), second = largest_distance(b, c, 2);
      CHECK(std::log2(first / second) > (element == Element::se3 ? 3.0 : 1.7));
    }
  }
}

TEST_CASE("laws: pre-curved rods of constant and of varying curvature, unequal stiffnesses") {
  for (const bool varying : {false, true}) {
    auto curvature = [varying](double s) { return Vec3(varying ? 2 * s : 0.5, 3 + (varying ? 4 * s * s : 0), 1); };
    auto shape = [curvature](double s) {
      // Magnus steps of fourth order, fine enough to be exact here.
      Frame frame;
      const int steps = 400;
      const double h = s / steps;
      for (int i = 0; i < steps && s > 0; ++i) {
        const double root = std::sqrt(3.0) / 6, mid = (i + 0.5) * h;
        const Vec3 a = curvature(mid - root * h), b = curvature(mid + root * h);
        const Vec3 turn = 0.5 * h * (a + b) + std::sqrt(3.0) / 12 * h * h * a.cross(b);
        const Quat half = frame.rotation * exp_rotation(0.5 * turn), full = frame.rotation * exp_rotation(turn);
        frame.at += h / 6 * (frame.rotation * Vec3::UnitZ() + 4 * (half * Vec3::UnitZ()) + full * Vec3::UnitZ());
        frame.rotation = full.normalized();
      }
      return frame;
    };
    RodProblem problem;
    problem.rod = test::slender_rod(60);
    problem.rod.parts[0].section.EI2 *= 1.8;
    problem.rod.shape = shape;
    problem.holds = {{0, Frame{}}};
    Frame end = shape(1);
    end.at += Vec3(0.1, -0.08, 0.15);
    end.rotation = end.rotation * exp_rotation(Vec3(0.3, -0.2, 0.4));
    problem.holds.push_back({1, end});
    for (const Element element : {Element::se3, Element::staggered}) {
      std::vector<Equilibrium> found;
      for (const int segments : {20, 40, 80, 160}) {
        problem.rod.segments = segments;
        found.push_back(solve(problem, options_of(element)));
        REQUIRE(found.back().ok());
      }
      const double first = largest_distance(found[1], found[2], 2), second = largest_distance(found[2], found[3], 2);
      const double order = std::log2(first / second);
      CAPTURE(varying, static_cast<int>(element), first, second);
      const double expected = element == Element::staggered ? 2 : varying ? 2 : 4;
      CHECK(order > expected - 0.4);
    }
    // Without load the rod keeps its shape, whatever the mesh.
    problem.holds[1].frame = shape(1);
    for (const Element element : {Element::se3, Element::staggered}) {
      problem.rod.segments = 10;
      const Equilibrium e = solve(problem, options_of(element));
      REQUIRE(e.ok());
      if (element == Element::se3)
        for (std::size_t i = 0; i < e.s.size(); ++i) CHECK((e.points[i] - shape(e.s[i]).at).norm() < 1e-9);
      else
        CHECK(e.energy.total() < 1e-2 * problem.rod.parts[0].section.EI1);
    }
  }
}
