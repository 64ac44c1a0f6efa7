// Cases whose answer an element meets exactly, and localized helices.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "validation/reference.h"

using namespace tendril;
using namespace tendril::validation;

namespace {

Errors localized_errors(const Reference& reference, const Method& method, int segments) {
  const Equilibrium e = solve_reference(reference, method, segments);
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
  const Errors coarse = localized_errors(reference, se3, 160);
  const Errors fine = localized_errors(reference, se3, 320);
  CHECK(fine.line < 1e-6);
  CHECK(fine.reaction < 1e-4);
  CHECK(std::log2(coarse.line / fine.line) == Approx(4).margin(0.5));
  const Errors second_coarse = localized_errors(reference, staggered, 160);
  const Errors second_fine = localized_errors(reference, staggered, 320);
  CHECK(second_fine.line < 3e-5);
  CHECK(std::log2(second_coarse.line / second_fine.line) == Approx(2).margin(0.3));
}

TEST_CASE("localized helix of 27 turns between aligned clamps") {
  // Sliding the helix along the rod costs next to nothing, so Newton's steps end at 1e-8 to 1e-6, not below.
  for (const Reference* reference : references_named("localized_helix_pyelastica")) {
    const Errors fine = localized_errors(*reference, se3, 320);
    CHECK(fine.line < 1e-5);
    CHECK(fine.reaction < 1e-3);
    CHECK(fine.energy < 2e-5);
    const Errors coarse = localized_errors(*reference, staggered, 80);
    const Errors second_order = localized_errors(*reference, staggered, 160);
    CHECK(second_order.line < 5e-4);
    CHECK(std::log2(coarse.energy / second_order.energy) == Approx(2).margin(0.3));
  }
}
