#include "validation/reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tendril::validation {
namespace {

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Frame at arc length s of a rod of constant curvature and twist `omega`.
Frame helix_frame(const Vec3& omega, double s) {
  const Vec3 turn = s * omega;
  const double angle = turn.norm();
  const Mat3 w = cross_matrix(turn);
  const double b = angle > 1e-3 ? (1 - std::cos(angle)) / (angle * angle) : 0.5 - angle * angle / 24;
  const double c =
      angle > 1e-3 ? (angle - std::sin(angle)) / (angle * angle * angle) : 1.0 / 6 - angle * angle / 120;
  return {s * (Vec3::UnitZ() + b * w * Vec3::UnitZ() + c * w * (w * Vec3::UnitZ())), exp_rotation(turn)};
}

/// The angle about `axis` through `origin` that brings the points closest to the stations.
double spin_angle(const Reference& reference, const std::vector<Vec3>& points, const Vec3& origin, const Vec3& axis) {
  double sine = 0, cosine = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 want = vec(reference.stations[k]) - origin, got = points[k] - origin;
    const Vec3 a = got - axis * axis.dot(got), b = want - axis * axis.dot(want);
    sine += axis.dot(a.cross(b));
    cosine += a.dot(b);
  }
  return std::atan2(sine, cosine);
}

double reaction_error(const Reference& reference, const Equilibrium& equilibrium, const Mat3& spin) {
  const double length = reference.rod.length;
  const Reference::Reactions& want = reference.reactions;
  double scale = 0, worst = 0;
  auto compare = [&](const std::array<double, 3>& reference_value, const Vec3& got, double per) {
    scale = std::max(scale, vec(reference_value).norm() / per);
    worst = std::max(worst, (spin * got - vec(reference_value)).norm() / per);
  };
  compare(want.start_force, equilibrium.reactions[0].force, 1);
  compare(want.start_moment, equilibrium.reactions[0].moment, length);
  if (reference.end_held) {
    compare(want.end_force, equilibrium.reactions[1].force, 1);
    compare(want.end_moment, equilibrium.reactions[1].moment, length);
  }
  return worst / scale;
}

double energy_error(const Reference& reference, const Energy& got) {
  const Reference::Energies& want = reference.energies;
  const double total = want.bend + want.twist + want.stretch + want.shear;
  double worst = std::max(std::abs(got.bend - want.bend), std::abs(got.twist - want.twist));
  if (!reference.rod.rigid())
    worst = std::max({worst, std::abs(got.stretch - want.stretch), std::abs(got.shear - want.shear)});
  worst = std::max(worst, std::abs(got.gravity - want.gravity));
  return worst / total;
}

}  // namespace

const Method se3{"se3", Element::se3, ClampRule::half_cell, 4};
const Method staggered{"staggered", Element::staggered, ClampRule::half_cell, 2};
const Method thesis{"thesis", Element::staggered, ClampRule::thesis, 1};

SolveOptions Method::options(bool error) const {
  SolveOptions options;
  options.element = element;
  options.clamp = clamp;
  options.error = error;
  options.tolerance = 1e-11;
  return options;
}

Frame ReferenceFrame::frame() const {
  return {vec(at), Quat(rotation[0], rotation[1], rotation[2], rotation[3]).normalized()};
}

std::vector<const Reference*> all_references() {
  std::vector<const Reference*> all;
  for (const auto* list : {&cantilever_references(), &princeton_references(), &hose_references(), &stretched_references(),
                           &helix_references(), &twisted_references()})
    for (const Reference& reference : *list) all.push_back(&reference);
  return all;
}

std::vector<const Reference*> references_named(const char* name) {
  std::vector<const Reference*> found;
  for (const Reference* reference : all_references())
    if (std::string(reference->name) == name) found.push_back(reference);
  if (found.empty()) throw std::invalid_argument(std::string("no reference is named ") + name);
  return found;
}

RodProblem problem_of(const Reference& reference, int segments) {
  const ReferenceRod& rod = reference.rod;
  Section section;
  section.outer = rod.length / 100;  // plays no part without contact
  section.EI1 = rod.bend[0];
  section.EI2 = rod.bend[1];
  section.GJ = rod.bend[2];
  const double stiff = stiffness_ratio * rod.bend[0] / (rod.length * rod.length);
  section.GA1 = rod.rigid() ? stiff : rod.stretch[0];
  section.GA2 = rod.rigid() ? stiff : rod.stretch[1];
  section.EA = rod.rigid() ? stiff : rod.stretch[2];
  section.mass = rod.mass;
  RodProblem problem;
  problem.rod = Rod::uniform(rod.length, section, segments);
  const Vec3 omega = vec(rod.omega);
  if (!omega.isZero(0)) problem.rod.shape = [omega](double s) { return helix_frame(omega, s); };
  problem.gravity = vec(reference.gravity);
  problem.holds.push_back({0, reference.start.frame()});
  if (reference.end_held) {
    problem.holds.push_back({rod.length, reference.end.frame()});
    problem.holds.back().turns = reference.turns;
  } else {
    problem.loads.push_back({rod.length, vec(reference.force), vec(reference.moment)});
  }
  return problem;
}

Errors errors_of(const Reference& reference, const Equilibrium& equilibrium) {
  const std::size_t segments = equilibrium.points.size() - 1;
  if (segments % 10 != 0) throw std::invalid_argument("errors_of: the segments must be a multiple of 10");
  std::vector<Vec3> points;
  for (int k = 1; k <= 10; ++k) points.push_back(equilibrium.points[segments / 10 * k]);
  Mat3 spin = Mat3::Identity();
  const Frame start = reference.start.frame();
  if (reference.spins)
    spin = Eigen::AngleAxisd(spin_angle(reference, points, start.at, start.d3()), start.d3()).toRotationMatrix();
  Errors errors;
  for (int k = 0; k < 10; ++k) {
    const Vec3 here = start.at + spin * (points[k] - start.at);
    errors.line = std::max(errors.line, (here - vec(reference.stations[k])).norm() / reference.rod.length);
  }
  errors.reaction = reaction_error(reference, equilibrium, spin);
  errors.energy = energy_error(reference, equilibrium.energy);
  return errors;
}

}  // namespace tendril::validation
