// Passages by the free-space diagram: windows and posts with known counts, and words of the free group as an oracle.
#include <catch2/catch.hpp>

#include <algorithm>
#include <utility>

#include "method/pcc/pcc_check.h"
#include "method/preform/passage_match.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::preform;
using namespace tendril::testing;

namespace {

routing::SpaceDemands hose(double radius, double clearance = 0) {
  routing::SpaceDemands demands;
  demands.radius = radius;
  demands.clearance = clearance;
  return demands;
}

/// A wall in the plane x = 0 with windows of 120 mm around y = -0.2 and y = 0.2, z = 0.
Scene two_windows() {
  Scene scene;
  const auto part = [&](const char* name, const Vec3& low, const Vec3& high) {
    scene.add(solid_of(name, Box{high - low}, 0.5 * (low + high)));
  };
  part("left", {-0.01, 0.26, -1}, {0.01, 2, 1});
  part("pillar", {-0.01, -0.14, -1}, {0.01, 0.14, 1});
  part("right", {-0.01, -2, -1}, {0.01, -0.26, 1});
  part("sill", {-0.01, -2, -1}, {0.01, 2, -0.06});
  part("lintel", {-0.01, -2, 0.06}, {0.01, 2, 1});
  return scene;
}

PccPoints through(const std::vector<Vec3>& vertices, double radius = 0.05) {
  PccPoints curve;
  curve.points.push_back({-0.6, 0, 0});
  curve.points.insert(curve.points.end(), vertices.begin(), vertices.end());
  curve.points.push_back({0.6, 0, 0});
  curve.radii.assign(vertices.size(), radius);
  return curve;
}

/// Posts along z through the whole height of the region, from which nothing leads over or under them.
struct Posts {
  std::vector<Vec3> at;
  Scene scene;
  routing::SpaceDemands demands;
  void add(double x, double y, double radius) {
    at.emplace_back(x, y, 0);
    scene.add(solid_of("post " + std::to_string(at.size()), Cylinder{radius, 4}, at.back()));
  }
};

/// The crossings of the half-lines from each post towards +y, as letters: capitals one way, then reduced.
std::string word_of(const PccPoints& curve, const std::vector<Vec3>& posts) {
  const std::vector<Vec3> places = places_along(curve, 2000, 0, curve.length());
  std::string word;
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    for (std::size_t p = 0; p < posts.size(); ++p) {
      const double before = places[k].x() - posts[p].x(), after = places[k + 1].x() - posts[p].x();
      if ((before < 0) == (after < 0)) continue;
      const double share = before / (before - after);
      if (places[k].y() + share * (places[k + 1].y() - places[k].y()) < posts[p].y()) continue;
      const char letter = static_cast<char>((before < 0 ? 'A' : 'a') + p);
      if (!word.empty() && word.back() != letter && std::toupper(word.back()) == std::toupper(letter)) word.pop_back();
      else word.push_back(letter);
    }
  return word;
}

}  // namespace

TEST_CASE("places along a curve: equal arc lengths, both ends") {
  Random random(3);
  const PccPoints curve = random_pcc(random, 4, 0.05);
  const double length = curve.length();
  const std::vector<Vec3> places = places_along(curve, 31, 0.1 * length, 0.9 * length);
  REQUIRE(places.size() == 31);
  for (int k = 0; k < 31; ++k) CHECK((places[k] - curve.curve().at(length * (0.1 + 0.8 * k / 30)).at).norm() < 1e-9);
}

TEST_CASE("same passage: two windows") {
  const Scene scene = two_windows();
  const FreeSpace space(scene, hose(0.012, 0.008), {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  const PccPoints left = through({{-0.2, 0.2, 0}, {0.2, 0.2, 0}}), higher = through({{-0.15, 0.23, 0.03}, {0.15, 0.18, 0.03}});
  const PccPoints right = through({{-0.2, -0.2, 0}, {0.2, -0.2, 0}});
  for (const PccPoints* curve : {&left, &higher, &right}) REQUIRE(routing::is_clear(space, *curve, 0));
  std::vector<int> blocking{7};
  CHECK(same_passage(space, left, left, 0, &blocking));
  CHECK(blocking.empty());
  CHECK(same_passage(space, left, higher));
  CHECK(same_passage(space, higher, left));
  CHECK(!same_passage(space, left, right, 0, &blocking));
  REQUIRE(!blocking.empty());
  CHECK(space.name(blocking[0]) == "pillar");
  CHECK(!same_passage(space, right, higher, 0, &blocking));

  // Without the pillar there is one window.
  Scene open = two_windows();
  open.remove("pillar");
  const FreeSpace wider(open, hose(0.012, 0.008), {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  CHECK(same_passage(wider, left, right));
  const FreeSpace nothing(Scene(), hose(0.012), {{-0.6, 0, 0}}, 0.2);
  CHECK(same_passage(nothing, left, right));
}

TEST_CASE("same passage: thin and thick objects, the same wall as boxes and as triangles") {
  const double radius = GENERATE(0.0005, 0.002, 0.02, 0.04);
  CAPTURE(radius);
  const Scene boxes = two_windows();
  Mesh wall;
  for (const PlacedObstacle& part : boxes.obstacles()) {
    const Mesh box = test::box_mesh(0.5 * std::get<Box>(std::get<Solid>(part.body.shape)).size, 4)
                         .moved(part.body.pose.at, Quat::Identity());
    const int first = static_cast<int>(wall.vertices.size());
    wall.vertices.insert(wall.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (const auto& t : box.triangles) wall.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  Scene mesh;
  mesh.add(obstacle_of("wall", wall));
  for (const Scene* scene : {&std::as_const(mesh), &boxes}) {
    const FreeSpace space(*scene, hose(radius), {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
    const PccPoints left = through({{-0.2, 0.2, 0}, {0.2, 0.2, 0}}), other = through({{-0.15, 0.21, 0.01}, {0.15, 0.19, 0.01}});
    const PccPoints right = through({{-0.2, -0.2, 0}, {0.2, -0.2, 0}});
    CHECK(same_passage(space, left, other));
    CHECK(!same_passage(space, left, right));
  }
}

TEST_CASE("same passage: one curve lingers where the other goes on") {
  // Both go around one post the same way; one makes a long detour first, so that equal shares are on different sides of it.
  Scene scene;
  scene.add(solid_of("post", Cylinder{0.1, 4}, Vec3(0.4, 0, 0)));
  const FreeSpace space(scene, hose(0.01), {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  const PccPoints direct = through({{-0.1, 0, 0}, {0.3, 0.25, 0}, {0.5, 0.25, 0}}, 0.03);
  const PccPoints detour = through({{-0.5, 0, 0}, {-0.5, 0.9, 0}, {-0.3, 0.9, 0}, {-0.3, 0.25, 0}, {0.5, 0.25, 0}}, 0.03);
  REQUIRE(routing::is_clear(space, direct, 0));
  REQUIRE(routing::is_clear(space, detour, 0));
  CHECK(same_passage(space, direct, detour));
  CHECK(same_passage(space, detour, direct));
}

TEST_CASE("same passage: free ends are not looked at") {
  // Both start within a socket, which is nearer than the clearance that is demanded.
  Scene scene;
  scene.add(solid_of("socket", Cylinder{0.03, 0.1}, Vec3(-0.6, 0, -0.06)));
  const FreeSpace space(scene, hose(0.01, 0.01), {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  const PccPoints a = through({{-0.3, 0, 0}, {0, 0.1, 0}}), b = through({{-0.3, 0, 0}, {0, -0.1, 0}});
  CHECK(!same_passage(space, a, b));
  CHECK(same_passage(space, a, b, 0.1));
}

TEST_CASE("same passage: gaps in rows of posts are counted") {
  const int in_first = GENERATE(1, 2, 3), in_second = GENERATE(0, 1, 2);
  Posts posts;
  const auto row = [&](double x, int count) {
    std::vector<double> gaps;  // the middles
    for (int k = 0; k <= count; ++k) gaps.push_back(0.16 * (k - 0.5 * count));
    for (int k = 0; k < count; ++k) posts.add(x, 0.5 * (gaps[k] + gaps[k + 1]), 0.03);
    return gaps;
  };
  const std::vector<double> first = row(-0.2, in_first), second = row(0.2, in_second);
  posts.demands = hose(0.01, 0.005);
  posts.demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.7, -0.6, -0.1), Vec3(0.7, 0.6, 0.1));
  const FreeSpace space(posts.scene, posts.demands, {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  std::vector<PccPoints> curves;
  for (const double y : first)
    for (const double z : {-0.02, 0.05})
      for (const double w : second) curves.push_back(through({{-0.3, y, z}, {-0.1, y, z}, {0.1, w, z}, {0.3, w, 0}}, 0.02));
  std::vector<int> passage(curves.size(), -1);
  int passages = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    CAPTURE(i);
    REQUIRE(routing::is_clear(space, curves[i], 0));
    for (std::size_t j = 0; j < i; ++j) {
      const bool same = same_passage(space, curves[j], curves[i]);
      CHECK(same == (word_of(curves[i], posts.at) == word_of(curves[j], posts.at)));
      if (same && passage[i] < 0) passage[i] = passage[j];
    }
    if (passage[i] < 0) passage[i] = passages++;
  }
  CHECK(passages == (in_first + 1) * (in_second + 1));
}

TEST_CASE("same passage: a yes never joins different words, in random fields of posts") {
  const unsigned seed = GENERATE(range(1u, 9u));
  CAPTURE(seed);
  Random random(seed);
  Posts posts;
  for (int k = 0; k < 6; ++k) posts.add(random.in(-0.4, 0.4), random.in(-0.4, 0.4), random.in(0.01, 0.06));
  posts.demands = hose(random.in(0.003, 0.015), 0.002);
  posts.demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.7, -1, -0.2), Vec3(0.7, 1, 0.2));
  const FreeSpace space(posts.scene, posts.demands, {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.2);
  std::vector<PccPoints> curves;
  for (int tries = 0; tries < 3000 && curves.size() < 24; ++tries) {
    std::vector<Vec3> vertices;
    const int bends = 2 + random.below(3);
    for (int k = 0; k < bends; ++k)
      vertices.emplace_back(-0.5 + (k + 0.5) / bends + random.in(-0.05, 0.05), random.in(-0.5, 0.5), random.in(-0.1, 0.1));
    const PccPoints curve = through(vertices, 0.03);
    if (routing::overlap_of(curve) == 0 && routing::is_clear(space, curve, 0)) curves.push_back(curve);
  }
  int alike = 0, found = 0;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool same_word = word_of(curves[i], posts.at) == word_of(curves[j], posts.at);
      const bool yes = same_passage(space, curves[i], curves[j]);
      REQUIRE(!(yes && !same_word));
      CHECK(yes == same_passage(space, curves[j], curves[i]));
      alike += same_word;
      found += yes;
    }
  CAPTURE(curves.size(), alike, found);
  CHECK(found >= 0.9 * alike);
}

TEST_CASE("same passage: moved as a whole it is the same") {
  const Quat turn = Random(5).rotation();
  const Vec3 by(3, -2, 1);
  const Scene scene = two_windows();
  Scene moved;
  for (PlacedObstacle part : scene.obstacles()) {
    part.body.pose = {turn * part.body.pose.at + by, turn * part.body.pose.rotation};
    moved.add(std::move(part));
  }
  const auto carried = [&](PccPoints curve) {
    for (Vec3& p : curve.points) p = turn * p + by;
    return curve;
  };
  const PccPoints left = through({{-0.2, 0.2, 0}, {0.2, 0.2, 0}}), higher = through({{-0.15, 0.23, 0.03}, {0.15, 0.18, 0.03}});
  const PccPoints right = through({{-0.2, -0.2, 0}, {0.2, -0.2, 0}});
  const FreeSpace space(moved, hose(0.012, 0.008), {carried(left).points.front(), carried(left).points.back()}, 0.2);
  std::vector<int> blocking;
  CHECK(same_passage(space, carried(left), carried(higher)));
  CHECK(!same_passage(space, carried(left), carried(right), 0, &blocking));
  CHECK(space.name(blocking.at(0)) == "pillar");
}
