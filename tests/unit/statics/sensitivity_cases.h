// Random systems of rods, all their parameters and measures, and what a change of a parameter makes of a problem.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "statics/measure.h"
#include "statics/network_solver.h"
#include "statics/parameter.h"

namespace tendril::sensitivity_cases {

/// One rod between random frames, with holds and loads inside, some of several parts, some preformed.
SystemProblem random_rod(std::mt19937& random);

/// Three rods that meet at a branch point with turned and shifted sections.
SystemProblem random_tee(std::mt19937& random);

/// Everything that a parameter can be in this problem.
std::vector<Parameter> parameters_of(const SystemProblem& problem);
std::string name_of(const Parameter& parameter);
/// A step that changes the problem noticeably, without leaving the linear range far behind.
double step_of(const Parameter& parameter, const SystemProblem& problem);

/// Every kind of measure, at random places and in random directions.
std::vector<Measure> measures_of(const SystemProblem& problem, std::mt19937& random);
std::string name_of(const Measure& measure);

/// A solved problem: Newton's method run until only rounding is left. `from`: a state near the solution.
struct Solved {
  NetworkSolver solver;
  RodState state;
  bool ok = false;
  explicit Solved(const SystemProblem& problem, const RodState* from = nullptr);
};

}  // namespace tendril::sensitivity_cases
