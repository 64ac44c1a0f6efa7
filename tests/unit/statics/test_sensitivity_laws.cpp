// What sensitivities must be whatever the numbers: closed forms, invariances, agreement of different ways to the same thing.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "base/error.h"
#include "statics/sensitivity.h"
#include "sensitivity_cases.h"

using namespace tendril;
using namespace tendril::sensitivity_cases;
using Kind = Parameter::Kind;
using What = Measure::What;

namespace {

double derivative(const Sensitivity& s, const Measure& m, const Parameter& p) { return s.gradient(m, std::span(&p, 1)).front(); }

Measure of(What what, double at = 0, const Vec3& along = Vec3::UnitZ(), int index = 0) {
  Measure m;
  m.what = what;
  m.at = at;
  m.along = along;
  m.index = index;
  return m;
}

/// A weightless bar of 1 m along x, clamped at its start.
RodProblem cantilever(const Vec3& force) {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.01, 0, Material::from_poisson(5e6, 0.4, 0)), 20);
  problem.holds = {{0, Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1})}};
  problem.loads = {{1, force, Vec3::Zero()}};
  return problem;
}

RodProblem hose() {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.016, 0, Material::from_poisson(5e6, 0.5, 1100)), 24);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  problem.holds = {{0, start}, {1.2, start.moved({0.8, 0, 0})}};
  problem.gravity = {0, 0, -9.81};
  return problem;
}

template <class F>
void for_random_rods(F check) {
  for (unsigned seed = 201; seed <= 215; ++seed) {
    std::mt19937 random(seed);
    const SystemProblem problem = random_rod(random);
    Solved solved(problem);
    if (!solved.ok) continue;
    CAPTURE(seed);
    check(problem, solved, Sensitivity(solved.solver.network(), solved.state), random);
  }
}

}  // namespace

TEST_CASE("sensitivity: a cantilever's deflection by force, stiffness and length", "[sensitivity]") {
  const double force = 1e-7;
  Solved solved({{cantilever({0, 0, -force})}, {}});
  REQUIRE(solved.ok);
  const Sensitivity s(solved.solver.network(), solved.state);
  const Section& section = solved.solver.network().problem().rods[0].rod.parts[0].section;
  const double EI = section.EI1, GA = section.GA1, deflection = -force * (1 / (3 * EI) + 1 / GA);
  const Measure tip = of(What::position, 1);
  CHECK(s.measure(tip).value == Approx(deflection).epsilon(1e-8));
  CHECK(derivative(s, tip, {Kind::load_force, 0, 0, 0, 2}) == Approx(1 / (3 * EI) + 1 / GA).epsilon(1e-6));
  CHECK(derivative(s, tip, {Kind::EI}) == Approx(force / (3 * EI * EI)).epsilon(1e-6));
  CHECK(derivative(s, tip, {Kind::GA}) == Approx(force / (GA * GA)).epsilon(1e-6));
  CHECK(derivative(s, tip, {Kind::stiffness}) == Approx(-deflection).epsilon(1e-6));
  CHECK(derivative(s, tip, {Kind::length}) == Approx(-force * (1 / EI + 1 / GA)).epsilon(1e-6));
  CHECK(derivative(s, of(What::reaction_moment, 0, {0, 1, 0}), {Kind::length}) == Approx(-force).epsilon(1e-6));
  CHECK(derivative(s, of(What::bend), {Kind::EI}) == Approx(-force * force / (6 * EI * EI)).epsilon(1e-6));
}

TEST_CASE("sensitivity: a bar pulled straight", "[sensitivity]") {
  Solved solved({{cantilever({2e-3, 0, 0})}, {}});
  REQUIRE(solved.ok);
  const Sensitivity s(solved.solver.network(), solved.state);
  const double EA = solved.solver.network().problem().rods[0].rod.parts[0].section.EA;
  const Parameter pull{Kind::load_force, 0, 0, 0, 0};
  CHECK(derivative(s, of(What::length), pull) == Approx(1 / EA).epsilon(1e-9));
  CHECK(derivative(s, of(What::max_tension), pull) == Approx(1));
  CHECK(derivative(s, of(What::max_strain), pull) == Approx(1 / EA).epsilon(1e-9));
  CHECK(derivative(s, of(What::reaction_force, 0, Vec3::UnitX()), pull) == Approx(-1));
  CHECK(derivative(s, of(What::length), {Kind::length}) == Approx(1 + 2e-3 / EA).epsilon(1e-9));
  CHECK(derivative(s, of(What::stretch), {Kind::EA}) == Approx(-0.5 * 4e-6 / (EA * EA)).epsilon(1e-6));
}

TEST_CASE("sensitivity: moving the whole scene moves the rod and changes no force", "[sensitivity]") {
  for_random_rods([](const SystemProblem& problem, const Solved&, const Sensitivity& s, std::mt19937& random) {
    std::vector<Parameter> moves;
    const int holds = static_cast<int>(problem.rods[0].holds.size());
    for (int h = 0; h < holds; ++h)
      for (int c = 0; c < 3; ++c) moves.push_back({Kind::hold_position, 0, h, 0, c});
    for (Measure m : measures_of(problem, random)) {
      if (m.what == What::gravity || m.what == What::load || m.what == What::energy) continue;  // heights count
      INFO(name_of(m));
      const std::vector<double> g = s.gradient(m, moves);
      Vec3 sum = Vec3::Zero();
      double largest = 0;
      for (std::size_t k = 0; k < g.size(); ++k) {
        sum[k % 3] += g[k];
        largest = std::max(largest, std::abs(g[k]));
      }
      const bool moves_along = m.what == What::position || m.what == What::gap;
      CHECK((sum - (moves_along ? m.along : Vec3(Vec3::Zero()))).norm() < 1e-9 * (1 + largest));
    }
  });
}

TEST_CASE("sensitivity: turning the whole scene changes nothing that has no direction", "[sensitivity]") {
  for_random_rods([](const SystemProblem& problem, const Solved&, const Sensitivity& s, std::mt19937&) {
    const RodProblem& rod = problem.rods[0];
    for (const What what : {What::min_bend_radius, What::max_tension, What::max_strain, What::length, What::bend, What::twist_energy,
                            What::stretch, What::shear, What::gravity, What::load, What::energy})
      for (int c = 0; c < 3; ++c) {
        const Vec3 axis = Vec3::Unit(c);
        std::vector<Parameter> parameters;
        std::vector<double> way;
        const auto add = [&](Kind kind, int index, const Vec3& by) {
          for (int k = 0; k < 3; ++k) {
            parameters.push_back({kind, 0, index, 0, k});
            way.push_back(by[k]);
          }
        };
        for (int h = 0; h < static_cast<int>(rod.holds.size()); ++h) {
          add(Kind::hold_position, h, axis.cross(rod.holds[h].frame.at));
          add(Kind::hold_orientation, h, axis);
        }
        for (int l = 0; l < static_cast<int>(rod.loads.size()); ++l) {
          add(Kind::load_force, l, axis.cross(rod.loads[l].force));
          add(Kind::load_moment, l, axis.cross(rod.loads[l].moment));
        }
        add(Kind::gravity, 0, axis.cross(rod.gravity));
        const std::vector<double> g = s.gradient(of(what), parameters);
        double sum = 0, largest = 0;
        for (std::size_t k = 0; k < g.size(); ++k) {
          sum += g[k] * way[k];
          largest = std::max(largest, std::abs(g[k] * way[k]));
        }
        CAPTURE(static_cast<int>(what), c);
        CHECK(std::abs(sum) < 1e-9 * (1e-6 + largest));
      }
  });
}

TEST_CASE("sensitivity: scaling everything that is force scales the forces and leaves the shape", "[sensitivity]") {
  for_random_rods([](const SystemProblem& problem, const Solved&, const Sensitivity& s, std::mt19937& random) {
    const RodProblem& rod = problem.rods[0];
    std::vector<Parameter> parameters = {{Kind::stiffness}, {Kind::density}};
    std::vector<double> way = {1, 1};
    for (int l = 0; l < static_cast<int>(rod.loads.size()); ++l)
      for (int c = 0; c < 3; ++c) {
        parameters.push_back({Kind::load_force, 0, l, 0, c});
        way.push_back(rod.loads[l].force[c]);
        parameters.push_back({Kind::load_moment, 0, l, 0, c});
        way.push_back(rod.loads[l].moment[c]);
      }
    for (const Measure& m : measures_of(problem, random)) {
      const std::string unit = unit_of(m.what);
      const bool force = unit == "N" || unit == "N m" || unit == "J";
      const std::vector<double> g = s.gradient(m, parameters);
      double sum = 0, largest = 0;
      for (std::size_t k = 0; k < g.size(); ++k) {
        sum += g[k] * way[k];
        largest = std::max(largest, std::abs(g[k] * way[k]));
      }
      const double value = s.measure(m).value;
      INFO(name_of(m) << ", value " << value << ", derivative along the scaling " << sum);
      CHECK(std::abs(sum - (force ? value : 0)) < 1e-8 * (1e-9 + largest + std::abs(value)));
    }
  });
}

TEST_CASE("sensitivity: the motion is the way between solved states", "[sensitivity]") {
  for_random_rods([](const SystemProblem& problem, const Solved& solved, const Sensitivity& s, std::mt19937&) {
    for (const Parameter& p : parameters_of(problem)) {
      const double h = step_of(p, problem);
      Solved plus(changed(problem, p, h), &solved.state), minus(changed(problem, p, -h), &solved.state);
      if (!plus.ok || !minus.ok) continue;
      const std::vector<Vec6> motion = s.motion(p);
      double off = 0, size = 0;
      for (std::size_t i = 0; i < motion.size(); ++i) {
        const Vec3 way = plus.state.r[i] - minus.state.r[i], turn = log_rotation(minus.state.q[i].conjugate() * plus.state.q[i]);
        off = std::max({off, (way - 2 * h * motion[i].head<3>()).norm(), (turn - 2 * h * motion[i].tail<3>()).norm()});
        size = std::max({size, way.norm(), turn.norm()});
      }
      INFO(name_of(p));
      CHECK(off < 2e-3 * size + 1e-11);
    }
  });
}

TEST_CASE("sensitivity: a section's rotation against differences of solved states", "[sensitivity]") {
  RodProblem problem = hose();
  problem.holds[1].frame.rotation = problem.holds[1].frame.rotation * exp_rotation({0.3, 0.2, 0.5});
  Solved solved({{problem}, {}});
  REQUIRE(solved.ok);
  const Sensitivity s(solved.solver.network(), solved.state);
  const auto section = [](const Solved& at, double place) {
    SystemEquilibrium eq;
    const_cast<NetworkSolver&>(at.solver).describe(at.state, eq);
    return eq.rods[0].frame_at(place).rotation;
  };
  for (const Parameter& p : {Parameter{Kind::length}, Parameter{Kind::hold_orientation, 0, 1, 0, 1}, Parameter{Kind::hold_position, 0, 0, 0, 2},
                             Parameter{Kind::EI}})
    for (const double place : {0.31, 0.77, 1.2}) {
      const double h = 0.1 * step_of(p, {{problem}, {}});
      Solved plus(changed({{problem}, {}}, p, h), &solved.state), minus(changed({{problem}, {}}, p, -h), &solved.state);
      REQUIRE((plus.ok && minus.ok));
      const bool moves = p.kind == Kind::length && place == 1.2;
      const Quat a = section(minus, moves ? place - h : place), b = section(plus, moves ? place + h : place);
      const Vec3 turn = section(solved, place) * Vec3(log_rotation(a.conjugate() * b)) / (2 * h);
      for (int c = 0; c < 3; ++c) {
        CAPTURE(name_of(p), place, c);
        CHECK(derivative(s, of(What::rotation, place, Vec3::Unit(c)), p) == Approx(turn[c]).epsilon(1e-5).margin(1e-6 * turn.norm() + 1e-14 / h));
      }
    }
  CHECK(s.measure(of(What::rotation, 0.3)).value == 0);
}

TEST_CASE("sensitivity: a functional of the state, and another state without new set-up", "[sensitivity]") {
  Solved solved({{hose()}, {}});
  REQUIRE(solved.ok);
  RodNetwork& network = solved.solver.network();
  Sensitivity s(network, solved.state);
  Measure weights = of(What::functional);
  weights.weights.assign(network.nodes(), Vec6::Zero());
  weights.weights[12][2] = 1;
  const std::vector<Parameter> parameters = {{Kind::mass}, {Kind::hold_position, 0, 1, 0, 0}, {Kind::GJ}, {Kind::EI}};
  const std::vector<double> a = s.gradient(weights, parameters), b = s.gradient(of(What::position, 0.6), parameters);
  for (std::size_t k = 0; k < parameters.size(); ++k) CHECK(a[k] == Approx(b[k]).epsilon(1e-12));
  const std::vector<double> before = s.gradient(of(What::min_bend_radius), parameters);
  RodState elsewhere = solved.state;
  for (Vec3& r : elsewhere.r) r.y() += 0.1 * r.x();
  s.stand_at(elsewhere);
  CHECK(s.gradient(of(What::min_bend_radius), parameters) != before);
  s.stand_at(solved.state);
  CHECK(s.gradient(of(What::min_bend_radius), parameters) == before);
}

TEST_CASE("sensitivity: values are those of the equilibrium's description", "[sensitivity]") {
  for_random_rods([](const SystemProblem& problem, Solved& solved, const Sensitivity& s, std::mt19937&) {
    SystemEquilibrium all;
    solved.solver.describe(solved.state, all);
    const Equilibrium& eq = all.rods[0];
    const auto value = [&](What what, double at = 0, const Vec3& along = Vec3::UnitZ()) { return s.measure(of(what, at, along)).value; };
    const double place = 0.37 * problem.rods[0].rod.length;
    const Frame section = eq.frame_at(place);
    CHECK(value(What::min_bend_radius) == Approx(eq.smallest_bend_radius()));
    CHECK(value(What::max_tension) == Approx(eq.largest_tension()));
    CHECK(value(What::max_strain) == Approx(eq.largest_strain()));
    CHECK(value(What::length) == Approx(eq.settled_length()));
    CHECK(value(What::bend) == Approx(eq.energy.bend));
    CHECK(value(What::twist_energy) == Approx(eq.energy.twist).margin(1e-15));
    CHECK(value(What::stretch) == Approx(eq.energy.stretch));
    CHECK(value(What::shear) == Approx(eq.energy.shear));
    CHECK(value(What::gravity) == Approx(eq.energy.gravity));
    CHECK(value(What::load) == Approx(eq.energy.load).margin(1e-15));
    CHECK(value(What::energy) == Approx(eq.energy.total()));
    for (int c = 0; c < 3; ++c) {
      CHECK(value(What::position, place, Vec3::Unit(c)) == Approx(section.at[c]).margin(1e-13));
      CHECK(value(What::tangent, place, Vec3::Unit(c)) == Approx(section.d3()[c]).margin(1e-13));
      CHECK(value(What::reaction_force, 0, Vec3::Unit(c)) == Approx(eq.reactions[0].force[c]).margin(1e-12));
      CHECK(value(What::reaction_moment, 0, Vec3::Unit(c)) == Approx(eq.reactions[0].moment[c]).margin(1e-12));
    }
  });
}

TEST_CASE("sensitivity: what cannot be asked for", "[sensitivity]") {
  RodProblem problem = hose();
  problem.holds[1].orientation = false;
  problem.rod.parts[0].section.EI2 *= 2;
  Solved solved({{problem}, {}});
  REQUIRE(solved.ok);
  const Sensitivity s(solved.solver.network(), solved.state);
  const auto says = [&](const Measure& m, const Parameter& p, const std::string& text) {
    CHECK_THROWS_WITH(derivative(s, m, p), Catch::Contains(text));
  };
  const Measure tip = of(What::position, 1.2);
  says(tip, {Kind::hold_position, 0, 2}, "got hold 2, expected one of 2");
  says(tip, {Kind::hold_position, 0, 0, 0, 3}, "got component 3, expected one of 3");
  says(tip, {Kind::load_force, 0, 0}, "got load 0, expected one of 0");
  says(tip, {Kind::length, 1}, "got rod 1, expected one of 1");
  says(tip, {Kind::hold_place, 0, 1}, "at an end of its rod does not move");
  says(tip, {Kind::outer}, "outer belongs to a round section of one material");
  says(tip, {Kind::young}, "young belongs to a round section");
  says(tip, {Kind::EI, 0, 0, 0, 0, 5}, "got part 5, expected one of 1");
  says(tip, {Kind::branch_position}, "got branch point 0, expected one of 0");
  says(of(What::position, 1.3), {Kind::EI}, "lies outside the rod (0 to 1.2");
  says(of(What::reaction_moment, 0, Vec3::UnitZ(), 1), {Kind::EI}, "the hold lets that free");
  says(of(What::functional), {Kind::EI}, "has 0 weights, expected one for each of 25 nodes");
  says(of(What::branch_position), {Kind::EI}, "got branch point 0, expected one of 0");
  SolveOptions staggered;
  staggered.element = Element::staggered;
  NetworkSolver other({{hose()}, {}}, staggered);
  CHECK_THROWS_WITH(Sensitivity(other.network(), other.starting_state(nullptr)), Catch::Contains("expected the se3 element"));
}

TEST_CASE("sensitivity: problems with a changed parameter", "[sensitivity]") {
  const SystemProblem problem{{hose()}, {}};
  const Material material = Material::from_poisson(5e6, 0.5, 1100);
  const auto same = [](const Section& a, const Section& b) {
    CHECK(a.outer == Approx(b.outer));
    CHECK(a.inner == Approx(b.inner).margin(1e-15));
    CHECK(a.EA == Approx(b.EA));
    CHECK(a.GA1 == Approx(b.GA1));
    CHECK(a.EI2 == Approx(b.EI2));
    CHECK(a.GJ == Approx(b.GJ));
    CHECK(a.mass == Approx(b.mass));
  };
  const auto section = [&](Kind kind, double by) { return changed(problem, {kind}, by).rods[0].rod.parts[0].section; };
  same(section(Kind::outer, 1e-3), Section::round(0.017, 0, material));
  same(section(Kind::inner, 4e-3), Section::round(0.016, 0.004, material));
  same(section(Kind::young, 1e6), Section::round(0.016, 0, Material::from_poisson(6e6, 0.5, 1100)));
  const SystemProblem longer = changed(problem, {Kind::length}, 0.3);
  CHECK(longer.rods[0].rod.length == Approx(1.5));
  CHECK(longer.rods[0].holds[1].at == Approx(1.5));
  CHECK(longer.rods[0].rod.parts[0].upto == Approx(1.5));
  CHECK(changed(problem, {Kind::gravity, 0, 0, 0, 2}, 1).rods[0].gravity.z() == Approx(-8.81));
  std::mt19937 random(9);
  const SystemProblem tee = random_tee(random);
  for (const Parameter& p : parameters_of(tee)) {
    INFO(name_of(p));
    CHECK(small_step(tee, p) > 0);
    CHECK(std::isfinite(small_step(tee, p)));
  }
  CHECK_THROWS_WITH(changed(problem, {Kind::hold_place, 0, 7}, 0.1), Catch::Contains("got hold 7, expected one of 2"));
  CHECK_THROWS_WITH(changed(problem, {Kind::load_force, 0, 0}, 0.1), Catch::Contains("got load 0, expected one of 0"));
  CHECK_THROWS_WITH(changed(problem, {Kind::joint_place}, 0.1), Catch::Contains("got branch point 0, expected one of 0"));
  CHECK_THROWS_WITH(changed(problem, {Kind::length, 3}, 0.1), Catch::Contains("got rod 3, expected one of 1"));
}
