#include "sensitivity_cases.h"

#include <cmath>

namespace tendril::sensitivity_cases {
namespace {

using Kind = Parameter::Kind;
using What = Measure::What;

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Section random_section(std::mt19937& random) {
  return Section::round(between(random, 0.012, 0.02), between(random, 0.0, 0.008), Material::from_poisson(5e6, 0.4, 1100));
}

/// A helix: curvature and torsion everywhere.
Frame helix(double s) {
  const double radius = 0.3, pitch = 0.1, c = std::hypot(radius, pitch), a = s / c;
  Frame frame;
  frame.at = {radius * std::cos(a), radius * std::sin(a), pitch * a};
  const Vec3 tangent(-radius / c * std::sin(a), radius / c * std::cos(a), pitch / c), inward(-std::cos(a), -std::sin(a), 0);
  Mat3 axes;
  axes << inward, tangent.cross(inward), tangent;
  frame.rotation = Quat(axes);
  return frame;
}

Frame jolted(const Frame& frame, std::mt19937& random, double way, double angle) {
  return {frame.at + way * random_vector(random), frame.rotation * exp_rotation(angle * random_vector(random))};
}

}  // namespace

SystemProblem random_rod(std::mt19937& random) {
  RodProblem rod;
  const double length = between(random, 0.6, 1.2);
  rod.rod = Rod::uniform(length, random_section(random), 16);
  const int kind = std::uniform_int_distribution<int>(0, 4)(random);
  if (kind == 1) rod.rod.parts = {{0.4 * length, random_section(random)}, {length, random_section(random)}};
  if (kind == 2) rod.rod.shape = helix;
  if (kind == 3) {  // two different stiffnesses
    rod.rod.parts[0].section.EI2 *= 3;
    rod.rod.parts[0].section.GA2 *= 0.7;
  }
  const Frame start = jolted({}, random, 0.1, 0.5);
  // Where the unstressed rod would be, jolted and pushed together.
  const auto unstressed = [&](double s) {
    return kind == 2 ? start * (helix(0).inverse() * helix(s)) : start * Frame{{0, 0, s}, Quat::Identity()};
  };
  rod.holds.push_back({0, start});
  Frame finish = jolted(unstressed(length), random, 0.03, 0.4);
  finish.at += 0.15 * (start.at - finish.at);
  const int end = std::uniform_int_distribution<int>(0, 3)(random);
  if (end > 0) rod.holds.push_back({length, finish, end != 2, end != 3});
  if (std::bernoulli_distribution(0.5)(random)) {
    const double at = between(random, 0.35, 0.6) * length;
    rod.holds.push_back({at, jolted(unstressed(at), random, 0.02, 0.2), true, std::bernoulli_distribution(0.5)(random)});
  }
  if (std::bernoulli_distribution(0.6)(random))
    rod.loads.push_back({between(random, 0.65, 0.9) * length, 0.3 * random_vector(random), 0.01 * random_vector(random)});
  if (end == 0) rod.loads.push_back({length, 0.05 * random_vector(random), 0.004 * random_vector(random)});
  rod.gravity = {0.5, -0.3, -9.81};
  return {{rod}, {}};
}

SystemProblem random_tee(std::mt19937& random) {
  SystemProblem problem;
  BranchPoint tee;
  for (int k = 0; k < 3; ++k) {
    RodProblem rod;
    const double length = between(random, 0.3, 0.6);
    rod.rod = Rod::uniform(length, random_section(random), 8);
    rod.gravity = {0, 0, -9.81};
    const Frame outward = Frame::looking(Vec3::Zero(), Vec3(std::cos(2.1 * k), std::sin(2.1 * k), 0.1 * k), Vec3::UnitZ());
    const bool joined_at_start = k != 1;
    const Frame there = jolted(outward * Frame{{0, 0, 0.9 * length}, Quat::Identity()}, random, 0.03, 0.2);
    const Frame relative = jolted(outward, random, 0.02, 0.1);
    const Frame backwards{relative.at, relative.rotation * exp_rotation({0, 3.141592653589793, 0})};
    if (joined_at_start) {
      rod.holds.push_back({length, there});
      tee.sections.push_back({k, 0, relative});
    } else {
      rod.holds.push_back({0, {there.at, there.rotation * exp_rotation({0, 3.141592653589793, 0})}});
      tee.sections.push_back({k, length, backwards});
    }
    if (k == 2) rod.loads.push_back({0, 0.1 * random_vector(random), 0.005 * random_vector(random)});
    problem.rods.push_back(rod);
  }
  tee.frame = jolted({}, random, 0.01, 0.1);
  const int held = std::uniform_int_distribution<int>(0, 3)(random);
  tee.position = held & 1;
  tee.orientation = held & 2;
  problem.branches.push_back(tee);
  return problem;
}

std::vector<Parameter> parameters_of(const SystemProblem& problem) {
  std::vector<Parameter> all;
  for (int c = 0; c < 3; ++c) all.push_back({Kind::gravity, 0, 0, 0, c});
  for (int k = 0; k < static_cast<int>(problem.rods.size()); ++k) {
    const RodProblem& rod = problem.rods[k];
    all.push_back({Kind::length, k});
    const Section& section = rod.rod.parts[0].section;
    for (const Kind kind : {Kind::EA, Kind::GA1, Kind::GA2, Kind::GA, Kind::EI1, Kind::EI2, Kind::EI, Kind::GJ, Kind::stiffness,
                            Kind::mass, Kind::density})
      all.push_back({kind, k, 0, 0, 0, rod.rod.parts.size() > 1 ? 1 : -1});
    if (section.EI1 == section.EI2)
      for (const Kind kind : {Kind::young, Kind::outer, Kind::inner}) all.push_back({kind, k, 0, 0, 0, 0});
    for (int j = 0; j < static_cast<int>(rod.holds.size()); ++j) {
      for (int c = 0; c < 3; ++c) {
        all.push_back({Kind::hold_position, k, j, 0, c});
        all.push_back({Kind::hold_orientation, k, j, 0, c});
      }
      if (rod.holds[j].at > 0 && rod.holds[j].at < rod.rod.length) all.push_back({Kind::hold_place, k, j});
    }
    for (int j = 0; j < static_cast<int>(rod.loads.size()); ++j) {
      for (int c = 0; c < 3; ++c) {
        all.push_back({Kind::load_force, k, j, 0, c});
        all.push_back({Kind::load_moment, k, j, 0, c});
      }
      if (rod.loads[j].at > 0 && rod.loads[j].at < rod.rod.length) all.push_back({Kind::load_place, k, j});
    }
  }
  for (int b = 0; b < static_cast<int>(problem.branches.size()); ++b)
    for (int c = 0; c < 3; ++c) {
      all.push_back({Kind::branch_position, 0, b, 0, c});
      all.push_back({Kind::branch_orientation, 0, b, 0, c});
      for (int s = 0; s < static_cast<int>(problem.branches[b].sections.size()); ++s) {
        all.push_back({Kind::joint_position, 0, b, s, c});
        all.push_back({Kind::joint_orientation, 0, b, s, c});
      }
    }
  return all;
}

std::string name_of(const Parameter& p) {
  static const char* const kinds[] = {"length", "EA", "GA1", "GA2", "GA", "EI1", "EI2", "EI", "GJ", "stiffness", "mass", "density",
                                      "outer", "inner", "young", "gravity", "hold_position", "hold_orientation", "hold_place",
                                      "load_force", "load_moment", "load_place", "branch_position", "branch_orientation",
                                      "joint_position", "joint_orientation", "joint_place"};
  return std::string(kinds[static_cast<int>(p.kind)]) + " rod " + std::to_string(p.rod) + " index " + std::to_string(p.index) +
         " section " + std::to_string(p.section) + " component " + std::to_string(p.component) + " part " + std::to_string(p.part);
}

double step_of(const Parameter& p, const SystemProblem& problem) {
  const Section& section = problem.rods[p.rod].rod.parts[std::max(p.part, 0)].section;
  switch (p.kind) {
    case Kind::EA: return 1e-2 * section.EA;
    case Kind::GA1: return 1e-2 * section.GA1;
    case Kind::GA2: case Kind::GA: return 1e-2 * section.GA2;
    case Kind::EI1: case Kind::EI: return 3e-4 * section.EI1;
    case Kind::EI2: return 3e-4 * section.EI2;
    case Kind::GJ: return 3e-4 * section.GJ;
    case Kind::mass: return 1e-3 * section.mass;
    case Kind::outer: case Kind::inner: return 1e-6;
    case Kind::young: return 5e3;
    case Kind::gravity: return 1e-2;
    case Kind::load_force: return 1e-4;
    case Kind::load_moment: return 1e-5;
    case Kind::stiffness: case Kind::density: return 1e-3;
    default: return 2e-5;
  }
}

std::vector<Measure> measures_of(const SystemProblem& problem, std::mt19937& random) {
  std::vector<Measure> all;
  const int rod = std::uniform_int_distribution<int>(0, static_cast<int>(problem.rods.size()) - 1)(random);
  const double length = problem.rods[rod].rod.length;
  for (int w = 0; w < static_cast<int>(What::functional); ++w) {
    Measure m;
    m.what = static_cast<What>(w);
    m.rod = rod;
    m.at = between(random, 0.05, 0.95) * length;
    m.along = random_vector(random).normalized();
    const Hold& hold = problem.rods[rod].holds[0];
    if (m.what == What::reaction_force && !hold.position) continue;
    if (m.what == What::reaction_moment && !hold.orientation) continue;
    if (m.what == What::branch_position && problem.branches.empty()) continue;
    if (m.what == What::branch_force && (problem.branches.empty() || !problem.branches[0].position)) continue;
    if (m.what == What::branch_moment && (problem.branches.empty() || !problem.branches[0].orientation)) continue;
    if (m.what == What::rotation) continue;  // its value stays zero: checked by its own test
    all.push_back(m);
    if (m.what == What::position || m.what == What::tangent) {
      m.at = length;
      all.push_back(m);
    }
  }
  return all;
}

std::string name_of(const Measure& m) {
  static const char* const whats[] = {"position", "rotation", "tangent", "force", "moment", "tension", "twist", "bend_radius",
                                      "reaction_force", "reaction_moment", "branch_force", "branch_moment", "branch_position",
                                      "min_bend_radius", "max_tension", "max_strain", "length", "gap", "bend", "twist_energy",
                                      "stretch", "shear", "gravity", "load", "energy", "functional"};
  return std::string(whats[static_cast<int>(m.what)]) + " rod " + std::to_string(m.rod) + " at " + std::to_string(m.at);
}

namespace {

SolveOptions exact() {
  SolveOptions options;
  options.tolerance = 1e-13;
  options.stable_only = false;
  return options;
}

}  // namespace

Solved::Solved(const SystemProblem& problem, const RodState* from) : solver(problem, exact()) {
  state = from ? *from : solver.starting_state(nullptr);
  ok = solver.iterate(state, from != nullptr, {}).status == Status::solved;
  if (ok) ok = solver.iterate(state, true, {}).status == Status::solved;  // down to rounding
}

}  // namespace tendril::sensitivity_cases
