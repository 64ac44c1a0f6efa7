// Problems with a parameter changed by a finite amount.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "statics/parameter.h"

namespace tendril {
namespace {

using Kind = Parameter::Kind;

void scale_stiffness(Section& s, double factor) {
  for (double* k : {&s.EA, &s.GA1, &s.GA2, &s.EI1, &s.EI2, &s.GJ}) *k *= factor;
}

/// Other diameters of the same material: areas go with the square, second moments with the fourth power.
void change_diameters(Section& s, double outer, double inner) {
  const auto square = [](double x) { return x * x; };
  const double area = (square(outer) - square(inner)) / (square(s.outer) - square(s.inner));
  const double moment = area * (square(outer) + square(inner)) / (square(s.outer) + square(s.inner));
  for (double* k : {&s.EA, &s.GA1, &s.GA2, &s.mass}) *k *= area;
  for (double* k : {&s.EI1, &s.EI2, &s.GJ}) *k *= moment;
  s.outer = outer;
  s.inner = inner;
}

void change_section(Section& s, Kind kind, double by) {
  switch (kind) {
    case Kind::EA: s.EA += by; break;
    case Kind::GA1: s.GA1 += by; break;
    case Kind::GA2: s.GA2 += by; break;
    case Kind::GA: s.GA1 += by; s.GA2 += by; break;
    case Kind::EI1: s.EI1 += by; break;
    case Kind::EI2: s.EI2 += by; break;
    case Kind::EI: s.EI1 += by; s.EI2 += by; break;
    case Kind::GJ: s.GJ += by; break;
    case Kind::mass: s.mass += by; break;
    case Kind::density: s.mass *= 1 + by; break;
    case Kind::stiffness: scale_stiffness(s, 1 + by); break;
    case Kind::young: scale_stiffness(s, 1 + by / young_of(s, "young")); break;
    case Kind::outer:
      young_of(s, "outer");
      change_diameters(s, s.outer + by, s.inner);
      break;
    case Kind::inner:
      young_of(s, "inner");
      change_diameters(s, s.outer, s.inner + by);
      break;
    default: break;
  }
}

/// Sections keep their share of the length, what stands at the finish stays there.
void change_length(SystemProblem& problem, int index, double by) {
  RodProblem& rod = problem.rods[index];
  const double before = rod.rod.length, after = before + by;
  const auto carry = [&](double& at) {
    if (std::abs(at - before) <= 1e-9 * before) at = after;
  };
  for (RodPart& part : rod.rod.parts) part.upto *= after / before;
  rod.rod.parts.back().upto = rod.rod.length = after;
  for (Hold& hold : rod.holds) carry(hold.at);
  for (PointLoad& load : rod.loads) carry(load.at);
  for (BranchPoint& branch : problem.branches)
    for (JoinedSection& section : branch.sections)
      if (section.rod == index) carry(section.at);
}

template <class List>
auto& entry(List& list, int index, const char* what) {
  if (index < 0 || index >= static_cast<int>(list.size()))
    throw UsageError("sensitivity: got " + std::string(what) + " " + std::to_string(index) + ", expected one of " +
                     std::to_string(list.size()));
  return list[index];
}

bool of_branch(Kind kind) {
  return kind == Kind::branch_position || kind == Kind::branch_orientation || kind == Kind::joint_position ||
         kind == Kind::joint_orientation || kind == Kind::joint_place;
}

void change_branch(SystemProblem& problem, const Parameter& p, double by) {
  BranchPoint& branch = entry(problem.branches, p.index, "branch point");
  const Vec3 shift = by * Vec3::Unit(p.component);
  if (p.kind == Kind::branch_position) branch.frame.at += shift;
  if (p.kind == Kind::branch_orientation) branch.frame.rotation = exp_rotation(shift) * branch.frame.rotation;
  if (p.kind == Kind::branch_position || p.kind == Kind::branch_orientation) return;
  JoinedSection& section = entry(branch.sections, p.section, "section");
  if (p.kind == Kind::joint_position) section.relative.at += shift;
  if (p.kind == Kind::joint_orientation) section.relative.rotation = section.relative.rotation * exp_rotation(shift);
  if (p.kind == Kind::joint_place) section.at += by;
}

}  // namespace

void change(SystemProblem& out, const Parameter& p, double by) {
  if (p.component < 0 || p.component > 2)
    throw UsageError("sensitivity: got component " + std::to_string(p.component) + ", expected one of 3");
  const Vec3 shift = by * Vec3::Unit(p.component);
  if (p.kind == Kind::gravity) {
    for (RodProblem& rod : out.rods) rod.gravity += shift;
    return;
  }
  if (of_branch(p.kind)) {
    change_branch(out, p, by);
    return;
  }
  RodProblem& rod = entry(out.rods, p.rod, "rod");
  switch (p.kind) {
    case Kind::length: change_length(out, p.rod, by); break;
    case Kind::hold_position: entry(rod.holds, p.index, "hold").frame.at += shift; break;
    case Kind::hold_orientation: {
      Quat& q = entry(rod.holds, p.index, "hold").frame.rotation;
      q = exp_rotation(shift) * q;
      break;
    }
    case Kind::hold_place: entry(rod.holds, p.index, "hold").at += by; break;
    case Kind::load_force: entry(rod.loads, p.index, "load").force += shift; break;
    case Kind::load_moment: entry(rod.loads, p.index, "load").moment += shift; break;
    case Kind::load_place: entry(rod.loads, p.index, "load").at += by; break;
    default:
      if (p.part >= 0) entry(rod.rod.parts, p.part, "part");
      for (std::size_t k = 0; k < rod.rod.parts.size(); ++k)
        if (p.part < 0 || p.part == static_cast<int>(k)) change_section(rod.rod.parts[k].section, p.kind, by);
  }
}

SystemProblem changed(const SystemProblem& problem, const Parameter& p, double by) {
  SystemProblem out = problem;
  change(out, p, by);
  return out;
}

double small_step(const SystemProblem& problem, const Parameter& p) {
  constexpr double relative = 1e-4;
  double shortest = INFINITY;
  for (const RodProblem& rod : problem.rods) shortest = std::min(shortest, rod.rod.length);
  if (p.kind == Kind::gravity) return relative * std::max(1.0, problem.rods.front().gravity.norm());
  if (of_branch(p.kind)) return relative * (std::string_view(unit_of(p.kind)) == "m" ? shortest : 1);
  const RodProblem& rod = entry(problem.rods, p.rod, "rod");
  const Section& s = rod.rod.parts[std::clamp<int>(p.part, 0, static_cast<int>(rod.rod.parts.size()) - 1)].section;
  const double bend = std::min(s.EI1, s.EI2) / (rod.rod.length * rod.rod.length);
  switch (p.kind) {
    case Kind::EA: return relative * s.EA;
    case Kind::GA1: case Kind::GA2: case Kind::GA: return relative * std::min(s.GA1, s.GA2);
    case Kind::EI1: case Kind::EI2: case Kind::EI: return relative * std::min(s.EI1, s.EI2);
    case Kind::GJ: return relative * s.GJ;
    case Kind::mass: return relative * std::max(s.mass, 1e-3);
    case Kind::young: return relative * young_of(s, "young");
    case Kind::outer: case Kind::inner: return relative * (s.outer - s.inner);
    case Kind::load_force: return relative * std::max(bend, entry(rod.loads, p.index, "load").force.norm());
    case Kind::load_moment:
      return relative * std::max(bend * rod.rod.length, entry(rod.loads, p.index, "load").moment.norm());
    case Kind::stiffness: case Kind::density: case Kind::hold_orientation: return relative;
    default: return relative * rod.rod.length;
  }
}

}  // namespace tendril
