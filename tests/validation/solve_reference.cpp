// How each reference is reached: most by a cold solve, a few by a start or a motion that leads to that equilibrium.
#include <cmath>
#include <cstring>
#include <string>

#include "base/units.h"
#include "validation/reference.h"

namespace tendril::validation {
namespace {

/// The localized helix of an infinite rod: tension T, axial moment M, about the z axis, its middle at s = 0.
struct Homoclinic {
  double bend, tension, moment;

  Vec3 at(double s) const {
    const double half = 0.5 * moment / bend, a = std::sqrt(tension / bend - half * half);
    const double radius = 2 * a * bend / tension / std::cosh(a * s);
    return {radius * std::sin(half * s), -radius * std::cos(half * s), s - 2 * a * bend / tension * std::tanh(a * s)};
  }
};

/// A start for the reference's rod: the closed form's centre line, frames carried along it with an even twist that ends
/// in the end hold's frame after `torsion` rad.
Equilibrium homoclinic_start(const Reference& reference, const Homoclinic& form, double torsion, int segments) {
  const double length = reference.rod.length;
  const Frame start = reference.start.frame(), end = reference.end.frame();
  const Vec3 middle = 0.5 * (start.at + end.at);
  Equilibrium e;
  std::vector<Quat> carried;
  Quat q = start.rotation;
  for (int i = 0; i <= segments; ++i) {
    const double s = length * (double(i) / segments - 0.5), step = 1e-5 * length;
    e.s.push_back(s + 0.5 * length);
    e.points.push_back(middle + form.at(s));
    const Vec3 tangent = (form.at(s + step) - form.at(s - step)).normalized();
    q = (shortest_turn(q * Vec3::UnitZ(), i == segments ? end.d3() : i == 0 ? start.d3() : tangent) * q).normalized();
    carried.push_back(q);
  }
  const double left = log_rotation(q.conjugate() * end.rotation).z();
  const double twist = left + 2 * units::pi * std::round((torsion - left) / (2 * units::pi));
  for (int i = 0; i <= segments; ++i)
    e.rotations.push_back(carried[i] * exp_rotation(Vec3(0, 0, twist * i / segments)));
  e.points.front() = start.at;
  e.points.back() = end.at;
  return e;
}

/// Sliding the helix along the rod costs next to nothing, so Newton's steps end at 1e-8 to 1e-6, not below.
Equilibrium solve_localized(const Reference& reference, SolveOptions options, int segments) {
  const double bend = reference.rod.bend[0];
  const bool homoclinic = std::strcmp(reference.name, "localized_helix_homoclinic") == 0;
  const double per_square = bend / 1e4;  // EI/L^2 of the other, 100 m long
  const Homoclinic form = homoclinic ? Homoclinic{bend, 0.7853981633974484, 0.044705647196082464}
                                     : Homoclinic{bend, 2900.993205792131 * per_square, 98.54149617119074 * per_square * 100};
  const Equilibrium start = homoclinic_start(reference, form, homoclinic ? 79.6893970362434 : 167.98265188103153, segments);
  options.tolerance = 1e-7;
  return solve(problem_of(reference, segments), options, {}, &start);
}

/// By bringing the ends of a solved neighbour together in ten steps.
Equilibrium solve_by_motion(const Reference& from, const Reference& to, const SolveOptions& options, int segments) {
  RodProblem problem = problem_of(from, segments);
  const Vec3 begin = problem.holds[1].frame.at, end = to.end.frame().at;
  SolveOptions plain = options;
  plain.error = false;
  Equilibrium e = solve(problem, plain);
  for (int step = 1; step <= 10 && e.ok(); ++step) {
    problem.holds[1].frame.at = begin + 0.1 * step * (end - begin);
    e = solve(problem, step == 10 ? options : plain, {}, &e);
  }
  return e;
}

}  // namespace

Equilibrium solve_reference(const Reference& reference, const Method& method, int segments, bool error) {
  const SolveOptions options = method.options(error);
  if (std::strncmp(reference.name, "localized_helix", 15) == 0) return solve_localized(reference, options, segments);
  if (std::string(reference.label) == "R=2.5 turns, D=0.4, Kirchhoff")
    return solve_by_motion(*references_named(reference.name)[3], reference, options, segments);
  return solve(problem_of(reference, segments), options);
}

}  // namespace tendril::validation
