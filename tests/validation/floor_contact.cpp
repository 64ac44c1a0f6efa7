#include "validation/floor_contact.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril::validation {
namespace {

// Inextensible in the exact answers: here with a stretch stiffness that changes them by less than 1e-6.
constexpr double stiffness = 1e7;  // EA L^2/EI

Section stiff_section(double radius, double length, double density) {
  Section section = Section::round(2 * radius, 0, Material::from_poisson(5e6, 0.5, density));
  section.EA = section.GA1 = section.GA2 = stiffness * section.EI1 / (length * length);
  return section;
}

/// The floor's surface lies the radius below the centre line of a rod that touches it.
std::unique_ptr<Surroundings> floor_at(double height, double radius) {
  auto floor = std::make_unique<Surroundings>();
  floor->add({HalfSpace{}, Frame{{0, 0, height - radius}, Quat::Identity()}, 0});
  return floor;
}

Frame level_clamp(double height) { return Frame::looking({0, 0, height}, {1, 0, 0}, {0, 0, 1}); }

}  // namespace

FloorProblem hose_on_floor(int segments) {
  FloorProblem problem;
  problem.floor = floor_at(0, 0.008);
  problem.rod.rod = Rod::uniform(1.2, stiff_section(0.008, 1.2, 1100), segments);
  problem.rod.holds = {{0, level_clamp(0.1)}};
  problem.rod.gravity = {0, 0, -9.81};
  problem.rod.surroundings = problem.floor.get();
  return problem;
}

FloorErrors hose_on_floor_errors(const Equilibrium& e) {
  using Exact = HoseOnFloor;
  FloorErrors errors;
  const Reaction& clamp = e.reactions.front();
  errors.force = (clamp.force - Vec3(0, 0, Exact::clamp_force)).norm() / Exact::clamp_force;
  errors.moment = (clamp.moment - Vec3(0, -Exact::clamp_moment, 0)).norm() / Exact::clamp_moment;
  for (int k = 0; k < 3; ++k) {
    const Vec3 exact(Exact::free_part[k][0], 0, Exact::free_part[k][1]);
    errors.line = std::max(errors.line, (e.frame_at(0.25 * (k + 1) * Exact::lift_off).at - exact).norm() / 1.2);
  }
  for (std::size_t i = 0; i < e.s.size(); ++i)
    if (e.s[i] > Exact::lift_off) {
      const Vec3 exact(Exact::lift_off_x + e.s[i] - Exact::lift_off, 0, 0);
      errors.line = std::max(errors.line, (e.points[i] - exact).norm() / 1.2);
    }
  errors.deepest = e.deepest_penetration / 0.008;
  return errors;
}

FloorProblem tip_on_floor(const TipOnFloor& tip, double times, int segments) {
  FloorProblem problem;
  problem.floor = floor_at(-tip.depth, 0.005);
  problem.rod.rod = Rod::uniform(1, stiff_section(0.005, 1, 0), segments);
  problem.rod.holds = {{0, level_clamp(0)}};
  const double EI = problem.rod.rod.parts[0].section.EI1;
  problem.rod.loads = {{1, {0, 0, -times * tip.touch_force * EI}, Vec3::Zero()}};
  problem.rod.surroundings = problem.floor.get();
  return problem;
}

TipErrors tip_on_floor_errors(const TipOnFloor& tip, double times, const Equilibrium& e) {
  const double EI = Section::round(0.01, 0, Material::from_poisson(5e6, 0.5, 0)).EI1;
  TipErrors errors;
  errors.place = (e.points.back() - Vec3(tip.tip_x, 0, -tip.depth)).norm();
  const Vec3 along = e.rotations.back() * Vec3::UnitZ();
  errors.angle = std::abs(std::atan2(-along.z(), along.x()) - tip.tip_angle);
  Vec3 carried = Vec3::Zero();
  for (const ContactForce& contact : e.contacts) carried += contact.force;
  const double exact = (times - 1) * tip.touch_force * EI;
  errors.floor_force = (carried - Vec3(0, 0, exact)).norm() / exact;
  return errors;
}

}  // namespace tendril::validation
