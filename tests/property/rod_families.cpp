#include "rod_families.h"

#include <cmath>
#include <cstdio>

#include "base/units.h"

namespace tendril::test {
namespace {

using Random = std::mt19937_64;

/// A rotation by `angle` about an axis normal to d3 and then any turn about d3.
Quat tilted(Random& random, const Quat& from, double angle) {
  const double around = random_between(random, 0, 2 * units::pi), turn = random_between(random, -units::pi, units::pi);
  return from * exp_rotation(angle * Vec3(std::cos(around), std::sin(around), 0)) * exp_rotation(Vec3(0, 0, turn));
}

RodProblem between(Rod rod, const Frame& start, const Frame& end, double turns = 0) {
  RodProblem problem;
  problem.rod = std::move(rod);
  problem.holds = {{0, start}, {problem.rod.length, end}};
  problem.holds.back().turns = turns;
  return problem;
}

/// Clamps at a random distance of 0.2 to 0.95 of the length, tangents up to 70 degrees off the line between them.
RodProblem sane_clamps(Random& random, Rod rod) {
  const Frame start{Vec3::Zero(), random_rotation(random)};
  const Vec3 chord = random_between(random, 0.2, 0.95) * rod.length * start.d3();
  const Frame first{Vec3::Zero(), tilted(random, start.rotation, random_between(random, 0, 1.2))};
  const Frame last{chord, tilted(random, start.rotation, random_between(random, 0, 1.2))};
  return between(std::move(rod), first, last);
}

/// Weight per length so that w L^3/EI has the given value, in a random direction.
void add_weight(Random& random, RodProblem& problem, double heaviness) {
  Section& section = problem.rod.parts[0].section;
  const double length = problem.rod.length;
  section.mass = heaviness * section.EI1 / (length * length * length) / 9.81;
  problem.gravity = 9.81 * random_direction(random);
}

RodProblem stiff_stretch(Random& random, double ratio) {
  Rod rod = slender_rod(100);
  Section& section = rod.parts[0].section;
  section.EA = ratio * section.EI1 / (rod.length * rod.length);
  section.GA1 = section.GA2 = section.EA / 3;
  return sane_clamps(random, rod);
}

RodProblem hard_material(Random& random) {
  Rod rod = slender_rod(150);
  Section& s = rod.parts[0].section;
  const double mass = 1100 * units::pi / (150.0 * 150.0);
  for (double* stiffness : {&s.EA, &s.GA1, &s.GA2, &s.EI1, &s.EI2, &s.GJ}) *stiffness *= 1e6;
  s.mass = mass;
  RodProblem problem = sane_clamps(random, rod);
  problem.gravity = {0, 0, -9.81};
  return problem;
}

RodProblem heavy(Random& random, double heaviness) {
  RodProblem problem = sane_clamps(random, slender_rod(1e4));
  add_weight(random, problem, heaviness);
  return problem;
}

RodProblem stretched(Random& random) {
  const double slenderness = std::pow(10, random_between(random, 1, 3));
  const Quat along = random_rotation(random);
  return between(slender_rod(slenderness), {Vec3::Zero(), tilted(random, along, random_between(random, 0, 1))},
                 {1.05 * (along * Vec3::UnitZ()), tilted(random, along, random_between(random, 0, 1))});
}

/// Tangents at `angle_a` and `angle_b` to the way from start to end, which is `chord` long.
RodProblem facing(Random& random, double angle_a, double angle_b, double chord) {
  const Quat along = random_rotation(random);
  RodProblem problem = between(slender_rod(150), {Vec3::Zero(), tilted(random, along, angle_a)},
                               {chord * (along * Vec3::UnitZ()), tilted(random, along, angle_b)});
  if (random_between(random, 0, 1) < 0.5) add_weight(random, problem, random_between(random, 0, 300));
  return problem;
}

RodProblem anything(Random& random) {
  const double far = std::cbrt(random_between(random, 0, 1)) * 0.95;
  const double slenderness = std::pow(10, random_between(random, 1.5, 4));
  RodProblem problem = between(slender_rod(slenderness), {Vec3::Zero(), random_rotation(random)},
                               {far * random_direction(random), random_rotation(random)});
  if (random_between(random, 0, 1) < 0.5) add_weight(random, problem, random_between(random, 0, 300));
  return problem;
}

RodProblem near_half_turn(Random& random) {
  const Quat start = random_rotation(random);
  const double side = random_between(random, 0, 1) < 0.5 ? -1 : 1;
  const double angle = units::pi - side * std::pow(10, random_between(random, -16, -3));
  const Vec3 place = random_between(random, 0.1, 0.9) * random_direction(random);
  return between(slender_rod(150), {Vec3::Zero(), start}, {place, start * exp_rotation(angle * random_direction(random))});
}

RodProblem compressed(Random& random) {
  const Quat along = random_rotation(random);
  return between(slender_rod(std::pow(10, random_between(random, 1.5, 4))), {Vec3::Zero(), along},
                 {0.8 * (along * Vec3::UnitZ()), along});
}

}  // namespace

std::mt19937_64 stream_of(int family, int member) {
  std::seed_seq seed{20261, family, member};
  return std::mt19937_64(seed);
}

double random_between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_direction(Random& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vec3(x, y, z).normalized();
}

Quat random_rotation(Random& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Quat(w, x, y, z).normalized();
}

Rod slender_rod(double slenderness, int segments) {
  return Rod::uniform(1, Section::round(2 / slenderness, 0, Material::from_poisson(5e6, 0.5, 0)), segments);
}

std::vector<RodFamily> rod_families() {
  std::vector<RodFamily> all;
  for (const double slenderness : {1e1, 1e2, 1e3, 1e4, 1e5}) {
    char name[64];
    std::snprintf(name, sizeof name, "clamps, L/r = %.0e", slenderness);
    all.push_back({name, [=](Random& random) { return sane_clamps(random, slender_rod(slenderness)); }});
  }
  for (const double ratio : {1e8, 1e10, 1e12}) {
    char name[64];
    std::snprintf(name, sizeof name, "EA L^2/EI = %.0e", ratio);
    all.push_back({name, [=](Random& random) { return stiff_stretch(random, ratio); }});
  }
  for (const double heaviness : {3.5e4, 3.5e5, 3.5e6}) {
    char name[64];
    std::snprintf(name, sizeof name, "w L^3/EI = %.1e", heaviness);
    all.push_back({name, [=](Random& random) { return heavy(random, heaviness); }});
  }
  const double half = units::pi;
  all.push_back({"Young's modulus x 1e6", hard_material});
  all.push_back({"chord 1.05 L", stretched});
  all.push_back({"opposed clamps", [half](Random& random) {
                   return facing(random, 0, half, random_between(random, 0.05, 0.9));
                 }});
  all.push_back({"clamps facing outward", [half](Random& random) {
                   return facing(random, half, half, random_between(random, 0.05, 0.9));
                 }});
  all.push_back({"ends coincident", [half](Random& random) {
                   return facing(random, random_between(random, 0, half), random_between(random, 0, half), 0);
                 }});
  for (const double turns : {1.0, 2.0})
    all.push_back({turns == 1 ? "end twist 360 degrees" : "end twist 720 degrees", [turns](Random& random) {
                     RodProblem problem = sane_clamps(random, slender_rod(150));
                     problem.holds.back().turns = random_between(random, 0, 1) < 0.5 ? -turns : turns;
                     if (random_between(random, 0, 1) < 0.5) add_weight(random, problem, random_between(random, 0, 300));
                     return problem;
                   }});
  all.push_back({"any positions and directors", anything});
  all.push_back({"relative rotation near pi", near_half_turn});
  all.push_back({"straight, 20 % compression", compressed});
  return all;
}

}  // namespace tendril::test
