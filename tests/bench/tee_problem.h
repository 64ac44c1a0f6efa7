// Three coolant hoses that meet in a T, and its outcomes: what several benchmarks run on.
#pragma once

#include <cmath>
#include <random>

#include "base/units.h"
#include "statics/batch.h"

namespace tendril::bench {

/// Hoses of 26 mm over 18 mm, half a metre each, from three connections to the T, whose third arm is square to the others.
inline SystemProblem tee(int segments) {
  const Section section = Section::round(0.026, 0.018, Material::from_poisson(5e6, 0.5, 1150));
  SystemProblem system;
  RodProblem hose;
  hose.rod = Rod::uniform(0.5, section, segments);
  hose.gravity = {0, 0, -9.81};
  system.rods.assign(3, hose);
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  system.rods[0].holds = {{0, start}};
  system.rods[1].holds = {{0.5, start.moved({0.86, 0.10, 0.10})}};
  system.rods[2].holds = {{0.5, Frame::looking({0.42, 0.50, -0.15}, {0, 1, 0}, {0, 0, 1})}};
  BranchPoint branch;
  branch.frame = start.moved({0.45, 0, -0.03});
  branch.sections = {{0, 0.5, {{0, 0, -0.015}, Quat::Identity()}},
                     {1, 0, {{0, 0, 0.015}, Quat::Identity()}},
                     {2, 0, {{0, 0.015, 0}, exp_rotation({-0.5 * units::pi, 0, 0})}}};
  system.branches = {branch};
  return system;
}

/// Lengths within 50 mm, connections within a cone of 15 degrees.
inline Batch::Fill tee_outcomes(const SystemProblem& nominal) {
  return [&nominal](int outcome, SystemProblem& problem) {
    std::minstd_rand random(outcome + 1);
    random.discard(8);
    auto within = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    for (int k = 0; k < 3; ++k) {
      RodProblem& hose = problem.rods[k];
      const double length = 0.5 + within(0.05);
      hose.rod.length = hose.rod.parts[0].upto = length;
      if (k > 0) hose.holds[0].at = length;
      const double direction = within(units::pi), angle = 15 * units::pi / 180 * std::sqrt(std::abs(within(1)));
      hose.holds[0].frame.rotation = nominal.rods[k].holds[0].frame.rotation *
                                     exp_rotation({angle * std::cos(direction), angle * std::sin(direction), 0});
    }
    problem.branches[0].sections[0].at = problem.rods[0].rod.length;
  };
}

}  // namespace tendril::bench
