#include "statics/problem.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril {
namespace {

void check_place(const char* what, double at, double length) {
  if (!(at >= -1e-9 * length && at <= length * (1 + 1e-9)))
    throw UsageError(std::string(what) + " at arc length " + number_text(at) + " m lies outside the rod (0 to " + number_text(length) +
                     " m)");
}

void check_holds(const RodProblem& problem, bool held_elsewhere) {
  const double length = problem.rod.length;
  bool position = false;
  for (std::size_t k = 0; k < problem.holds.size(); ++k) {
    const Hold& hold = problem.holds[k];
    check_place("hold", hold.at, length);
    if (!all_finite(hold.frame.at) || !all_finite(hold.frame.rotation.coeffs()) || !std::isfinite(hold.turns))
      throw UsageError("hold at " + number_text(hold.at) + " m: its frame and turns must be finite numbers");
    position |= hold.position;
    for (std::size_t j = 0; j < k; ++j) {
      const Hold& other = problem.holds[j];
      if (std::abs(other.at - hold.at) > 1e-9 * length) continue;
      if ((other.position && hold.position) || (other.orientation && hold.orientation))
        throw UsageError("two holds at arc length " + number_text(hold.at) +
                         " m contradict each other; hold a place once, or its position and orientation apart");
    }
  }
  if (!position && !held_elsewhere)
    throw UsageError("the rod is not held at any place, so it would fall; give it a 'from' or a 'to' frame or a hold");
}

void check_branch(const SystemProblem& problem, int number) {
  const BranchPoint& branch = problem.branches[number];
  const std::string who = "branch point " + std::to_string(number + 1);
  if (branch.sections.empty()) throw UsageError(who + " joins no rod");
  if (!all_finite(branch.frame.at) || !all_finite(branch.frame.rotation.coeffs()))
    throw UsageError(who + ": its frame must be finite numbers");
  for (const JoinedSection& section : branch.sections) {
    if (section.rod < 0 || section.rod >= static_cast<int>(problem.rods.size()))
      throw UsageError(who + " joins rod " + std::to_string(section.rod + 1) + " of " + std::to_string(problem.rods.size()));
    const RodProblem& rod = problem.rods[section.rod];
    const double same = 1e-9 * rod.rod.length;
    check_place("branch point", section.at, rod.rod.length);
    if (!all_finite(section.relative.at) || !all_finite(section.relative.rotation.coeffs()))
      throw UsageError(who + ": the relative frame of a joined section must be finite numbers");
    for (const Hold& hold : rod.holds)
      if (std::abs(hold.at - section.at) <= same)
        throw UsageError(who + " joins a section at " + number_text(section.at) +
                         " m that is held as well; hold the branch point instead");
    int times = 0;
    for (const BranchPoint& other : problem.branches)
      for (const JoinedSection& joined : other.sections)
        times += joined.rod == section.rod && std::abs(joined.at - section.at) <= same;
    if (times > 1) throw UsageError(who + " joins a section at " + number_text(section.at) + " m that is joined twice");
  }
}

/// Rods that hang together, by the number of their group.
std::vector<int> groups_of(const SystemProblem& problem) {
  std::vector<int> group(problem.rods.size());
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = static_cast<int>(k);
  const auto root = [&](int k) {
    while (group[k] != k) k = group[k] = group[group[k]];
    return k;
  };
  for (const BranchPoint& branch : problem.branches)
    for (const JoinedSection& section : branch.sections) group[root(section.rod)] = root(branch.sections.front().rod);
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = root(static_cast<int>(k));
  return group;
}

}  // namespace

void RodProblem::check(bool held_elsewhere) const {
  rod.check();
  if (!all_finite(gravity)) throw UsageError("gravity must be three finite numbers (m/s^2)");
  check_holds(*this, held_elsewhere);
  for (const PointLoad& load : loads) {
    check_place("load", load.at, rod.length);
    if (!all_finite(load.force) || !all_finite(load.moment))
      throw UsageError("load at " + number_text(load.at) + " m: force and moment must be finite numbers");
  }
  for (const PoseSpring& spring : springs) {
    check_place("spring", spring.at, rod.length);
    if (!all_finite(spring.frame.at) || !all_finite(spring.frame.rotation.coeffs()) || !std::isfinite(spring.position) ||
        !std::isfinite(spring.rotation) || spring.position < 0 || spring.rotation < 0)
      throw UsageError("spring at " + number_text(spring.at) + " m: frame and stiffnesses must be finite numbers, stiffnesses at least 0");
  }
  for (const Fastening& one : fastenings) {
    if (one.hold < 0 || one.hold >= static_cast<int>(holds.size()))
      throw UsageError("fastening: names hold " + std::to_string(one.hold) + " of " + std::to_string(holds.size()));
    if (one.obstacle < 0 || !std::isfinite(one.reach) || one.reach < 0)
      throw UsageError("fastening: obstacle " + std::to_string(one.obstacle) + " within " + number_text(one.reach) +
                       " m, expected two numbers of at least 0");
  }
  double softest = INFINITY;
  for (const RodPart& part : rod.parts) softest = std::min(softest, part.section.EA);
  const double weight = rod.mass() * gravity.norm();
  if (weight > softest)
    throw UsageError("the rod weighs " + number_text(weight) + " N but its stretch stiffness EA is only " + number_text(softest) +
                     " N: it would more than double its length; check young, EA, density and the units");
}

void SystemProblem::check() const {
  if (rods.empty()) throw UsageError("there is no rod to solve");
  for (const RodProblem& rod : rods) rod.check(!branches.empty());
  if (branches.empty()) return;
  for (int b = 0; b < static_cast<int>(branches.size()); ++b) check_branch(*this, b);
  const std::vector<int> group = groups_of(*this);
  std::vector<char> held(rods.size(), 0);
  for (std::size_t k = 0; k < rods.size(); ++k)
    for (const Hold& hold : rods[k].holds) held[group[k]] |= hold.position;
  for (const BranchPoint& branch : branches) held[group[branch.sections.front().rod]] |= branch.position;
  for (std::size_t k = 0; k < rods.size(); ++k)
    if (!held[group[k]])
      throw UsageError("rod " + std::to_string(k + 1) + " and what hangs together with it is not held at any place, so it would "
                       "fall; hold a rod or a branch point");
}

}  // namespace tendril
