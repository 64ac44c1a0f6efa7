// Reference equilibria of single rods, and what tendril makes of them.
//
// Numbers: solutions of the continuous Cosserat equations by multiple shooting with two formulations, and closed forms
// (elliptic integrals, circle, helices), good to about ten digits. World axes, SI unless a case says otherwise.
#pragma once

#include <array>
#include <vector>

#include "statics/solve.h"

namespace tendril::validation {

struct ReferenceRod {
  double length;
  std::array<double, 3> bend;     ///< EI1, EI2, GJ
  std::array<double, 3> stretch;  ///< GA1, GA2, EA; zero: inextensible and unshearable
  double mass;                    ///< kg/m
  std::array<double, 3> omega;    ///< curvature and twist of the unstressed rod, constant along it, 1/m

  bool rigid() const { return stretch[2] == 0; }
};

struct ReferenceFrame {
  std::array<double, 3> at;
  std::array<double, 4> rotation;  ///< w, x, y, z

  Frame frame() const;
};

/// One equilibrium. The rod is clamped at the start; at the end it is clamped too or carries a dead load.
struct Reference {
  const char* name;
  const char* label;
  ReferenceRod rod;
  std::array<double, 3> gravity;
  ReferenceFrame start, end;
  bool end_held;
  std::array<double, 3> force, moment;  ///< dead load at a free end
  double turns;                         ///< the end hold's extra turns that lead to this equilibrium
  bool spins;  ///< the whole rod may turn about the axis through its aligned clamps: compare after turning it back
  struct Reactions {
    std::array<double, 3> start_force, start_moment, end_force, end_moment;  ///< on the rod
  } reactions;
  struct Energies {
    double bend, twist, stretch, shear, gravity;
  } energies;
  std::array<std::array<double, 3>, 10> stations;  ///< centre line at s = 0.1 L, 0.2 L, ... L
};

const std::vector<Reference>& cantilever_references();
const std::vector<Reference>& princeton_references();
const std::vector<Reference>& hose_references();
const std::vector<Reference>& stretched_references();
const std::vector<Reference>& helix_references();
const std::vector<Reference>& twisted_references();

/// All of the lists above.
std::vector<const Reference*> all_references();

/// The references of one name, in their order; throws for an unknown name.
std::vector<const Reference*> references_named(const char* name);

/// How stiff the twin of an inextensible rod is: EA L^2/EI. It leaves an error of about the load over EA: less than
/// 1e-8, and 3e-7 for the localized helices, which pull with 1000 to 3000 EI/L^2.
inline constexpr double stiffness_ratio = 1e10;

RodProblem problem_of(const Reference& reference, int segments);

/// Errors of an equilibrium against a reference.
struct Errors {
  double line = 0;      ///< largest distance of the centre line at the stations, relative to the length
  double reaction = 0;  ///< largest error of a reaction (force, or moment over length), relative to the largest
  double energy = 0;    ///< largest error of an elastic energy term, relative to the elastic total
};

/// `segments` of the equilibrium must be a multiple of 10.
Errors errors_of(const Reference& reference, const Equilibrium& equilibrium);

/// The harness of three hoses in reference_tree.cpp; stable.
SystemProblem tree_problem(int segments);

struct TreeErrors {
  double line = 0, reaction = 0, energy = 0;  ///< as in Errors, the largest of the three rods'; energies of all together
  double branch = 0;                          ///< place of the branch point, relative to a rod's length
  double branch_turn = 0;                     ///< rad
};

/// `segments` of every rod must be a multiple of 10.
TreeErrors tree_errors(const SystemEquilibrium& found);

/// The three discretisations.
struct Method {
  const char* name;
  Element element;
  ClampRule clamp;
  double order;

  SolveOptions options(bool error = false) const;
};
extern const Method se3, staggered, thesis;

/// The equilibrium that the reference lists: by a cold solve; a few by a start or a motion that leads there.
Equilibrium solve_reference(const Reference& reference, const Method& method, int segments, bool error = false);

}  // namespace tendril::validation
