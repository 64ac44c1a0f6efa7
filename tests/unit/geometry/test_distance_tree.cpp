#include <catch2/catch.hpp>
#include <set>

#include "bench/test_surface.h"
#include "geometry/closest_point.h"
#include "geometry/distance_tree.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;
using tendril::test::triangle_soup;

namespace {

TriangleFoot foot_on(const Mesh& mesh, int triangle, const Vec3& p) {
  const auto& t = mesh.triangles[triangle];
  return closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

double brute_force(const Mesh& mesh, const Vec3& p) {
  double best = 1e300;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    best = std::min(best, foot_on(mesh, static_cast<int>(t), p).squared);
  return std::sqrt(best);
}

// The distance to a triangle by a minimisation that shares nothing with the formulas under test: alternating
// projection on ever finer barycentric grids.
double searched(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double u0 = 0, v0 = 0, width = 1, best = 1e300, bu = 0, bv = 0;
  for (int level = 0; level < 40; ++level) {
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; j <= 12; ++j) {
        const double u = std::clamp(u0 + width * i / 12, 0.0, 1.0), v = std::clamp(v0 + width * j / 12, 0.0, 1.0 - u);
        const double d = (p - a - u * (b - a) - v * (c - a)).norm();
        if (d < best) best = d, bu = u, bv = v;
      }
    width *= 0.5;
    u0 = bu - 0.5 * width;
    v0 = bv - 0.5 * width;
  }
  return best;
}

}  // namespace

TEST_CASE("closest point of a triangle against a search", "[tree]") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random.point(1), b = random.point(1), c = random.point(1), p = random.point(2);
    const TriangleFoot foot = closest_on_triangle(p, a, b, c);
    CHECK(std::sqrt(foot.squared) == Approx(searched(p, a, b, c)).epsilon(1e-6));
    CHECK((p - foot.point).norm() == Approx(std::sqrt(foot.squared)).epsilon(1e-12));
  }
}

TEST_CASE("closest point equals brute force, with every limit and hint", "[tree]") {
  for (unsigned seed : {1u, 2u, 3u, 4u}) {
    Random random(seed);
    CAPTURE(seed);
    const int count = seed == 1 ? 3 : 2000;
    const Mesh mesh = triangle_soup(count, seed == 3 ? 0.3 : 0.05, random);
    const DistanceTree tree(mesh);
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
      Vec3 p = random.point(i % 5 == 0 ? 20 : 1.2);
      if (i % 7 == 0) p = mesh.vertices[random.below(static_cast<int>(mesh.vertices.size()))];
      const double expected = brute_force(mesh, p);
      const auto found = tree.closest(p);
      wrong += found.distance != expected;
      wrong += std::abs((p - found.point).norm() - expected) > 1e-12;
      wrong += std::sqrt(foot_on(mesh, found.triangle, p).squared) != expected;
      // A hint changes nothing, be it good or bad.
      for (int hint : {found.triangle, random.below(count)}) {
        const auto hinted = tree.closest(p, 1e300, hint);
        wrong += hinted.triangle != found.triangle || hinted.distance != found.distance || hinted.point != found.point;
      }
      if (expected > 0) {
        const auto within = tree.closest(p, expected * (1 + 1e-9), random.below(count));
        wrong += within.triangle != found.triangle;
        const auto beyond = tree.closest(p, expected, found.triangle);
        wrong += beyond.triangle != -1 || beyond.distance != expected;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("closest point stays exact far from the origin and for all triangles equally near", "[tree]") {
  Random random(9);
  const Mesh mesh = triangle_soup(3000, 0.03, random).moved({4000, -7000, 250}, random.rotation());
  const DistanceTree tree(mesh);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = mesh.vertices[0] + random.point(1.5);
    CHECK(tree.closest(p).distance == brute_force(mesh, p));
  }
  // From the middle of a sphere all of it is as near: nothing can be left out.
  Mesh sphere;
  add_patch(sphere, 80, 40, [](double u, double v) {
    const double a = 2 * units::pi * u, b = units::pi * v;
    return Vec3(std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b));
  });
  CHECK(DistanceTree(sphere).closest({0, 0, 0}).distance == brute_force(sphere, {0, 0, 0}));
}

TEST_CASE("every triangle in range is visited once", "[tree]") {
  for (unsigned seed : {5u, 6u}) {
    Random random(seed);
    CAPTURE(seed);
    const Mesh mesh = triangle_soup(3000, 0.06, random);
    const DistanceTree tree(mesh);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random.point(1.2);
      const double range = random.in(0, 0.4);
      std::multiset<int> visited;
      tree.visit_near(p, range, [&](int t) { visited.insert(t); });
      int missing = 0, far = 0;
      for (int t = 0; t < 3000; ++t) {
        const double d = std::sqrt(foot_on(mesh, t, p).squared);
        missing += d < range && visited.count(t) != 1;
        far += d > range + 1e-4 && visited.count(t) != 0;
      }
      CHECK(missing == 0);
      CHECK(far == 0);
    }
  }
}

TEST_CASE("rays: the first hit equals brute force by plane and inside tests", "[tree]") {
  Random random(21);
  Mesh mesh;
  for (int i = 0; i < 800; ++i) {
    const Vec3 a = random.point(1);
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, a + 0.2 * random.direction(), a + 0.2 * random.direction()});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const DistanceTree tree(mesh);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.point(1.3), b = random.point(1.3);
    double best = 2;
    for (const auto& t : mesh.triangles) {
      Mat3 m;
      m << mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]], a - b;
      const Vec3 x = m.fullPivLu().solve(a - mesh.vertices[t[0]]);
      if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] > 0 && x[2] <= 1) best = std::min(best, x[2]);
    }
    const auto hit = tree.ray(a, b);
    REQUIRE(hit.has_value() == (best <= 1));
    if (!hit) continue;
    ++hits;
    CHECK(hit->share == Approx(best).margin(1e-9));
    CHECK(hit->point.isApprox(a + hit->share * (b - a), 1e-12));
    CHECK(hit->normal.norm() == Approx(1));
    CHECK(hit->normal.dot(b - a) < 0);
  }
  CHECK(hits > 200);
}

TEST_CASE("no ray slips through a closed surface, not even through its edges and corners", "[tree]") {
  for (unsigned seed : {31u, 32u}) {
    Random random(seed);
    CAPTURE(seed);
    const Quat turn = seed == 31 ? Quat::Identity() : random.rotation();
    const Vec3 at = seed == 31 ? Vec3(0, 0, 0) : Vec3(12.3, -4.5, 0.7);
    const Mesh mesh = box_mesh({1, 0.5, 0.25}, 6).moved(at, turn);
    const DistanceTree tree(mesh);
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 inside = at + turn * Vec3(random.point(1).cwiseProduct(Vec3(0.9, 0.45, 0.2)));
      const auto& t = mesh.triangles[random.below(static_cast<int>(mesh.triangles.size()))];
      // Straight through a vertex, through the middle of an edge, or a random point of the surface.
      const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]];
      const Vec3 aim = i % 3 == 0 ? a : i % 3 == 1 ? Vec3(a + random.in(0, 1) * (b - a)) : Vec3((a + b + mesh.vertices[t[2]]) / 3);
      const Vec3 outside = inside + 1.7 * (aim - inside);
      missed += !tree.ray(inside, outside) || !tree.ray(outside, inside);
    }
    CHECK(missed == 0);
  }
}

TEST_CASE("rays along the axes, within a plane, of no length, and not finite", "[tree]") {
  const Mesh mesh = box_mesh({1, 1, 1}, 2);
  const DistanceTree tree(mesh);
  const auto down = tree.ray({0.3, 0.2, 5}, {0.3, 0.2, -5});
  REQUIRE(down);
  CHECK(down->share == Approx(0.4));
  CHECK(down->normal.isApprox(Vec3::UnitZ()));
  CHECK_FALSE(tree.ray({0.3, 0.2, 5}, {0.3, 0.2, 1.000001}));
  CHECK(tree.ray({0.3, 0.2, 5}, {0.3, 0.2, 1}));        // ends on the surface
  CHECK_FALSE(tree.ray({0.3, 0.2, 1}, {0.3, 0.2, 5}));  // starts on it and leaves
  CHECK_FALSE(tree.ray({-0.9, 0.2, 1}, {0.9, 0.3, 1}));  // within a face
  CHECK_FALSE(tree.ray({0, 0, 0}, {0, 0, 0}));
  CHECK_FALSE(tree.ray({0, 0, 0}, {0, 0, std::nan("")}));
  CHECK(tree.closest({0, 0, std::nan("")}).triangle == -1);
}

TEST_CASE("a thousand triangles in one place, and all on a line, still make a tree", "[tree]") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(1000, {0, 1, 2});
  CHECK(DistanceTree(mesh).closest({0.2, 0.2, 3}).distance == Approx(3));
  Mesh line;
  double x = 1;
  for (int i = 0; i < 900; ++i, x *= 1.02) {
    line.vertices.insert(line.vertices.end(), {{x, 0, 0}, {1.01 * x, 0, 0}, {x, 0.001 * x, 0}});
    line.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const DistanceTree tree(line);
  for (double at : {0.5, 1.0, 7.0, 5e3, 1e8}) CHECK(tree.closest({at, 1, 1}).distance == brute_force(line, {at, 1, 1}));
}
