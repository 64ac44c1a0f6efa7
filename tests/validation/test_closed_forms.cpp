// Cases whose answer an element meets exactly, and localized helices.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "validation/reference.h"

using namespace tendril;
using namespace tendril::validation;

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

Errors localized_errors(const Reference& reference, const Homoclinic& form, double torsion, const Method& method,
                        int segments) {
  const Equilibrium start = homoclinic_start(reference, form, torsion, segments);
  SolveOptions options = method.options();
  options.tolerance = 1e-7;
  const Equilibrium e = solve(problem_of(reference, segments), options, {}, &start);
  CAPTURE(reference.name, reference.label, method.name, segments, e.message, e.iterations, e.fallbacks);
  REQUIRE(e.status == Status::solved);
  CHECK(e.stable);
  return errors_of(reference, e);
}

}  // namespace

TEST_CASE("thick cantilever under a small force: Timoshenko's deflection") {
  const Reference& reference = *references_named("timoshenko_thick").front();
  const double tip = 1.2698442392825357e-8;  // m, a sixth of it shear
  for (const int segments : {1, 2, 7, 40}) {
    const Equilibrium e = solve(problem_of(reference, segments), se3.options());
    CAPTURE(segments);
    CHECK(-e.points.back().z() == Approx(tip).epsilon(1e-7));
  }
  for (const Method& method : {staggered, thesis}) {
    auto error = [&](int segments) {
      const Equilibrium e = solve(problem_of(reference, segments), method.options(true));
      REQUIRE(e.error);
      CHECK(e.error->valid);
      const double off = std::abs(-e.points.back().z() - tip);
      CHECK(e.error->value < 3 * off);
      CHECK(e.error->value > off / 3);
      return off;
    };
    const double coarse = error(40), fine = error(80);
    CHECK(std::log2(coarse / fine) == Approx(method.order).margin(0.1));
    CHECK(fine < (method.order == 2 ? 1e-4 : 2e-2) * tip);
  }
}

TEST_CASE("end moment of one full turn: an exact circle") {
  const Reference& reference = *references_named("rollup_1turn").front();
  for (const int segments : {10, 20, 40, 160}) {
    const Equilibrium e = solve(problem_of(reference, segments), se3.options());
    CAPTURE(segments, e.message, e.iterations);
    REQUIRE(e.status == Status::solved);
    const Errors errors = errors_of(reference, e);
    CHECK(errors.line < 1e-10);
    CHECK(errors.reaction < 1e-9);
    CHECK(errors.energy < 1e-9);
    CHECK(e.points.back().norm() < 1e-10);
    CHECK((e.points[segments / 2] - Vec3(0, 0, -1 / units::pi)).norm() < 1e-10);
  }
  for (const Method& method : {staggered, thesis}) {
    const Equilibrium coarse = solve(problem_of(reference, 40), method.options(true));
    const Equilibrium fine = solve(problem_of(reference, 80), method.options(true));
    REQUIRE(coarse.status == Status::solved);
    REQUIRE(fine.status == Status::solved);
    const double first = errors_of(reference, coarse).line, second = errors_of(reference, fine).line;
    CHECK(std::log2(first / second) == Approx(method.order).margin(0.1));
    CHECK(second < (method.order == 2 ? 1.1e-4 : 1.6e-2));
    CHECK(fine.error->valid);
    CHECK(fine.error->value < 3 * second);
    CHECK(fine.error->value > second / 3);
  }
}

TEST_CASE("pre-curved rod held as another uniform helix: its exact wrench") {
  const Reference& reference = *references_named("helix_exact_wrench").front();
  for (const int segments : {10, 20, 40, 80}) {
    const Equilibrium e = solve(problem_of(reference, segments), se3.options());
    CAPTURE(segments, e.message, e.iterations, e.fallbacks);
    REQUIRE(e.status == Status::solved);
    const Errors errors = errors_of(reference, e);
    CHECK(errors.line < 2e-9);  // the stiff twin's own error is 5e-10
    CHECK(errors.reaction < 2e-5);
    CHECK(errors.energy < 2e-7);
  }
  const double first = errors_of(reference, solve(problem_of(reference, 40), staggered.options())).line;
  const double second = errors_of(reference, solve(problem_of(reference, 80), staggered.options())).line;
  CHECK(std::log2(first / second) == Approx(2).margin(0.2));
  CHECK(second < 6e-5);
}

TEST_CASE("localized helix: clamped ends of the homoclinic solution") {
  const Reference& reference = *references_named("localized_helix_homoclinic").front();
  const Homoclinic form{reference.rod.bend[0], 0.7853981633974484, 0.044705647196082464};
  const Errors coarse = localized_errors(reference, form, 79.6893970362434, se3, 160);
  const Errors fine = localized_errors(reference, form, 79.6893970362434, se3, 320);
  CHECK(fine.line < 1e-6);
  CHECK(fine.reaction < 1e-4);
  CHECK(std::log2(coarse.line / fine.line) == Approx(4).margin(0.5));
  const Errors second_coarse = localized_errors(reference, form, 79.6893970362434, staggered, 160);
  const Errors second_fine = localized_errors(reference, form, 79.6893970362434, staggered, 320);
  CHECK(second_fine.line < 3e-5);
  CHECK(std::log2(second_coarse.line / second_fine.line) == Approx(2).margin(0.3));
}

TEST_CASE("localized helix of 27 turns between aligned clamps") {
  // Sliding the helix along the rod costs next to nothing, so Newton's steps end at 1e-8 to 1e-6, not below.
  for (const Reference* reference : references_named("localized_helix_pyelastica")) {
    const double per_square = reference->rod.bend[0] / 1e4;  // EI/L^2
    const Homoclinic form{reference->rod.bend[0], 2900.993205792131 * per_square, 98.54149617119074 * per_square * 100};
    const Errors fine = localized_errors(*reference, form, 167.98265188103153, se3, 320);
    CHECK(fine.line < 1e-5);
    CHECK(fine.reaction < 1e-3);
    CHECK(fine.energy < 2e-5);
    const Errors coarse = localized_errors(*reference, form, 167.98265188103153, staggered, 80);
    const Errors second_order = localized_errors(*reference, form, 167.98265188103153, staggered, 160);
    CHECK(second_order.line < 5e-4);
    CHECK(std::log2(coarse.energy / second_order.energy) == Approx(2).margin(0.3));
  }
}
