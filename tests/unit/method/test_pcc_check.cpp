// The certificate of a curve against fine samples with brute-force distances, and every kind of violation by hand.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/pcc/gap_search.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

namespace {

SpaceDemands of_radius(double radius, double clearance = 0) {
  SpaceDemands demands;
  demands.radius = radius;
  demands.clearance = clearance;
  return demands;
}

FreeSpace space_of(const Scene& scene, const SpaceDemands& demands) { return FreeSpace(scene, demands, {Vec3::Zero()}, 0.1); }

PccDemands tools(std::vector<double> radii) {
  PccDemands demands;
  demands.radii = std::move(radii);
  return demands;
}

/// Once around a corner, in the plane z = 0: bends of 50 mm at (0.2, 0) and (0.2, 0.3), 480 mm of edges.
PccPoints two_bends() { return {{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}, {0.4, 0.2, 0}}, {0.05, 0.05}}; }

std::vector<Violation> found_in(const FreeSpace& space, const PccDemands& demands, const PccPoints& curve) {
  return violations(space, demands, ends_of(curve), curve);
}

const Violation* one_of(const std::vector<Violation>& all, Violation::Kind kind) {
  for (const Violation& v : all)
    if (v.kind == kind) return &v;
  return nullptr;
}

/// The smallest brute-force distance at places 0.1 mm apart, outside the free ends.
double sampled_distance(const Mesh& mesh, const PccPoints& curve, double free_ends) {
  const double length = curve.length();
  double least = std::numeric_limits<double>::infinity();
  for (const PccPiece& piece : pieces_of(curve)) {
    const int count = std::max(1, static_cast<int>(std::ceil(piece.length / 1e-4)));
    for (int i = 0; i <= count; ++i) {
      const double s = piece.begin + piece.length * i / count;
      if (s < free_ends || s > length - free_ends + 1e-12) continue;
      least = std::min(least, brute_distance(mesh, piece.at(double(i) / count)));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("least between two places: never more than a surface point allows, and reached") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  CAPTURE(seed);
  Random random(seed);
  double tightest = 1;
  for (int i = 0; i < 20000; ++i) {
    const double chord = random.in(0, 1);
    const Vec3 a = Vec3::Zero(), b(chord, 0, 0), y = random.point(1.5);
    const double bound = least_between((y - a).norm(), (y - b).norm(), chord);
    const double distance = std::sqrt(closest_on_segment(y, a, b).squared);
    REQUIRE(bound <= distance + 1e-12);
    tightest = std::min(tightest, distance - bound);
    REQUIRE(distance - bound < 1e-9);  // one point alone: the bound is its distance
    // Less known of the ends is never more known of what lies between.
    REQUIRE(least_between((y - a).norm() - random.in(0, 0.3), (y - b).norm(), chord) <= bound + 1e-12);
  }
  CHECK(tightest < 1e-12);
}

TEST_CASE("least between two places: where nothing or less than nothing is known") {
  CHECK(least_between(-0.1, -0.2, 0.1) == Approx(-0.2));
  CHECK(least_between(-0.1, -0.1, 0.1) == Approx(-0.15));
  CHECK(least_between(0.3, 0.1, 0.1) == Approx(0.2));  // a alone keeps the surface away from b
  CHECK(least_between(0.1, 0.2, 0) == Approx(0.2));
  CHECK(least_between(0, 0, 0.5) == Approx(-0.25));
}

TEST_CASE("smallest gap: brute force over random curves and meshes") {
  const unsigned seed = GENERATE(range(1u, 25u));
  CAPTURE(seed);
  Random random(seed);
  const Mesh mesh = triangle_soup(40, 0.2, random);
  Scene scene;
  scene.add(obstacle_of("soup", mesh));
  const double thickness = 0.02;
  const FreeSpace space = space_of(scene, of_radius(0.012, 0.008));
  const PccPoints curve = random_pcc(random, random.below(6), 0.05);
  const double free_ends = random.below(2) ? 0 : random.in(0, 0.05);
  const double brute = sampled_distance(mesh, curve, free_ends) - thickness;
  if (!std::isfinite(brute)) return;  // shorter than its free ends
  for (const double tolerance : {1e-5, 1e-3}) {
    const CurveGap gap = smallest_gap(space, curve, free_ends, 10, tolerance);
    CAPTURE(gap.s, free_ends, curve.length(), curve.bends());
    CHECK(gap.value <= brute + tolerance);
    CHECK(gap.value >= brute - (free_ends > 0 ? 1.01e-4 : 5.1e-5));  // samples miss where the free ends end
    CHECK(gap.obstacle == 0);
    CHECK(brute_distance(mesh, gap.at) - thickness == Approx(gap.value).margin(1e-12));
    CHECK((gap.at - gap.on).norm() - thickness == Approx(gap.value).margin(1e-12));
    CHECK((curve.curve().at(gap.s).at - gap.at).norm() < 1e-9);
    CHECK(gap.s >= free_ends);
  }
  CHECK(is_clear(space, curve, free_ends) == (brute > 0));
}

TEST_CASE("smallest gap: a curve that just touches is clear, one that is 30 um nearer is not") {
  const unsigned seed = GENERATE(range(1u, 16u));
  CAPTURE(seed);
  Random random(seed);
  const Mesh mesh = triangle_soup(40, 0.2, random);
  Scene scene;
  scene.add(obstacle_of("soup", mesh));
  const PccPoints curve = random_pcc(random, 4, 0.05);
  const double distance = smallest_gap(space_of(scene, of_radius(0)), curve, 0, 10, 1e-7).value;
  if (distance < 1e-3) return;  // passes through a triangle
  CHECK(is_clear(space_of(scene, of_radius(distance - 1e-7)), curve, 0));
  CHECK(!is_clear(space_of(scene, of_radius(distance + 3e-5)), curve, 0));
  CHECK(is_clear(space_of(scene, of_radius(distance + 3e-5)), curve, 0, 1e-4));
}

TEST_CASE("smallest gap: analytic distances to solids, and few questions along a wall") {
  Scene scene;
  scene.add(solid_of("wall", Box{Vec3(2, 2, 0.1)}, Vec3(0, 0, -0.05)));
  scene.add(solid_of("ball", Sphere{0.05}, Vec3(0.1, 0.2, 0.031)));
  const FreeSpace space = space_of(scene, of_radius(0.01, 0.01));
  PccPoints curve = two_bends();
  for (Vec3& p : curve.points) p.z() = 0.02;
  SECTION("along the wall at the very clearance") {
    CHECK(is_clear(space, curve, 0));
    CHECK(smallest_gap(space, curve, 0, 1).value == Approx(0).margin(1e-12));
    GapSearch search(space, -0.5e-5, 0.5e-5);
    for (const PccPiece& piece : pieces_of(curve)) search.along(piece, 0, 1);
    CHECK(search.best().obstacle == -1);
    CHECK(search.queries() < 1000);  // the way travelled alone would take 50,000
  }
  SECTION("past the ball") {
    for (Vec3& p : curve.points) p.z() = 0.03;
    const CurveGap gap = smallest_gap(space, curve, 0, 1);
    const Vec3 ball(0.1, 0.2, 0.031), foot(0.2, 0.15, 0.03);
    CHECK(gap.obstacle == 0);
    CHECK(gap.value == Approx(0.01).margin(1e-12));
    CHECK(gap.value < (foot - ball).norm() - 0.07);
  }
  SECTION("nothing within the limit") {
    for (Vec3& p : curve.points) p.z() = 0.4;
    const CurveGap gap = smallest_gap(space, curve, 0, 0.1);
    CHECK(gap.obstacle == -1);
    CHECK(gap.value == 0.1);
  }
  SECTION("inside the wall") {
    for (Vec3& p : curve.points) p.z() = -0.03;
    CHECK(smallest_gap(space, curve, 0, 1).value == Approx(-0.05).margin(1e-4));
    CHECK(!is_clear(space, curve, 0));
  }
  SECTION("free ends longer than the curve leave nothing to check") {
    for (Vec3& p : curve.points) p.z() = 0.005;
    CHECK(!is_clear(space, curve, 0));
    CHECK(is_clear(space, curve, 1));
  }
}

TEST_CASE("smallest gap: no obstacles") {
  const FreeSpace space = space_of(Scene(), of_radius(0.01));
  CHECK(is_clear(space, two_bends(), 0));
  CHECK(smallest_gap(space, two_bends(), 0, 1).obstacle == -1);
  CHECK(found_in(space, tools({0.05}), two_bends()).empty());
}

TEST_CASE("violations: clearance of each obstacle, with place and text") {
  Scene scene;
  scene.add(solid_of("ball", Sphere{0.05}, Vec3(0.05, 0.065, 0)));
  scene.add(solid_of("post", Cylinder{0.03, 1}, Vec3(0.25, 0.1, 0)));
  const FreeSpace space = space_of(scene, of_radius(0.01, 0.01));
  const auto all = found_in(space, tools({0.05}), two_bends());
  REQUIRE(all.size() == 1);
  CHECK(all[0].kind == Violation::Kind::clearance);
  CHECK(all[0].by == Approx(0.005).margin(1e-5));
  CHECK(all[0].s == Approx(0.05).margin(1e-3));
  CHECK((all[0].at - Vec3(0.05, 0, 0)).norm() < 1e-3);
  CHECK(all[0].obstacle == 0);
  CHECK(text_of(all[0], space) == "5.0 mm too near to 'ball' at 0.05 m");

  const FreeSpace wider = space_of(scene, of_radius(0.012, 0.01));
  const auto both = found_in(wider, tools({0.05}), two_bends());
  REQUIRE(both.size() == 2);
  CHECK(both[0].obstacle == 0);
  CHECK(both[1].obstacle == 1);
  CHECK(both[1].by == Approx(0.002).margin(1e-5));
  PccDemands free = tools({0.05});
  free.free_ends = 0.16;
  const auto beyond = found_in(wider, free, two_bends());
  REQUIRE(beyond.size() == 1);
  CHECK(beyond[0].obstacle == 1);
}

TEST_CASE("violations: zones and walls") {
  SpaceDemands demands = of_radius(0.01, 0.02);
  demands.keep_out.emplace_back(Vec3(-1, 0.5, -1), Vec3(1, 0.6, 1));
  demands.keep_out.emplace_back(Vec3(0.05, 0.007, -0.1), Vec3(0.08, 0.1, 0.1));
  demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.1, -0.1, -0.1), Vec3(0.45, 0.206, 0.1));
  Scene scene;
  scene.add(solid_of("far", Sphere{0.01}, Vec3(5, 5, 5)));
  const FreeSpace space = space_of(scene, demands);
  CHECK(space.first_zone() == 1);
  const auto all = found_in(space, tools({0.05}), two_bends());
  REQUIRE(all.size() == 2);
  const Violation *out = one_of(all, Violation::Kind::keep_out), *in = one_of(all, Violation::Kind::keep_in);
  REQUIRE(out);
  REQUIRE(in);
  CHECK(out->by == Approx(0.003).margin(1e-5));
  CHECK(text_of(*out, space).rfind("3.0 mm within 'keep_out 2' at 0.0", 0) == 0);
  CHECK(in->by == Approx(0.004).margin(1e-5));
  CHECK(text_of(*in, space).rfind("4.0 mm out of keep_in at 0.", 0) == 0);

  SpaceDemands tight = of_radius(0.01);
  tight.keep_in = Eigen::AlignedBox3d(Vec3(-0.01, -0.01, -0.01), Vec3(0.41, 0.195, 0.01));
  PccDemands free = tools({0.05});
  free.free_ends = 0.1;
  const auto beyond = violations(space_of(Scene(), tight), free, ends_of(two_bends()), two_bends());
  REQUIRE(!beyond.empty());
  for (const Violation& v : beyond) CHECK(v.kind == Violation::Kind::keep_in);
}

TEST_CASE("violations: each demand on straights, bends, length and directions") {
  const FreeSpace space = space_of(Scene(), of_radius(0.01));
  const double length = two_bends().length();
  PccDemands d = tools({0.05});
  const auto only = [&](const PccDemands& demands, Violation::Kind kind, double by, const std::string& text) {
    const auto all = found_in(space, demands, two_bends());
    REQUIRE(!all.empty());
    for (const Violation& v : all) {
      CHECK(v.kind == kind);
      CHECK(v.by == Approx(by).margin(1e-12));
    }
    CHECK(text_of(all.front(), space) == text);
  };
  d.min_straight = 0.1, d.end_straight = 0.15;
  CHECK(found_in(space, d, two_bends()).empty());
  d.min_straight = 0.103;
  only(d, Violation::Kind::straight, 0.003, "the straight between two bends 3.0 mm too short at 0.279 m");
  d = tools({0.05}), d.end_straight = 0.16;
  only(d, Violation::Kind::end_straight, 0.01, "the straight at an end 10.0 mm too short at 0.075 m");
  CHECK(found_in(space, d, two_bends()).size() == 2);
  d = tools({0.05}), d.min_length = length + 0.02;
  only(d, Violation::Kind::length, 0.02, "20.0 mm off the lengths allowed");
  d = tools({0.05}), d.max_length = length - 0.03;
  only(d, Violation::Kind::length, 0.03, "30.0 mm off the lengths allowed");
  d = tools({0.05}), d.max_turn = 80 * units::deg;
  only(d, Violation::Kind::turn, 10 * units::deg, "a bend turns 10 degrees too far at 0.189 m");
  only(tools({0.03, 0.0502, 0.08}), Violation::Kind::radius, 0.0002, "a bend's radius 0.2 mm off the nearest tool at 0.189 m");

  Ends turned = ends_of(two_bends());
  turned.finish_along = Vec3(std::cos(0.3), 0, std::sin(0.3));
  d = tools({0.05}), d.finish_cone = 0.25;
  const auto all = violations(space, d, turned, two_bends());
  REQUIRE(all.size() == 1);
  CHECK(all[0].kind == Violation::Kind::cone);
  CHECK(all[0].by == Approx(0.05));
  CHECK(all[0].s == Approx(length));
  CHECK(text_of(all[0], space) == "the direction of an end 2.865 degrees outside its cone at 0.557 m");
  d.finish_cone = 0.31;
  CHECK(violations(space, d, turned, two_bends()).empty());
  std::swap(turned.start_along, turned.finish_along);
  CHECK(violations(space, d, turned, two_bends()).front().s == 0);
}

TEST_CASE("violations: what is kept to the tolerance is kept; the worst share comes first") {
  const FreeSpace space = space_of(Scene(), of_radius(0.01));
  PccDemands d = tools({0.05});
  d.min_straight = 0.1 + 0.9e-5, d.max_length = two_bends().length() - 0.9e-5;
  CHECK(found_in(space, d, two_bends()).empty());
  d.min_straight = 0.2, d.end_straight = 0.16, d.max_length = two_bends().length() - 1e-3;
  const auto all = found_in(space, d, two_bends());
  REQUIRE(all.size() == 4);
  CHECK(all[0].kind == Violation::Kind::straight);
  CHECK(all[1].kind == Violation::Kind::end_straight);
  CHECK(all[3].kind == Violation::Kind::length);
}

TEST_CASE("violations: arcs that do not fit, vertices without a turn, edges without length") {
  Scene scene;
  scene.add(solid_of("ball", Sphere{0.05}, Vec3(0.2, 0.1, 0)));
  const FreeSpace space = space_of(scene, of_radius(0.01));
  PccPoints wide = two_bends();
  wide.radii = {0.15, 0.15};
  const auto all = found_in(space, tools({0.15}), wide);
  REQUIRE(all.size() == 1);  // of a curve that cannot be, no gap is looked for
  CHECK(all[0].kind == Violation::Kind::straight);
  CHECK(all[0].by == Approx(0.1));

  // A vertex without a turn is no bend: its radius does not count, and the straight goes on through it.
  const FreeSpace empty = space_of(Scene(), of_radius(0.01));
  PccPoints more{{{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}, {0.4, 0.2, 0}}, {0.07, 0.05, 0.05}};
  PccDemands d = tools({0.05});
  d.end_straight = 0.15, d.min_straight = 0.1;
  CHECK(found_in(empty, d, more).empty());
  more.points.insert(more.points.begin() + 2, more.points[2]);
  more.radii.insert(more.radii.begin(), 0.05);
  const auto doubled = found_in(empty, d, more);
  REQUIRE(!doubled.empty());  // no arc fits on an edge without length
  for (const Violation& v : doubled) CHECK(std::isfinite(v.by));
  const PccPoints back{{{0, 0, 0}, {0.2, 0, 0}, {0, 0, 0}}, {0.05}};
  CHECK(one_of(found_in(empty, tools({0.05}), back), Violation::Kind::turn));
}

TEST_CASE("violations: within the free ends the centre line does not pass through a surface") {
  const Mesh plate = test::box_mesh(Vec3(0.001, 0.05, 0.05));
  Scene scene;
  PlacedObstacle obstacle = obstacle_of("plate", plate);
  obstacle.body.pose.at = Vec3(0.05, 0, 0);
  scene.add(std::move(obstacle));
  const FreeSpace space = space_of(scene, of_radius(0.01));
  PccDemands d = tools({0.05});
  d.free_ends = 0.08;
  const auto all = found_in(space, d, two_bends());
  REQUIRE(all.size() == 1);
  CHECK(all[0].kind == Violation::Kind::crossing);
  CHECK(all[0].s == Approx(0.049).margin(1e-9));
  CHECK(text_of(all[0], space) == "the free end passes through 'plate' at 0.049 m");
  // Beside it the free end may pass as close as it likes, and it may begin on a surface.
  PccPoints beside = two_bends();
  for (Vec3& p : beside.points) p.z() = 0.0501;
  CHECK(found_in(space, d, beside).empty());
  PccPoints from = two_bends();
  for (Vec3& p : from.points) p.x() += 0.051;
  CHECK(found_in(space, d, from).empty());
  d.free_ends = 0;
  CHECK(found_in(space, d, from).front().kind == Violation::Kind::clearance);
}

TEST_CASE("violations: what is refused") {
  const FreeSpace space = space_of(Scene(), of_radius(0.01));
  const auto refused = [&](const PccDemands& d, const PccPoints& curve, const std::string& what, double tolerance = 1e-5) {
    CHECK_THROWS_WITH(violations(space, d, ends_of(two_bends()), curve, tolerance), "violations: " + what);
  };
  PccPoints curve = two_bends();
  curve.radii.pop_back();
  refused(tools({0.05}), curve, "4 points and 1 radii; two ends, and a radius for each vertex between them, are expected");
  curve = two_bends(), curve.points[1].x() = NAN;
  refused(tools({0.05}), curve, "a point of the curve is not finite");
  curve = two_bends(), curve.radii[1] = -1;
  refused(tools({0.05}), curve, "a radius of the curve is not finite or negative");
  refused(tools({}), two_bends(), "no bend radius is allowed; at least one expected");
  PccDemands d = tools({0.05});
  d.free_ends = -1;
  refused(d, two_bends(), "the free ends are -1 m; at least 0 expected");
  refused(tools({0.05}), two_bends(), "the tolerance is 0; above 0 expected", 0);
  curve = two_bends(), curve.points[0].x() = 0.01;
  refused(tools({0.05}), curve, "the curve does not begin at the start");
  curve = two_bends(), curve.points[3].x() = 0.41;
  refused(tools({0.05}), curve, "the curve does not end at the finish");
}

TEST_CASE("violations: every kind has a name of its own") {
  std::vector<std::string> names;
  for (int k = 0; k <= static_cast<int>(Violation::Kind::crossing); ++k) {
    const std::string name = name_of(static_cast<Violation::Kind>(k));
    CHECK(!name.empty());
    CHECK(std::find(names.begin(), names.end(), name) == names.end());
    names.push_back(name);
  }
}

TEST_CASE("violations: overlapping arcs are never forgiven") {
  const FreeSpace space = space_of(Scene(), of_radius(0.01));
  PccPoints curve{{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.1 - 5e-7, 0}, {0.4, 0.1 - 5e-7, 0}}, {0.05, 0.05}};
  const auto all = found_in(space, tools({0.05}), curve);
  REQUIRE(all.size() == 1);
  CHECK(all[0].kind == Violation::Kind::straight);
  CHECK(found_in(space, tools({0.05}), fitted(curve)).empty());
}
