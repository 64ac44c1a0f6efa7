// Random rods among random obstacles: what solve() calls solved is an equilibrium outside of everything.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>

#include "contact_surroundings.h"
#include "statics/contact_points.h"
#include "statics/contact_solver.h"
#include "statics/solve.h"

using namespace tendril;
using namespace tendril::test;

namespace {

constexpr int cases = 40;
constexpr std::uint64_t first_seed = 20000;

/// Reactions, contact forces and weight of one rod, in N.
Vec3 unbalanced(const RodProblem& problem, const Equilibrium& eq) {
  Vec3 sum = problem.rod.mass() * problem.gravity;
  for (const ContactForce& contact : eq.contacts) sum += contact.force;
  for (const Reaction& reaction : eq.reactions) sum += reaction.force;
  return sum;
}

}  // namespace

TEST_CASE("contact families: solved, outside, in balance, and solved again after a small move") {
  for (const ContactFamily& family : contact_families(60)) {
    int solved = 0, again = 0;
    std::vector<int> passes;
    for (int k = 0; k < cases; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const ContactCase one = family.make(random, as_surroundings());
      const Equilibrium eq = solve(one.problem);
      INFO(family.name << ", seed " << seed << ": " << eq.message << ", " << eq.iterations << " passes");
      for (const Vec3& p : eq.points) REQUIRE(all_finite(p));
      if (!eq.ok()) continue;
      ++solved;
      passes.push_back(eq.iterations);
      const double radius = one.problem.rod.largest_radius();
      CHECK(eq.deepest_penetration <= largest_solved_overlap * radius);
      CHECK(!one.tunnelled(eq));
      CHECK(eq.stable);
      const double weight = one.problem.rod.mass() * 9.81;
      CHECK(unbalanced(one.problem, eq).norm() < 1e-6 * weight);
      for (const ContactForce& contact : eq.contacts) {
        CHECK(contact.s >= 0);
        CHECK(contact.s <= one.problem.rod.length);
        CHECK(contact.gap >= -largest_solved_overlap * radius);
      }
      RodProblem moved = one.problem;
      moved.holds.back().frame.at += Vec3(0.002, 0.001, -0.001);
      const Equilibrium warm = solve(moved, {}, {}, &eq);
      again += warm.ok();
      if (warm.ok()) CHECK(!one.tunnelled(warm));
    }
    std::sort(passes.begin(), passes.end());
    std::printf("%-22s seeds %d ... %d: solved %d of %d, %d passes in the middle, solved again %d\n", family.name.c_str(),
                int(first_seed), int(first_seed) + cases - 1, solved, cases, passes.empty() ? 0 : passes[passes.size() / 2], again);
    CHECK(solved >= cases - 1);
    CHECK(again >= solved - 1);
  }
}

TEST_CASE("contact families: preformed hoses, sheets three at a line, and the staggered element") {
  std::vector<std::pair<ContactFamily, Element>> families;
  for (const ContactFamily& family : further_contact_families()) families.push_back({family, Element::se3});
  for (const ContactFamily& family : contact_families(40))
    if (family.name == "floor" || family.name == "sphere" || family.name == "box edge")
      families.push_back({{family.name + ", staggered", family.make}, Element::staggered});
  for (const auto& [family, element] : families) {
    SolveOptions options;
    options.element = element;
    int solved = 0;
    for (int k = 0; k < cases; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const ContactCase one = family.make(random, as_surroundings());
      const Equilibrium eq = solve(one.problem, options);
      INFO(family.name << ", seed " << seed << ": " << eq.message << ", " << eq.iterations << " passes");
      for (const Vec3& p : eq.points) REQUIRE(all_finite(p));
      if (!eq.ok()) continue;
      ++solved;
      CHECK(eq.deepest_penetration <= largest_solved_overlap * one.problem.rod.largest_radius());
      CHECK(!one.tunnelled(eq));
      CHECK(unbalanced(one.problem, eq).norm() < 1e-6 * one.problem.rod.mass() * 9.81);
    }
    std::printf("%-22s seeds %d ... %d: solved %d of %d\n", family.name.c_str(), int(first_seed), int(first_seed) + cases - 1,
                solved, cases);
    CHECK(solved >= cases - 1);
  }
}

TEST_CASE("contact families: what touches between two contact points that are both clear of it is carried too") {
  // An obtuse ridge, and a ball under a thick hose: no edge that a sliding point would follow, no point within a radius.
  for (const auto& [name, seed] : {std::pair{"clamps force contact", 777279}, {"clamps force contact", 777310}, {"sphere", 777493}})
    for (const ContactFamily& family : contact_families(12)) {
      if (family.name != name) continue;
      std::mt19937_64 random(seed);
      const ContactCase one = family.make(random, as_surroundings());
      const Equilibrium eq = solve(one.problem);
      RodProblem moved = one.problem;
      moved.holds.back().frame.at += Vec3(0.002, 0.001, -0.001);
      const Equilibrium again = solve(moved, {}, {}, &eq);
      INFO(name << ", seed " << seed << ": " << eq.message << "; " << again.message);
      REQUIRE(eq.ok());
      REQUIRE(again.ok());
      for (const Equilibrium* found : {&eq, &again}) {
        CHECK(found->deepest_penetration <= largest_solved_overlap * one.problem.rod.largest_radius());
        CHECK(!one.tunnelled(*found));
      }
      CHECK(unbalanced(moved, again).norm() < 1e-6 * moved.rod.mass() * 9.81);
    }
}

TEST_CASE("contact families: harnesses of three rods at a free branch point") {
  for (const HarnessFamily& family : harness_families(60)) {
    int solved = 0, touching = 0, again = 0;
    std::vector<int> passes;
    for (int k = 0; k < cases; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const HarnessCase one = family.make(random, as_surroundings());
      const SystemEquilibrium eq = solve(one.problem);
      INFO(family.name << ", seed " << seed << ": " << eq.rods[0].message << ", " << eq.rods[0].iterations << " passes");
      for (const Equilibrium& rod : eq.rods)
        for (const Vec3& p : rod.points) REQUIRE(all_finite(p));
      if (!eq.rods[0].ok()) continue;
      ++solved;
      passes.push_back(eq.rods[0].iterations);
      // What the branch point passes on from rod to rod cancels: only the sum over all rods balances.
      Vec3 sum = Vec3::Zero();
      double weight = 0;
      bool touches = false;
      for (std::size_t r = 0; r < eq.rods.size(); ++r) {
        const RodProblem& problem = one.problem.rods[r];
        sum += unbalanced(problem, eq.rods[r]);
        weight += problem.rod.mass() * 9.81;
        CHECK(eq.rods[r].deepest_penetration <= largest_solved_overlap * problem.rod.largest_radius());
        CHECK(!one.tunnelled(eq.rods[r]));
        touches = touches || !eq.rods[r].contacts.empty();
      }
      touching += touches;
      CHECK(sum.norm() < 1e-6 * weight);
      CHECK(eq.rods[0].stable);
      for (const Equilibrium& rod : eq.rods) CHECK((rod.points.back() - eq.branches[0].at).norm() < 1e-9);
      SystemProblem moved = one.problem;
      moved.rods[0].holds[0].frame.at += Vec3(0.002, 0.001, -0.001);
      const SystemEquilibrium warm = solve(moved, {}, {}, &eq);
      again += warm.rods[0].ok();
    }
    std::sort(passes.begin(), passes.end());
    std::printf("%-22s seeds %d ... %d: solved %d of %d, %d touch, %d passes in the middle, solved again %d\n", family.name.c_str(),
                int(first_seed), int(first_seed) + cases - 1, solved, cases, touching, passes.empty() ? 0 : passes[passes.size() / 2],
                again);
    CHECK(solved >= cases - 1);
    CHECK(touching > cases / 2);
    CHECK(again >= solved - 1);
  }
}

TEST_CASE("contact families: the tree's field and the sum over every triangle give the same equilibrium") {
  for (const ContactFamily& family : contact_families(12)) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      std::mt19937_64 random(seed), same(seed);
      const ContactCase tree = family.make(random, as_surroundings());
      const ContactCase all = family.make(same, every_triangle());
      const Equilibrium a = solve(tree.problem), b = solve(all.problem);
      INFO(family.name << ", seed " << seed << ": " << a.message << "; " << b.message);
      REQUIRE(a.ok() == b.ok());
      if (!a.ok()) continue;
      // Rounding may lead the two to different places on a flat stretch of energy, but not to different energies.
      CHECK(std::abs(a.energy.total() - b.energy.total()) < 1e-4 * (std::abs(a.energy.bend) + std::abs(a.energy.gravity)));
    }
  }
}

TEST_CASE("contact families: kept clearances, on systems, preformed rods and sheets three at a line too") {
  constexpr double kept = 0.008;
  SolveOptions options;
  options.clearance = ClearanceRule::push;
  // Less than what is kept, in radii: nowhere but within a few radii of a hold, where the clearance grows.
  const auto shortfall = [&](const RodProblem& problem, const Equilibrium& eq, const std::vector<double>& held) {
    const double radius = problem.rod.largest_radius();
    double worst = -1;
    for (const auto& sample : eq.sampled(0.002)) {
      double way = INFINITY;
      for (const double at : held) way = std::min(way, std::abs(sample.s - at));
      if (way < 2 * radius) continue;
      const double gap = problem.surroundings->closest(sample.frame.at, 1).distance - radius;
      worst = std::max(worst, (std::min(kept, kept_at(way, radius)) - gap) / radius);
    }
    return worst;
  };
  std::vector<ContactFamily> families = further_contact_families();
  for (const ContactFamily& family : contact_families(40))
    if (family.name == "floor" || family.name == "box edge" || family.name == "V-groove" || family.name == "terrain" ||
        family.name == "corner")
      families.push_back(family);
  for (const ContactFamily& family : families) {
    int solved = 0;
    for (int k = 0; k < cases; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const ContactCase one = family.make(random, as_surroundings(kept));
      const Equilibrium eq = solve(one.problem, options);
      INFO(family.name << ", seed " << seed << ": " << eq.message << ", " << eq.iterations << " passes");
      for (const Vec3& p : eq.points) REQUIRE(all_finite(p));
      if (!eq.ok()) continue;
      ++solved;
      std::vector<double> held;
      for (const Hold& hold : one.problem.holds) held.push_back(hold.at);
      CHECK(shortfall(one.problem, eq, held) < 2e-3);
      CHECK(!one.tunnelled(eq));
      CHECK(unbalanced(one.problem, eq).norm() < 1e-6 * one.problem.rod.mass() * 9.81);
    }
    std::printf("%-22s 8 mm kept, seeds %d ... %d: solved %d of %d\n", family.name.c_str(), int(first_seed),
                int(first_seed) + cases - 1, solved, cases);
    CHECK(solved >= cases - 1);
  }
  for (const HarnessFamily& family : harness_families(40)) {
    int solved = 0;
    for (int k = 0; k < cases; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const HarnessCase one = family.make(random, as_surroundings(kept));
      const SystemEquilibrium eq = solve(one.problem, options);
      INFO(family.name << ", seed " << seed << ": " << eq.rods[0].message << ", " << eq.rods[0].iterations << " passes");
      if (!eq.ok()) continue;
      ++solved;
      for (std::size_t r = 0; r < eq.rods.size(); ++r) {
        CHECK(shortfall(one.problem.rods[r], eq.rods[r], {0.0}) < 2e-3);
        CHECK(!one.tunnelled(eq.rods[r]));
      }
    }
    std::printf("%-22s 8 mm kept, seeds %d ... %d: solved %d of %d\n", family.name.c_str(), int(first_seed),
                int(first_seed) + cases - 1, solved, cases);
    CHECK(solved >= cases - 1);
  }
}

TEST_CASE("contact families: a start across a sheet is led around it or reported with its place, never solved through it") {
  constexpr int starts = 60;
  for (const ContactFamily& family : crossing_families()) {
    int freed = 0, freed_warm = 0;
    for (int k = 0; k < starts; ++k) {
      const std::uint64_t seed = first_seed + k;
      std::mt19937_64 random(seed);
      const ContactCase one = family.make(random, as_surroundings());
      RodProblem without = one.problem;
      without.surroundings = nullptr;
      const Equilibrium bare = solve(without);
      for (const Equilibrium* from : {static_cast<const Equilibrium*>(nullptr), &bare}) {
        const Equilibrium eq = solve(one.problem, {}, {}, from);
        INFO(family.name << ", seed " << seed << (from ? ", from an equilibrium: " : ": ") << eq.message);
        for (const Vec3& p : eq.points) REQUIRE(all_finite(p));
        const bool crosses = one.tunnelled(eq);
        if (eq.ok()) {
          CHECK(!crosses);
          CHECK(unbalanced(one.problem, eq).norm() < 1e-6 * one.problem.rod.mass() * 9.81);
          ++(from ? freed_warm : freed);
        } else if (crosses) {
          CHECK(eq.message.find(" obstacle 'sheet' ") != std::string::npos);
          CHECK(eq.message.find(" at s = ") != std::string::npos);
          CHECK(eq.status == Status::stalled);
        }
      }
    }
    std::printf("%-30s seeds %d ... %d: free %d of %d, from an equilibrium %d\n", family.name.c_str(), int(first_seed),
                int(first_seed) + starts - 1, freed, starts, freed_warm);
    CHECK(freed >= 0.85 * starts);
    CHECK(freed_warm >= 0.85 * starts);
  }
}
