// Sensitivities of rods in contact: the law keeps its shifts, as it does between two updates of the augmented Lagrangian.
#include <catch2/catch.hpp>

#include <algorithm>
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

std::vector<int> segments_of(const SystemProblem& problem) {
  std::vector<int> segments;
  for (const RodProblem& rod : problem.rods) segments.push_back(rod.rod.segments);
  return segments;
}

/// Rods in contact, settled to rounding under a law whose shifts make up given forces.
struct Touching {
  RodNetwork network;
  ContactSolver solver;
  RodState state;
  std::vector<std::vector<ContactForce>> forces;  ///< by rod
  std::vector<std::vector<double>> shifts;        ///< by rod: of the points that stand
  bool ok = false;

  /// From nothing.
  explicit Touching(const SystemProblem& problem) : network(problem, {}, segments_of(problem)), solver(network, {}) {
    state = solver.clear_start();
    if (solver.run(state, nullptr, {}).newton.status != Status::solved) return;
    for (int k = 0; k < network.rods(); ++k) {
      Equilibrium found;
      solver.describe(state, k, found);
      forces.push_back(found.contacts);
      solver.terms(k).take_forces(forces[k]);
      shifts.push_back(solver.terms(k).set().shifts());
    }
    settle();
  }

  /// Beside another one, with its law and its forces' shifts.
  Touching(const SystemProblem& problem, Touching& like)
      : network(problem, {}, segments_of(problem)), solver(network, {}), state(like.state), forces(like.forces), shifts(like.shifts) {
    for (int k = 0; k < network.rods(); ++k) {
      ContactTerms& terms = solver.terms(k);
      terms.set().law = like.solver.terms(k).set().law;
      if (terms.set().size() != static_cast<int>(shifts[k].size())) return;
      // A force at the finish stays there.
      for (ContactForce& force : forces[k]) force.s *= network.rod(k).length() / like.network.rod(k).length();
      terms.take_forces(forces[k]);
      terms.set().set_shifts(shifts[k]);
    }
    settle();
  }

  int touching(int rod) {
    int count = 0;
    const ContactTerms& terms = solver.terms(rod);
    for (int i = 0; i < terms.set().size(); ++i) count += terms.set().at(i) != nullptr;
    for (const SlidingContacts::Point& p : terms.sliding().points()) count += p.active;
    return count;
  }
  int touching() {
    int count = 0;
    for (int k = 0; k < network.rods(); ++k) count += touching(k);
    return count;
  }

 private:
  void settle() {
    ContactNetwork& contacts = solver.contacts();
    NewtonOptions options;
    options.warm = true;
    options.tolerance = 1e-13;
    contacts.set_exact(true);
    for (int round = 0; round < 2; ++round) {
      contacts.begin(state);
      ok = Newton(network, &contacts).run(state, options, {}).status == Status::solved;
    }
    contacts.set_exact(false);
    contacts.stand_at(state);
  }
};

void compare(const SystemProblem& problem, const std::vector<Parameter>& parameters, int least) {
  Touching touching(problem);
  REQUIRE(touching.ok);
  REQUIRE(touching.touching() > 0);
  const Sensitivity s(touching.network, touching.state, &touching.solver.contacts());
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
      Touching there(changed(problem, p, side == 0 ? h : -h), touching);
      ok = there.ok && there.touching() == touching.touching();
      if (!ok) break;
      const Sensitivity at(there.network, there.state, &there.solver.contacts());
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

TEST_CASE("sensitivity: a hose that lies over an edge, which slides along it", "[sensitivity]") {
  // A roof whose ridge runs across the hose.
  const TriangleSheet roof({{0.03, -1, -0.1}, {0.05, 1, -0.1}, {-0.9, -1, -0.9}, {-0.9, 1, -0.9}, {0.9, -1, -0.9}, {0.9, 1, -0.9}},
                           {{0, 1, 3}, {0, 3, 2}, {0, 5, 1}, {0, 4, 5}});
  const SystemProblem problem = hose_above(roof);
  Touching touching(problem);
  REQUIRE(touching.ok);
  const SlidingContacts& sliding = touching.solver.terms().sliding();
  REQUIRE(std::any_of(sliding.points().begin(), sliding.points().end(), [](const auto& p) { return p.active && p.bend < 0; }));
  compare(problem, all_parameters(), 60);
}

TEST_CASE("sensitivity: three joined hoses of which two lie on a floor", "[sensitivity]") {
  const HalfSpace floor(Vec3(0.05, 0, 1), -0.11);
  SystemProblem problem;
  const Section section = Section::round(0.02, 0.004, Material::from_poisson(5e6, 0.4, 1100));
  const Frame ends[] = {Frame::looking({-0.42, 0, 0}, {1, 0, -0.2}, {0, 0, 1}), Frame::looking({0.42, 0.02, 0.03}, {-1, 0.1, -0.3}, {0, 0, 1}),
                        Frame::looking({0.03, 0.35, 0.25}, {0, -1, -0.4}, {0, 0, 1})};
  BranchPoint tee;
  for (int k = 0; k < 3; ++k) {
    RodProblem rod;
    rod.rod = Rod::uniform(k == 2 ? 0.42 : 0.5, section, 16);
    rod.gravity = {0.3, 0.2, -9.81};
    rod.holds = {{0, ends[k]}};
    rod.surroundings = &floor;
    problem.rods.push_back(rod);
  }
  const Frame middle = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  for (const auto& [rod, along] : {std::pair{0, Vec3(1, 0, 0)}, std::pair{1, Vec3(-1, 0, 0)}, std::pair{2, Vec3(0, -1, -0.3)}})
    tee.sections.push_back({rod, problem.rods[rod].rod.length, middle.inverse() * Frame::looking({0, 0, 0}, along, {0, 0, 1})});
  problem.branches.push_back(tee);
  Touching touching(problem);
  REQUIRE(touching.ok);
  CHECK(touching.touching(0) > 0);
  CHECK(touching.touching(1) > 0);
  std::vector<Parameter> parameters = all_parameters();
  std::erase_if(parameters, [](const Parameter& p) { return p.index > 0 && p.kind != Kind::gravity; });
  parameters.push_back({Kind::length, 2});
  parameters.push_back({Kind::hold_position, 2, 0, 0, 2});
  parameters.push_back({Kind::joint_orientation, 0, 0, 2, 1});
  compare(problem, parameters, 100);
}
