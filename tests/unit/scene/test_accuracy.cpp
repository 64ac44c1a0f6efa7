#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>

#include "base/error.h"
#include "scene/accuracy.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

TEST_CASE("the error falls with the element's order", "[scene][accuracy]") {
  Scene scene(earth);
  scene.add(sagging_hose());
  AccuracyOptions options;
  options.segments = {10, 20, 40};
  options.seconds_each = 0;
  options.solve.error = true;
  const Accuracy se3 = study_accuracy(scene, options);
  REQUIRE(se3.status == Status::solved);
  REQUIRE(se3.rows.size() == 3);
  CHECK(se3.reference_segments == 160);
  CHECK(se3.reference_uncertainty < 0.1 * se3.rows.back().error);
  CHECK(std::isnan(se3.rows[0].order));
  CHECK(se3.rows[2].order == Approx(4).margin(0.3));
  for (const AccuracyRow& row : se3.rows) {
    CAPTURE(row.segments);
    CHECK(row.seconds > 0);
    CHECK(row.estimate > row.error / 3);
    CHECK(row.estimate < row.error * 3);
  }
  options.solve.element = Element::staggered;
  const Accuracy staggered = study_accuracy(scene, options);
  REQUIRE(staggered.status == Status::solved);
  CHECK(staggered.rows[2].order == Approx(2).margin(0.2));
  CHECK(staggered.rows[2].error > 10 * se3.rows[2].error);
  CHECK(scene.rods().front()->rod().segments == 40);  // untouched
}

TEST_CASE("extrapolated rows: two orders more for the staggered element, places that both meshes have", "[scene][accuracy]") {
  Scene scene(earth);
  PlacedRod hose = sagging_hose();
  hose.load({0.37, {0, 0.5, 0}, Vec3::Zero()});  // cuts the rod into lengths that no mesh divides evenly
  scene.add(std::move(hose));
  AccuracyOptions options;
  options.segments = {20, 40, 80};
  options.seconds_each = 0;
  options.solve.element = Element::staggered;
  const Accuracy plain = study_accuracy(scene, options);
  options.extrapolate = true;
  const Accuracy extrapolated = study_accuracy(scene, options);
  REQUIRE(extrapolated.status == Status::solved);
  CHECK(extrapolated.element() == "staggered, extrapolated");
  CHECK(plain.element() == "staggered");
  CHECK(extrapolated.rows[2].order == Approx(4).margin(0.6));
  CHECK(extrapolated.rows[2].error < 0.05 * plain.rows[2].error);
  for (int k = 0; k < 3; ++k) {
    CHECK(extrapolated.rows[k].iterations > plain.rows[k].iterations);
    CHECK(extrapolated.rows[k].fastest <= extrapolated.rows[k].seconds);
    CHECK(extrapolated.rows[k].fastest > 0);
  }
  options.segments = {20, 21};
  CHECK_THROWS_WITH(study_accuracy(scene, options), Contains("has 21, expected even numbers"));
}

TEST_CASE("errors are measured by a closed form where there is one", "[scene][accuracy]") {
  // A dead moment rolls a cantilever up into a circle.
  Scene scene;
  Section section = soft_section();
  section.mass = 0;
  PlacedRod rod("rod", Rod::uniform(1, section, 40), Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1}), std::nullopt);
  const double curvature = 2;
  rod.load({1, Vec3::Zero(), Vec3(0, -curvature * section.EI1, 0)});
  scene.add(std::move(rod));
  AccuracyOptions options;
  options.segments = {10, 20};
  options.seconds_each = 0;
  options.solve.element = Element::staggered;
  std::vector<double> asked;
  options.exact = [&](std::size_t which, double s) {
    CHECK(which == 0);
    asked.push_back(s);
    return Vec3(std::sin(curvature * s) / curvature, 0, (1 - std::cos(curvature * s)) / curvature);
  };
  const Accuracy accuracy = study_accuracy(scene, options);
  REQUIRE(accuracy.status == Status::solved);
  CHECK(accuracy.reference_segments == 0);
  CHECK(accuracy.reference_uncertainty == 0);
  CHECK_FALSE(accuracy.unresolved());
  CHECK(accuracy.rows[1].order == Approx(2).margin(0.1));
  CHECK(asked.size() == 11 + 21);
  options.solve.element = Element::se3;  // exact for a circle
  CHECK(study_accuracy(scene, options).rows[0].error < 1e-9);
}

TEST_CASE("an accuracy study rejects what it cannot do and stops when told", "[scene][accuracy]") {
  Scene scene(earth);
  AccuracyOptions options;
  CHECK_THROWS_WITH(study_accuracy(scene, options), Contains("no rods"));
  scene.add(sagging_hose());
  options.segments = {};
  CHECK_THROWS_WITH(study_accuracy(scene, options), Contains("'segments' is empty"));
  options.segments = {10, 0};
  CHECK_THROWS_WITH(study_accuracy(scene, options), Contains("has 0"));
  options.segments = {1'000'000'000};
  CHECK_THROWS_WITH(study_accuracy(scene, options), Contains("1000000000"));
  options.segments = {10};
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const Accuracy stopped = study_accuracy(scene, options, context);
  CHECK(stopped.status == Status::cancelled);
  CHECK_THAT(stopped.message, Contains("reference"));
}

TEST_CASE("errors that the reference cannot resolve are told", "[scene][accuracy]") {
  Accuracy accuracy;
  accuracy.reference_uncertainty = 1e-6;
  accuracy.rows = {{.segments = 10, .error = 1e-4}, {.segments = 20, .error = 1e-5}};
  CHECK_FALSE(accuracy.unresolved());
  accuracy.rows.push_back({.segments = 40, .error = 1.5e-6});
  CHECK(accuracy.unresolved());
}
