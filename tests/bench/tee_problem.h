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

/// A harness of several such T pieces side by side, 0.15 m apart, solved as one system.
inline SystemProblem tees(int count, int segments) {
  SystemProblem all;
  for (int i = 0; i < count; ++i) {
    SystemProblem one = tee(segments);
    const Vec3 by(0, 0, 0.15 * i);
    for (RodProblem& hose : one.rods) {
      hose.holds[0].frame.at += by;
      all.rods.push_back(std::move(hose));
    }
    one.branches[0].frame.at += by;
    for (auto& section : one.branches[0].sections) section.rod += 3 * i;
    all.branches.push_back(std::move(one.branches[0]));
  }
  return all;
}

/// Lengths within 50 mm, connections within a cone of 15 degrees, unless others are given (m, degrees).
inline Batch::Fill tee_outcomes(const SystemProblem& nominal, double within_length = 0.05, double within_angle = 15) {
  return [&nominal, within_length, within_angle](int outcome, SystemProblem& problem) {
    std::minstd_rand random(outcome + 1);
    random.discard(8);
    auto within = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    for (std::size_t k = 0; k < problem.rods.size(); ++k) {
      RodProblem& hose = problem.rods[k];
      const double length = 0.5 + within(within_length);
      hose.rod.length = hose.rod.parts[0].upto = length;
      if (k % 3 > 0) hose.holds[0].at = length;
      const double direction = within(units::pi), angle = within_angle * units::pi / 180 * std::sqrt(std::abs(within(1)));
      hose.holds[0].frame.rotation = nominal.rods[k].holds[0].frame.rotation *
                                     exp_rotation({angle * std::cos(direction), angle * std::sin(direction), 0});
    }
    for (std::size_t k = 0; k < problem.branches.size(); ++k)
      problem.branches[k].sections[0].at = problem.rods[3 * k].rod.length;
  };
}

}  // namespace tendril::bench
