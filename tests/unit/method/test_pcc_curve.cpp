// Straights and arcs of rounded polylines, against the geometry's own curve and by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/error.h"
#include "method/pcc/pcc_curve.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

/// A zigzag with long edges, which radii up to 0.04 m fit.
PccPoints random_points(std::mt19937& random, int bends) {
  std::uniform_real_distribution<double> any(-1, 1), radius(0.01, 0.04);
  PccPoints points;
  Vec3 at(any(random), any(random), any(random));
  points.points.push_back(at);
  for (int i = 0; i <= bends; ++i) {
    at += Vec3(0.3, 0.15 * any(random), 0.15 * any(random));
    points.points.push_back(at);
    if (i > 0) points.radii.push_back(radius(random));
  }
  return points;
}

}  // namespace

TEST_CASE("pcc: a quarter bend by hand") {
  const PccPoints points{{Vec3(0, 0, 0), Vec3(0.2, 0, 0), Vec3(0.2, 0.3, 0)}, {0.05}};
  const double arc = 0.05 * M_PI / 2;
  CHECK(points.length() == Approx(0.15 + arc + 0.25).epsilon(1e-14));
  const std::vector<PccPiece> pieces = pieces_of(points);
  REQUIRE(pieces.size() == 3);
  CHECK((!pieces[0].is_arc && pieces[1].is_arc && !pieces[2].is_arc));
  CHECK(pieces[0].length == Approx(0.15));
  CHECK(pieces[1].begin == Approx(0.15));
  CHECK(pieces[1].turn == Approx(M_PI / 2));
  CHECK(pieces[1].radius == 0.05);
  CHECK((pieces[1].axis - Vec3::UnitZ()).norm() < 1e-15);
  CHECK((pieces[1].at(0.5) - Vec3(0.15 + 0.05 * std::sqrt(0.5), 0.05 - 0.05 * std::sqrt(0.5), 0)).norm() < 1e-15);
  CHECK((pieces[1].along(0.5) - Vec3(std::sqrt(0.5), std::sqrt(0.5), 0)).norm() < 1e-15);
  CHECK(pieces[2].begin == Approx(0.15 + arc));
  CHECK((pieces[2].at(1) - points.points.back()).norm() == 0);
}

TEST_CASE("pcc: pieces join without gap or kink and agree with Curve::pcc") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const PccPoints points = random_points(random, trial % 7);
    const std::vector<PccPiece> pieces = pieces_of(points);
    const Curve curve = points.curve();
    INFO("trial " << trial);
    CHECK(points.length() == Approx(curve.length()).epsilon(1e-13));
    CHECK(pieces.back().begin + pieces.back().length == Approx(points.length()).epsilon(1e-13));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const PccPiece& piece = pieces[i];
      CHECK((piece.at(0) - piece.start).norm() < 1e-14);
      CHECK((piece.at(1) - piece.finish).norm() < 1e-13);
      CHECK((piece.along(1) - piece.finish_along).norm() < 1e-13);
      CHECK((piece.at(0.3) - curve.at(piece.begin + 0.3 * piece.length).at).norm() < 1e-13);
      CHECK((piece.along(0.3) - curve.at(piece.begin + 0.3 * piece.length).d3()).norm() < 1e-12);
      if (i == 0) continue;
      CHECK((piece.start - pieces[i - 1].finish).norm() < 1e-14);
      CHECK((piece.start_along - pieces[i - 1].finish_along).norm() < 1e-14);
    }
  }
}

TEST_CASE("pcc: turns from none to nearly pi") {
  for (const double turn : {0.0, 1e-9, 1e-6, 1e-3, 0.5, 2.0, 3.0, M_PI - 1e-6}) {
    const Vec3 out(std::cos(turn), std::sin(turn), 0);
    CHECK(turn_between(Vec3::UnitX(), out) == Approx(turn).margin(1e-16).epsilon(1e-9));
    const double radius = 0.05, tangent = radius * std::tan(turn / 2), straight = 0.1;
    const Vec3 vertex((straight + tangent), 0, 0);
    const PccPoints points{{Vec3::Zero(), vertex, vertex + (straight + tangent) * out}, {radius}};
    INFO("turn " << turn);
    CHECK(points.length() == Approx(2 * straight + radius * turn).epsilon(1e-9));
    double sum = 0;
    for (const PccPiece& piece : pieces_of(points)) sum += piece.length;
    CHECK(sum == Approx(2 * straight + radius * turn).epsilon(1e-9));
  }
}

TEST_CASE("pcc: points in a row, equal points and arcs that touch") {
  const PccPoints straight{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)}, {0.5}};
  CHECK(straight.length() == 3);
  REQUIRE(pieces_of(straight).size() == 2);
  const PccPoints doubled{{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)}, {0.1, 0.1}};
  CHECK(doubled.length() == 1);
  REQUIRE(pieces_of(doubled).size() == 1);
  CHECK(pieces_of(doubled)[0].start_along == Vec3::UnitX());
  // Two quarter bends without a straight between, before or after.
  const PccPoints touching{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(2, 2, 0)}, {1, 1}};
  REQUIRE(pieces_of(touching).size() == 2);
  CHECK(touching.length() == Approx(M_PI));
  // Arcs that overlap: no straight is left, and none of negative length appears.
  const PccPoints overlapping{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1.5, 0), Vec3(2, 1.5, 0)}, {1, 1}};
  CHECK(pieces_of(overlapping).size() == 2);
  const PccPoints nowhere{{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}, {1}};
  CHECK(nowhere.length() == 0);
  CHECK(pieces_of(nowhere).empty());
}

TEST_CASE("pcc: a radius for each vertex is required") {
  const PccPoints few{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)}, {}};
  CHECK_THROWS_WITH(few.length(), Catch::Contains("3 points and 0 radii"));
  CHECK_THROWS_AS(pieces_of(few), UsageError);
  CHECK_THROWS_AS(pieces_of(PccPoints{}), UsageError);
}

TEST_CASE("pcc: arcs that overlap by rounding are made to fit") {
  // Two quarter bends of 50 mm whose tangents take 100 mm of an edge that is 0.5 um short.
  PccPoints points{{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.1 - 5e-7, 0}, {0.4, 0.1 - 5e-7, 0}}, {0.05, 0.05}};
  CHECK(overlap_of(points) == Approx(5e-7).epsilon(1e-6));
  CHECK_THROWS_AS(points.curve(), UsageError);
  const PccPoints fits = fitted(points);
  CHECK(overlap_of(fits) == 0);
  CHECK(fits.radii[0] == Approx(0.05 - 2.5e-7).epsilon(1e-12));
  CHECK(fits.curve().length() == Approx(fits.length()).epsilon(1e-12));
  CHECK(fitted(points, 1e-7).radii == points.radii);
  points.points[2].y() = points.points[3].y() = 0.1;
  CHECK(overlap_of(points) == 0);
  CHECK(fitted(points).radii[0] == Approx(0.05).epsilon(1e-15));
}
