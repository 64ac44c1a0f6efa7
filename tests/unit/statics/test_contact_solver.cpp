#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "statics/contact_start.h"
#include "statics/network_solver.h"
#include "statics/solve.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

/// A rod that neither stretches nor shears to eight digits: EA L^2 / EI = 1e8.
Section kirchhoff_section(double radius, double bending, double twisting, double mass, double length) {
  Section section;
  section.outer = 2 * radius;
  section.EI1 = section.EI2 = bending;
  section.GJ = twisting;
  section.EA = section.GA1 = section.GA2 = 1e8 * bending / (length * length);
  section.mass = mass;
  return section;
}

Hold clamp(double at, const Vec3& place, const Vec3& along, const Vec3& up = Vec3::UnitZ()) {
  Hold hold;
  hold.at = at;
  hold.frame = Frame::looking(place, along, up);
  return hold;
}

/// A heavy hose of 1.2 m, clamped horizontally 0.1 m above where its centre line lies on a floor. Reference figures:
/// own boundary-value solutions of the planar Kirchhoff rod.
RodProblem hose_on_floor(int segments) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, kirchhoff_section(0.008, 0.016084954386379746, 0.010723302924253164, 0.2211681228127214, 1.2), segments);
  problem.gravity = {0, 0, -9.81};
  problem.holds = {clamp(0, {0, 0, 0.1}, Vec3::UnitX())};
  return problem;
}

const HalfSpace floor_at_radius(Vec3::UnitZ(), -0.008);

Vec3 sum_of_forces(const RodProblem& problem, const Equilibrium& eq) {
  Vec3 sum = problem.rod.mass() * problem.gravity;
  for (const PointLoad& load : problem.loads) sum += load.force;
  for (const ContactForce& contact : eq.contacts) sum += contact.force;
  for (const Reaction& reaction : eq.reactions) sum += reaction.force;
  return sum;
}

/// A plain hose between two clamps 0.8 m apart.
RodProblem sagging_hose() {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.02, 0, Material::from_poisson(5e6, 0.49, 1100)), 40);
  problem.gravity = {0, 0, -9.81};
  problem.holds = {clamp(0, {-0.4, 0, 0}, Vec3::UnitX()), clamp(1, {0.4, 0, 0}, Vec3::UnitX())};
  return problem;
}

}  // namespace

TEST_CASE("contact solver: a heavy hose on a soft floor agrees with the penalty solution of the Kirchhoff rod") {
  struct Reference {
    double stiffness, force, moment, end_x, end_z, energy, tolerance;
  };
  // The contact is integrated at points one radius apart: what the trapezoid rule misses grows with the stiffness.
  for (const Reference& ref : {Reference{1e4, 0.7092127495254275, 0.08403490203901233, 1.1850889833213143, -0.0019597772297889767,
                                         0.0016291984404800484, 1e-4},
                               Reference{1e6, 0.7084156283663451, 0.08356784331268845, 1.1855950140901963,
                                         -9.098455845892724e-05, 8.429480556361588e-05, 1e-3}}) {
    RodProblem problem = hose_on_floor(60);
    problem.surroundings = &floor_at_radius;
    SolveOptions options;
    RodNetwork network({{problem}, {}}, options, {60});
    RodSystem* system = &network.rod(0);
    ContactSolver solver(network, options);
    RodState state = solver.clear_start();
    const ContactOutcome outcome = solver.run_penalty(state, ref.stiffness, {});
    REQUIRE(outcome.newton.status == Status::solved);
    Equilibrium eq;
    system->describe(state, eq);
    solver.describe(state, 0, eq);
    std::vector<Vec6> gradient;
    network.gradient(state, gradient);
    solver.add_gradient(state, gradient);
    Reaction reaction;
    system->add_reaction(0, state, gradient.data(), reaction);
    INFO("k = " << ref.stiffness);
    CHECK(reaction.force.z() == Approx(ref.force).epsilon(ref.tolerance));
    CHECK(std::abs(reaction.moment.y()) == Approx(ref.moment).epsilon(ref.tolerance));
    const Vec3 end = system->frames_of(state).back().at;
    CHECK(std::abs(end.x() - ref.end_x) < 2e-5);
    CHECK(std::abs(end.z() - ref.end_z) < 2e-6);
    CHECK(eq.energy.contact == Approx(ref.energy).epsilon(0.02));
  }
}

TEST_CASE("contact solver: a heavy hose on a rigid floor lifts off where the Kirchhoff rod does") {
  for (Element element : {Element::se3, Element::staggered}) {
    RodProblem problem = hose_on_floor(60);
    problem.surroundings = &floor_at_radius;
    SolveOptions options;
    options.element = element;
    const Equilibrium eq = solve(problem, options);
    INFO((element == Element::se3 ? "se3" : "staggered") << ": " << eq.message);
    REQUIRE(eq.ok());
    const double accuracy = element == Element::se3 ? 1e-3 : 5e-3;
    CHECK(eq.reactions[0].force.z() == Approx(0.708445429800733).epsilon(accuracy));
    CHECK(std::abs(eq.reactions[0].moment.y()) == Approx(0.0835450424978976).epsilon(accuracy));
    // Touch-down at s = 0.48613 with a point force of 0.34629 N; beyond it the floor carries the weight. On points
    // 6.7 mm apart the point force spreads over its neighbours.
    double near_touch_down = 0;
    for (const ContactForce& contact : eq.contacts) {
      CHECK(contact.s > 0.486 - 2 * 0.0067);
      if (contact.s < 0.486 + 0.05) near_touch_down += contact.force.z();
      CHECK(contact.force.z() >= 0);
      CHECK(contact.force.head<2>().norm() == 0);
    }
    const double weight = 0.2211681228127214 * 9.81;
    CHECK(near_touch_down == Approx(0.3462861843173255 + 0.05 * weight).epsilon(0.03));
    CHECK(sum_of_forces(problem, eq).norm() < 1e-9);
    CHECK(eq.deepest_penetration < 1e-2 * 0.008);
    CHECK(eq.points.back().x() == Approx(1.2 - (0.48612776278317155 - 0.4717572080924621)).epsilon(1e-3));
  }
}

TEST_CASE("contact solver: a cantilever's tip on a floor keeps its shape and gives the rest of the load to the floor") {
  struct Reference {
    double drop, touch_force, tip_x, tip_angle;
  };
  const double bending = 0.002454369260617026, radius = 0.005;
  for (const Reference& ref : {Reference{0.1, 0.3031220388040343, 0.9939792953795942, 0.15030682493892877},
                               Reference{0.3, 0.9930978060477731, 0.9442302816669402, 0.45861708123616196},
                               Reference{0.6, 2.9614472292149223, 0.7488287630271846, 0.9796594837201407}}) {
    RodProblem problem;
    problem.rod = Rod::uniform(1, kirchhoff_section(radius, bending, 0.001636246173744684, 0, 1), 20);
    problem.holds = {clamp(0, Vec3::Zero(), Vec3::UnitX())};
    const double load = 1.6 * ref.touch_force * bending;
    problem.loads = {{1.0, {0, 0, -load}, Vec3::Zero()}};
    const HalfSpace floor(Vec3::UnitZ(), -ref.drop - radius);
    problem.surroundings = &floor;
    const Equilibrium eq = solve(problem);
    INFO("drop " << ref.drop << ": " << eq.message);
    REQUIRE(eq.ok());
    double carried = 0;
    for (const ContactForce& contact : eq.contacts) carried += contact.force.z();
    // The overlap or gap that is left, at most 1e-3 radii, moves the touch force by its stiffness, at most 11 EI/L^3.
    CHECK(carried == Approx(load - ref.touch_force * bending).margin(11 * bending * 1.1e-3 * radius));
    CHECK(eq.points.back().x() == Approx(ref.tip_x).margin(2e-5));
    CHECK(eq.points.back().z() == Approx(-ref.drop).margin(1.1e-3 * radius));
    const Vec3 tangent = eq.rotations.back() * Vec3::UnitZ();
    CHECK(std::atan2(-tangent.z(), tangent.x()) == Approx(ref.tip_angle).margin(2e-4));
    // Below the touch force the floor is not there.
    problem.loads[0].force *= 0.9 / 1.6;
    const Equilibrium above = solve(problem);
    REQUIRE(above.ok());
    CHECK(above.contacts.empty());
    CHECK(above.energy.contact == 0);
  }
}

TEST_CASE("contact solver: forces on a ball point away from its centre and balance weight and reactions") {
  RodProblem problem = sagging_hose();
  const Ball ball({0.05, 0.002, -0.2}, 0.12);
  problem.surroundings = &ball;
  for (Element element : {Element::se3, Element::staggered}) {
    SolveOptions options;
    options.element = element;
    const Equilibrium eq = solve(problem, options);
    REQUIRE(eq.ok());
    REQUIRE(!eq.contacts.empty());
    for (const ContactForce& contact : eq.contacts) {
      const Vec3 outwards = (contact.point - Vec3(0.05, 0.002, -0.2)).normalized();
      CHECK(contact.force.dot(outwards) == Approx(contact.force.norm()));
      CHECK(std::abs(contact.gap - ((contact.point - Vec3(0.05, 0.002, -0.2)).norm() - 0.12 - 0.01)) < 1e-12);
    }
    CHECK(sum_of_forces(problem, eq).norm() < 1e-8);
    CHECK(eq.residual < 1e-6);
    CHECK(eq.deepest_penetration < 1e-2 * 0.01);
  }
}

TEST_CASE("contact solver: an obstacle far away changes nothing") {
  RodProblem problem = sagging_hose();
  const Equilibrium alone = solve(problem);
  const HalfSpace floor(Vec3::UnitZ(), -3);
  problem.surroundings = &floor;
  const Equilibrium eq = solve(problem);
  REQUIRE(alone.ok());
  REQUIRE(eq.ok());
  CHECK(eq.contacts.empty());
  CHECK(eq.deepest_penetration == 0);
  for (std::size_t i = 0; i < eq.points.size(); ++i) CHECK((eq.points[i] - alone.points[i]).norm() < 1e-10);
  CHECK(eq.iterations <= alone.iterations + 4);
  CHECK(floor.calls < 60);
}

TEST_CASE("contact solver: the first guess does not hang through a floor") {
  RodProblem problem = sagging_hose();
  const TriangleSheet floor =
      grid_sheet(4, 4, [](double u, double v) { return Vec3(2 * u - 1, 2 * v - 1, -0.05); });
  problem.surroundings = &floor;
  SolveOptions options;
  RodNetwork network({{problem}, {}}, options, {40});
  ContactNetwork contact(network, options.element);
  const ContactStart start = clear_start(network, contact);
  CHECK(start.crossings == 0);
  CHECK(start.tried > 1);
  for (const Vec3& r : start.state.r) CHECK(r.z() > -0.05);
  const Equilibrium eq = solve(problem);
  REQUIRE(eq.ok());
  CHECK(!eq.contacts.empty());
  for (const Vec3& p : eq.points) CHECK(p.z() > -0.05 + 0.01 * (1 - 1e-2));
}

TEST_CASE("contact solver: a free end that points through a floor is curled up first") {
  RodProblem problem = sagging_hose();
  problem.holds = {clamp(0, {0, 0, 0.1}, Vec3(1, 0, -0.3))};
  const TriangleSheet floor = grid_sheet(4, 4, [](double u, double v) { return Vec3(4 * u - 2, 4 * v - 2, 0); });
  problem.surroundings = &floor;
  const Equilibrium eq = solve(problem);
  INFO(eq.message);
  REQUIRE(eq.ok());
  for (const Vec3& p : eq.points) CHECK(p.z() > 0.0099);
  CHECK(sum_of_forces(problem, eq).norm() < 1e-8);
}

TEST_CASE("contact solver: a wall between the two ends is reported, not solved") {
  RodProblem problem = sagging_hose();
  const TriangleSheet wall = grid_sheet(2, 2, [](double u, double v) { return Vec3(0.05, 8 * u - 4, 8 * v - 4); });
  problem.surroundings = &wall;
  const Equilibrium eq = solve(problem);
  CHECK(!eq.ok());
  CHECK(eq.message.find("the rod crosses an obstacle at s = ") != std::string::npos);
  CHECK(eq.points.size() == 41);
  for (const Vec3& p : eq.points) CHECK(all_finite(p));
}

TEST_CASE("contact solver: a warm start after a small move takes few steps and finds the same as a cold one") {
  RodProblem problem = sagging_hose();
  const Ball ball({0.05, 0.002, -0.2}, 0.12);
  problem.surroundings = &ball;
  const Equilibrium before = solve(problem);
  REQUIRE(before.ok());
  problem.holds[1].frame.at += Vec3(-0.002, 0.001, 0.001);
  const Equilibrium warm = solve(problem, {}, {}, &before);
  const Equilibrium cold = solve(problem);
  REQUIRE(warm.ok());
  REQUIRE(cold.ok());
  CHECK(warm.iterations < cold.iterations);
  CHECK(warm.iterations <= 12);
  // Both leave up to 1e-3 radii of overlap; a rod on a ball slides on little.
  for (std::size_t i = 0; i < warm.points.size(); ++i) CHECK((warm.points[i] - cold.points[i]).norm() < 2e-4);
}

TEST_CASE("contact solver: cancelling ends with the state so far") {
  RodProblem problem = sagging_hose();
  const HalfSpace floor(Vec3::UnitZ(), -0.05);
  problem.surroundings = &floor;
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const Equilibrium eq = solve(problem, {}, context);
  CHECK(eq.status == Status::cancelled);
  CHECK(eq.points.size() == 41);
}

TEST_CASE("contact solver: an edge between two contact points is found and followed") {
  // A blade under a straight rod, midway between two contact points: its edge is 0.9 radii below the centre line.
  RodProblem problem = sagging_hose();
  problem.holds[1].frame.at = {0.6, 0, 0};
  const TriangleSheet blade =
      grid_sheet(1, 1, [](double u, double v) { return Vec3(0.1 + 0.0045, 2 * u - 1, -0.009 - 0.5 * v); });
  problem.surroundings = &blade;
  SolveOptions options;
  auto system = make_rod_system(problem, options, cut_into_segments(problem, 40));
  ContactTerms terms(*system, options.element);
  std::vector<Frame> straight;
  for (double s : system->mesh().s) straight.push_back(Frame::looking({-0.4 + s, 0, 0}, Vec3::UnitX(), Vec3::UnitZ()));
  const RodState state = system->state_from(straight);
  terms.set().law = ContactLaw::for_overlap(5, 0.01, 0.1);
  terms.stand_at(state);
  const ContactTerms::Deepest deepest = terms.deepest_at(state);
  CHECK(deepest.penetration == Approx(0.001).epsilon(1e-3));
  CHECK(deepest.point.s == Approx(0.5045).margin(1e-4));
  CHECK(terms.set().deepest() < 0.0005);
  BlockSystem matrix;
  matrix.resize(system->nodes());
  terms.assemble(state, Stress::actual, matrix);
  REQUIRE(terms.sliding().points().size() == 1);
  CHECK(terms.sliding().points()[0].at.s == Approx(0.5045).margin(1e-9));
  CHECK(terms.sliding().points()[0].contact.distance == Approx(0.009));
  // The fixed points beside it would push along the rod.
  CHECK(!terms.set().any());
}
