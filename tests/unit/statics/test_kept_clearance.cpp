#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "base/units.h"
#include "statics/contact_points.h"
#include "statics/contact_reach.h"
#include "statics/solve.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

/// Two fields, each an obstacle with a clearance of its own.
class Pair : public ContactField {
 public:
  Pair(const ContactField& first, double clearance, const ContactField& second, double other)
      : fields_{&first, &second}, clearances_{clearance, other} {}
  ClosestPoint closest(const Vec3& p, double limit) const override { return closest_kept(p, limit, 0); }
  void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const override { terms_kept(p, range, 0, out); }
  std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const override {
    std::optional<RayHit> first = fields_[0]->ray(a, b), second = fields_[1]->ray(a, b);
    if (second) second->obstacle = 1;
    return !second || (first && first->share < second->share) ? first : second;
  }
  double clearance(int obstacle) const override { return clearances_[obstacle]; }
  double largest_clearance() const override { return std::max(clearances_[0], clearances_[1]); }
  ClosestPoint closest_kept(const Vec3& p, double limit, double most) const override {
    ClosestPoint best{limit, p, -1};
    for (int k = 0; k < 2; ++k) {
      const double thick = std::min(clearances_[k], most);
      const ClosestPoint c = fields_[k]->closest(p, limit + thick);
      if (c.obstacle >= 0 && c.distance - thick < best.distance) best = {c.distance - thick, c.point, k};
    }
    return best;
  }
  void terms_kept(const Vec3& p, double range, double most, std::vector<DistanceTerm>& out) const override {
    for (int k = 0; k < 2; ++k) {
      const double thick = std::min(clearances_[k], most);
      const std::size_t before = out.size();
      fields_[k]->terms(p, range + thick, out);
      for (std::size_t i = before; i < out.size(); ++i) {
        out[i].distance -= thick;
        out[i].obstacle = k;
      }
    }
  }
  std::string name(int obstacle) const override { return obstacle == 0 ? "the first" : "the second"; }

 private:
  const ContactField* fields_[2];
  double clearances_[2];
};

const HalfSpace far_below(Vec3::UnitZ(), -100);

Hold clamp(double at, const Vec3& place, const Vec3& along) {
  Hold hold;
  hold.at = at;
  hold.frame = Frame::looking(place, along);
  return hold;
}

/// A hose of 10 mm radius, clamped 0.1 m above z = 0; its far half lies down.
RodProblem lying_hose(const ContactField& field) {
  RodProblem problem;
  problem.rod = Rod::uniform(1.2, Section::round(0.02, 0, Material::from_poisson(2e6, 0.49, 1100)), 60);
  problem.gravity = {0, 0, -9.81};
  problem.holds = {clamp(0, {0, 0, 0.1}, Vec3::UnitX())};
  problem.surroundings = &field;
  return problem;
}

SolveOptions push() {
  SolveOptions options;
  options.clearance = ClearanceRule::push;
  return options;
}

Vec3 unbalanced(const RodProblem& problem, const Equilibrium& eq) {
  Vec3 sum = problem.rod.mass() * problem.gravity;
  for (const ContactForce& contact : eq.contacts) sum += contact.force;
  for (const Reaction& reaction : eq.reactions) sum += reaction.force;
  return sum;
}

double farthest_apart(const Equilibrium& a, const Equilibrium& b) {
  REQUIRE(a.points.size() == b.points.size());
  double apart = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) apart = std::max(apart, (a.points[i] - b.points[i]).norm());
  return apart;
}

}  // namespace

TEST_CASE("kept clearance: a rod on a floor rests that much higher and the reactions carry its weight") {
  const HalfSpace floor(Vec3::UnitZ(), 0);
  for (double clearance : {0.0, 0.002, 0.01, 0.03}) {
    const Pair field(floor, clearance, far_below, 0);
    const RodProblem problem = lying_hose(field);
    const double radius = problem.rod.largest_radius();
    const Equilibrium eq = solve(problem, push());
    INFO("clearance " << clearance << ": " << eq.message);
    REQUIRE(eq.ok());
    CHECK(unbalanced(problem, eq).norm() < 1e-6 * problem.rod.mass() * 9.81);
    CHECK(eq.points.back().z() == Approx(radius + clearance).margin(2e-3 * radius));
    for (const auto& sample : eq.sampled(0.002)) CHECK(sample.frame.at.z() > radius + clearance - 2e-3 * radius);
    REQUIRE(!eq.contacts.empty());
    // The gap is that of the surfaces, the penetration that into what is kept.
    for (const ContactForce& contact : eq.contacts) CHECK(contact.gap == Approx(clearance).margin(2e-3 * radius));
    CHECK(eq.deepest_penetration < 1e-3 * radius);
    const Equilibrium judged = solve(problem);
    REQUIRE(judged.ok());
    CHECK(judged.points.back().z() == Approx(radius).margin(2e-3 * radius));
  }
}

TEST_CASE("kept clearance: the equilibrium is that on the thickened obstacle") {
  const HalfSpace floor(Vec3::UnitZ(), 0), higher(Vec3::UnitZ(), 0.015);
  const Ball ball({0, 0, -0.2}, 0.1), larger({0, 0, -0.2}, 0.115);
  RodProblem over;
  over.rod = Rod::uniform(1, Section::round(0.02, 0, Material::from_poisson(5e6, 0.49, 1100)), 40);
  over.gravity = {0, 0, -9.81};
  over.holds = {clamp(0, {-0.4, 0, 0}, Vec3::UnitX()), clamp(1, {0.4, 0.01, 0}, Vec3::UnitX())};
  for (const auto& [thin, thick, problem] :
       {std::tuple<const ContactField*, const ContactField*, RodProblem>{&floor, &higher, lying_hose(floor)}, {&ball, &larger, over}}) {
    const Pair field(*thin, 0.015, far_below, 0);
    RodProblem kept = problem, plain = problem;
    kept.surroundings = &field;
    plain.surroundings = thick;
    const Equilibrium a = solve(kept, push());
    REQUIRE(a.ok());
    CHECK(!a.contacts.empty());
    const Equilibrium b = solve(plain, {}, {}, &a);  // a ball has two sides to slide to
    INFO(a.message << "; " << b.message);
    REQUIRE(b.ok());
    CHECK(farthest_apart(a, b) < 1e-4);
    CHECK(a.energy.bend == Approx(b.energy.bend).epsilon(1e-3));
  }
}

TEST_CASE("kept clearance: judged alone it changes nothing, to the last bit") {
  const HalfSpace floor(Vec3::UnitZ(), 0);
  const Pair bare(floor, 0, far_below, 0), asking(floor, 0.02, far_below, 0.1);
  const Equilibrium a = solve(lying_hose(bare)), b = solve(lying_hose(asking));
  REQUIRE(a.ok());
  CHECK(a.iterations == b.iterations);
  CHECK(farthest_apart(a, b) == 0);
}

TEST_CASE("kept clearance: each obstacle keeps its own") {
  // A floor with 5 mm and a wall with 20 mm, into whose corner the hose is let down.
  const HalfSpace floor(Vec3::UnitZ(), 0), wall(Vec3::UnitY(), -0.02);
  const Pair field(floor, 0.005, wall, 0.02);
  RodProblem problem = lying_hose(field);
  problem.holds[0] = clamp(0, {0, 0.06, 0.1}, Vec3(1, -0.25, 0).normalized());
  const double radius = problem.rod.largest_radius();
  const Equilibrium eq = solve(problem, push());
  INFO(eq.message);
  REQUIRE(eq.ok());
  double lowest = 1, nearest = 1;
  for (const auto& sample : eq.sampled(0.002)) {
    lowest = std::min(lowest, sample.frame.at.z() - radius);
    nearest = std::min(nearest, sample.frame.at.y() + 0.02 - radius);
  }
  CHECK(lowest == Approx(0.005).margin(2e-3 * radius));
  CHECK(nearest == Approx(0.02).margin(2e-3 * radius));
  Vec3 carried = Vec3::Zero();
  for (const ContactForce& contact : eq.contacts) carried += contact.force;
  CHECK(carried.z() > 0.3 * problem.rod.mass() * 9.81);
  CHECK(carried.y() > 1e-4);
}

TEST_CASE("kept clearance: it grows smoothly from a held place and lets a rod leave what it is fastened to") {
  const double radius = 0.01;
  CHECK(kept_at(0, radius) == 0);
  CHECK(kept_at(radius, radius) == 0);
  double before = 0, slope_before = 0;
  for (double way = radius; way < 0.3; way += 1e-5) {
    const double now = kept_at(way + 1e-5, radius), slope = (now - before) / 1e-5;
    CHECK(slope >= slope_before - 1e-6);
    CHECK(slope <= 0.5 + 1e-9);
    CHECK(now <= way + 1e-5 - radius);  // what leaves at right angles is free
    before = now;
    slope_before = slope;
  }
  CHECK(slope_before == Approx(0.5));
  CHECK(kept_at(radius + 0.02, radius) == Approx(0.02 * 0.02 / (2 * 8 * radius)));

  // Clamped upright on the floor, and lying on it: both leave a floor that keeps 20 mm.
  const HalfSpace floor(Vec3::UnitZ(), 0);
  const Pair field(floor, 0.02, far_below, 0);
  for (const Vec3& along : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX())}) {
    RodProblem problem = lying_hose(field);
    problem.holds[0] = clamp(0, {0, 0, along.z() > 0 ? 0 : radius}, along);
    problem.rod = Rod::uniform(along.z() > 0 ? 1.2 : 0.6, problem.rod.parts[0].section, 60);
    const Equilibrium eq = solve(problem, push());
    INFO("along " << along.transpose() << ": " << eq.message);
    REQUIRE(eq.ok());
    CHECK(unbalanced(problem, eq).norm() < 1e-6 * problem.rod.mass() * 9.81);
    for (const auto& sample : eq.sampled(0.002))
      if (sample.s > 2 * radius)
        CHECK(sample.frame.at.z() - radius > std::min(0.02, kept_at(sample.s, radius)) - 2e-3 * radius);
  }
}

TEST_CASE("kept clearance: random hoses between a floor and a ball keep both, all along") {
  int solved = 0;
  constexpr int cases = 30;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const HalfSpace floor(Vec3::UnitZ(), -0.2);
    const double size = uniform(0.03, 0.08);
    const Vec3 centre(uniform(-0.15, 0.15), uniform(-0.02, 0.02), -0.2);
    const Ball ball(centre, size);
    const double floor_clearance = uniform(0, 0.03), ball_clearance = uniform(0, 0.03);
    const Pair field(floor, floor_clearance, ball, ball_clearance);
    RodProblem problem;
    const double radius = uniform(0.005, 0.012);
    problem.rod = Rod::uniform(1.1, Section::round(2 * radius, 0, Material::from_poisson(4e6, 0.49, 1100)), 44);
    problem.gravity = {0, 0, -9.81};
    problem.holds = {clamp(0, {-0.4, 0, 0}, Vec3::UnitX()), clamp(1.1, {0.4, uniform(-0.1, 0.1), uniform(-0.05, 0.1)}, Vec3::UnitX())};
    problem.surroundings = &field;
    const Equilibrium eq = solve(problem, push());
    INFO("seed " << seed << ": " << eq.message);
    for (const Vec3& p : eq.points) REQUIRE(all_finite(p));
    if (!eq.ok()) continue;
    ++solved;
    CHECK(unbalanced(problem, eq).norm() < 1e-6 * problem.rod.mass() * 9.81);
    for (const auto& sample : eq.sampled(0.001)) {
      const Vec3& p = sample.frame.at;
      const double allowed = radius * (1 - 2e-3);
      CHECK(p.z() + 0.2 > allowed + floor_clearance);
      CHECK((p - centre).norm() - size > allowed + ball_clearance);
    }
  }
  CHECK(solved >= cases - 1);
}

TEST_CASE("kept clearance: a clearance that cannot be kept is reported with its place") {
  // Between a floor and a ceiling that leave less room than both require together.
  const HalfSpace floor(Vec3::UnitZ(), 0), ceiling(-Vec3::UnitZ(), -0.12);
  const Pair field(floor, 0.08, ceiling, 0.08);
  const RodProblem problem = lying_hose(field);
  const Equilibrium eq = solve(problem, push());
  CHECK(eq.status == Status::stalled);
  INFO(eq.message);
  CHECK(eq.message.find(" mm nearer to the ") != std::string::npos);
  CHECK(eq.message.find("than its clearance at s = ") != std::string::npos);
  CHECK(solve(problem).ok());
}

TEST_CASE("kept clearance: what lies within the clearance alone counts as in reach") {
  const HalfSpace floor(Vec3::UnitZ(), -0.35);
  const Pair field(floor, 0.2, far_below, 0);
  RodProblem problem;
  problem.rod = Rod::uniform(0.5, Section::round(0.02, 0, Material::from_poisson(5e6, 0.49, 1100)), 20);
  problem.gravity = {0, 0, -9.81};
  problem.holds = {clamp(0, {-0.2, 0, 0}, Vec3::UnitX()), clamp(0.5, {0.2, 0, 0}, Vec3::UnitX())};
  problem.surroundings = &field;
  const RodNetwork network({{problem}, {}}, {}, {20});
  CHECK(!can_touch(network));
  CHECK(can_touch(network, ClearanceRule::push));
}
