// Sensitivities of rods in contact: the law keeps its shifts, as it does between two updates of the augmented Lagrangian.
#include <catch2/catch.hpp>

#include <cmath>

#include "statics/sensitivity.h"
#include "sensitivity_cases.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::sensitivity_cases;
using namespace tendril::test;
using Kind = Parameter::Kind;
using What = Measure::What;

namespace {

/// A rod in contact, settled to rounding under the law and the shifts of another one, or its own.
struct Touching {
  RodNetwork network;
  ContactSolver solver;
  RodState state;
  bool ok = false;

  Touching(const SystemProblem& problem, Touching* like)
      : network(problem, {}, {problem.rods[0].rod.segments}), solver(network, {}) {
    ContactTerms& terms = solver.terms();
    if (!like) {
      state = solver.clear_start();
      ok = solver.run(state, nullptr, {}).newton.status == Status::solved;
      if (!ok) return;
    } else {
      state = like->state;
      terms.set().law = like->solver.terms().set().law;
      if (terms.set().size() != like->solver.terms().set().size()) return;
      terms.set().set_shifts(like->solver.terms().set().shifts());
    }
    NewtonOptions options;
    options.warm = true;
    options.tolerance = 1e-13;
    terms.set_exact(true);
    for (int round = 0; round < 2; ++round) {
      terms.begin(state);
      ok = Newton(network, &terms).run(state, options, {}).status == Status::solved;
    }
    terms.set_exact(false);
    terms.stand_at(state);
  }
};

void compare(const SystemProblem& problem, const std::vector<Parameter>& parameters, int least) {
  Touching touching(problem, nullptr);
  REQUIRE(touching.ok);
  int pressed = 0;
  for (int i = 0; i < touching.solver.terms().set().size(); ++i) pressed += touching.solver.terms().set().at(i) != nullptr;
  REQUIRE(pressed > 1);
  const Sensitivity s(touching.network, touching.state, &touching.solver.terms());
  std::vector<Measure> measures;
  for (const What what : {What::position, What::tangent, What::force, What::reaction_force, What::reaction_moment,
                          What::min_bend_radius, What::bend, What::length}) {
    Measure m;
    m.what = what;
    m.at = 0.43 * problem.rods[0].rod.length;
    m.along = Vec3(0.3, 0.2, 0.9).normalized();
    measures.push_back(m);
  }
  int compared = 0;
  for (const Parameter& p : parameters) {
    std::vector<double> values[2];
    bool ok = true;
    const double h = 0.02 * step_of(p, problem);
    for (int side = 0; side < 2 && ok; ++side) {
      Touching there(changed(problem, p, side == 0 ? h : -h), &touching);
      ok = there.ok;
      if (!ok) break;
      const Sensitivity at(there.network, there.state, &there.solver.terms());
      for (const Measure& m : measures) values[side].push_back(at.measure(m).value);
    }
    const std::vector<double> forward = s.forward(measures, p);
    for (std::size_t k = 0; k < measures.size(); ++k) {
      const double adjoint = s.gradient(measures[k], std::span(&p, 1)).front();
      INFO(name_of(measures[k]) << " by " << name_of(p));
      CHECK(adjoint == Approx(forward[k]).epsilon(1e-7).margin(1e-8));
      if (!ok) continue;
      const double difference = (values[0][k] - values[1][k]) / (2 * h);
      const double rounding = 1e-10 * std::abs(values[0][k]) / h;
      CHECK(std::abs(adjoint - difference) <= 2e-3 * std::abs(difference) + rounding);
      ++compared;
    }
  }
  CHECK(compared >= least);
}

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all = {{Kind::length}, {Kind::EI}, {Kind::EA}, {Kind::GJ}, {Kind::mass}, {Kind::stiffness},
                                {Kind::outer, 0, 0, 0, 0, 0}, {Kind::inner, 0, 0, 0, 0, 0}};
  for (int c = 0; c < 3; ++c) {
    all.push_back({Kind::gravity, 0, 0, 0, c});
    for (const int hold : {0, 1}) {
      all.push_back({Kind::hold_position, 0, hold, 0, c});
      all.push_back({Kind::hold_orientation, 0, hold, 0, c});
    }
  }
  return all;
}

SystemProblem hose_above(const ContactField& field) {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.02, 0.004, Material::from_poisson(5e6, 0.4, 1100)), 30);
  problem.gravity = {0.3, 0.2, -9.81};
  const Frame start = Frame::looking({-0.42, 0, 0}, {1, 0, -0.2}, {0, 0, 1});
  problem.holds = {{0, start}, {1, Frame::looking({0.42, 0.02, 0.03}, {1, 0.1, 0.3}, {0, 0, 1})}};
  problem.surroundings = &field;
  return {{problem}, {}};
}

}  // namespace

TEST_CASE("sensitivity: a hose that lies on a floor", "[sensitivity]") {
  const HalfSpace floor(Vec3(0.05, 0, 1), -0.11);
  compare(hose_above(floor), all_parameters(), 100);
}

TEST_CASE("sensitivity: a hose that lies over a ball", "[sensitivity]") {
  const Ball ball({0.03, 0.01, -0.25}, 0.2);
  compare(hose_above(ball), all_parameters(), 100);
}
