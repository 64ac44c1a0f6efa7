// The inclusion-exclusion energy of contact: sum of weight * phi(distance) with phi(d) = (range - d)^(5/2).
#include <catch2/catch.hpp>

#include "bench/test_surface.h"
#include "geometry/surroundings.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;
using tendril::test::triangle_soup;

namespace {

struct Energy {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

double phi(double d, double range) { return d < range ? std::pow(range - d, 2.5) : 0; }

Energy energy_at(const ContactField& field, const Vec3& p, double range, double most = 0) {
  std::vector<DistanceTerm> terms;
  field.terms_kept(p, range, most, terms);
  Energy e;
  for (const DistanceTerm& t : terms) {
    const double delta = range - t.distance;
    const double first = -2.5 * std::pow(delta, 1.5), second = 3.75 * std::sqrt(delta);
    e.value += t.weight * std::pow(delta, 2.5);
    e.gradient += t.weight * first * t.normal;
    e.hessian += t.weight * (second * t.normal * t.normal.transpose() + first * t.hessian);
  }
  return e;
}

Surroundings around(Mesh mesh, const Frame& pose = {}, double clearance = 0) {
  Surroundings field;
  field.add({std::make_shared<const TriangleSurface>(std::move(mesh)), pose, clearance});
  return field;
}

// A plate of 2 x 2 m at z = 0: a regular grid or one whose inner vertices are moved about at random.
Mesh plate(int n, Random* random = nullptr) {
  Mesh mesh;
  add_patch(mesh, n, n, [&](double u, double v) {
    const bool inner = u > 0 && u < 1 && v > 0 && v < 1;
    const double shake = inner && random ? 0.5 / n : 0;
    return Vec3(2 * u - 1 + (shake > 0 ? random->in(-shake, shake) : 0),
                2 * v - 1 + (shake > 0 ? random->in(-shake, shake) : 0), 0);
  });
  return mesh;
}

// Ground with valleys and ridges, an open edge, a fin standing on it, and a second layer through it.
Mesh rough_surface() {
  Mesh mesh;
  add_patch(mesh, 9, 9, [](double u, double v) { return Vec3(2 * u - 1, 2 * v - 1, 0.25 * std::sin(9 * u) * std::cos(7 * v)); });
  const int first = static_cast<int>(mesh.vertices.size());
  // The fin shares a grid edge: three triangles meet there.
  mesh.vertices.push_back(mesh.vertices[44] + Vec3(0.02, 0.05, 0.6));
  mesh.triangles.push_back({44, 45, first});
  return mesh;
}

// 6-point fifth-order-accurate central difference of a scalar function along a direction.
template <class F>
double slope(const F& f, double h) {
  return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

}  // namespace

TEST_CASE("on a convex body the energy is that of the closest point alone", "[contact]") {
  Random random(41);
  for (int n : {1, 2, 7}) {
    const Vec3 half(0.7, 0.5, 0.3);
    const Frame pose{random.point(3), random.rotation()};
    const Surroundings mesh = around(box_mesh(half, n), pose);
    Surroundings solid;
    solid.add({Solid(Box{2 * half}), pose, 0});
    int reached = 0;
    for (int i = 0; i < 400; ++i) {
      // Above the faces, beside the edges, and off the corners, outside; not so deep that opposite walls are in range.
      const Vec3 p = pose.at + pose.rotation * Vec3(1.4 * random.point(1).cwiseProduct(half));
      const double range = 0.2, d = solid.closest(p, 9).distance;
      if (d <= 0) continue;
      const Energy e = energy_at(mesh, p, range), one = energy_at(solid, p, range);
      reached += one.value > 0;
      CHECK(e.value == Approx(phi(d, range)).margin(1e-12));
      CHECK(one.value == Approx(phi(d, range)).margin(1e-14));
      CHECK((e.gradient - one.gradient).norm() < 1e-10);
      CHECK((e.hessian - one.hessian).norm() < 1e-8 * (1 + one.hessian.norm()));
    }
    CHECK(reached > 50);
  }
}

TEST_CASE("the energy does not depend on the tessellation of a plate", "[contact]") {
  Random random(43);
  const Surroundings coarse = around(plate(1)), fine = around(plate(13)), shaken = around(plate(24, &random));
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(random.in(-1.2, 1.2), random.in(-1.2, 1.2), random.in(-0.3, 0.3));
    const Energy a = energy_at(coarse, p, 0.25), b = energy_at(fine, p, 0.25), c = energy_at(shaken, p, 0.25);
    CHECK(a.value == Approx(phi(coarse.closest(p, 9).distance, 0.25)).margin(1e-13));
    CHECK(b.value == Approx(a.value).margin(1e-12));
    CHECK(c.value == Approx(a.value).margin(1e-12));
    CHECK((b.gradient - a.gradient).norm() < 1e-10);
    CHECK((c.gradient - a.gradient).norm() < 1e-10);
    CHECK((c.hessian - a.hessian).norm() < 1e-7 * (1 + a.hessian.norm()));
  }
}

TEST_CASE("straight above the edges and vertices within a plane there is a plane and nothing else", "[contact]") {
  Random random(45);
  const Frame pose{random.point(1), random.rotation()};
  for (const Frame& frame : {Frame{}, pose}) {
    const Surroundings field = around(plate(8), frame);
    const Vec3 up = frame.rotation * Vec3::UnitZ();
    const double range = 0.2, height = 0.15;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.25, 0, 0), Vec3(0.1, 0, 0), Vec3(0.25, 0.1, 0), Vec3(0.1, 0.1, 0),
                           Vec3(0.5, -0.75, 0), Vec3(0.125, 0.125, 0)}) {
      const Energy e = energy_at(field, (frame * Frame{at + Vec3(0, 0, height), Quat::Identity()}).at, range);
      const double delta = range - height;
      CHECK(e.value == Approx(phi(height, range)).epsilon(1e-10));
      CHECK((e.gradient + 2.5 * std::pow(delta, 1.5) * up).norm() < 1e-9);
      CHECK((e.hessian - 3.75 * std::sqrt(delta) * up * up.transpose()).norm() < 1e-6);
    }
  }
}

TEST_CASE("where a foot passes from a face to its edge the Hessian is the mean of both sides", "[contact]") {
  const Surroundings field = around(box_mesh({1, 1, 1}, 3));
  const double range = 0.3, h = 1e-4;
  for (const Vec3& at : {Vec3(1, 0.2, 1.1), Vec3(1.1, 1, 0.4)}) {
    const Vec3 across = at.x() == 1 ? Vec3::UnitX() : Vec3::UnitY();
    const Mat3 mean = 0.5 * (energy_at(field, at + h * across, range).hessian + energy_at(field, at - h * across, range).hessian);
    CHECK((energy_at(field, at, range).hessian - mean).norm() < 1e-2);
    CHECK((energy_at(field, at + h * across, range).hessian - mean).norm() > 1);
  }
}

TEST_CASE("in a concave corner both walls count", "[contact]") {
  // A floor (z = 0) and a wall (x = 0) that meet at a right angle.
  Mesh mesh;
  mesh.vertices = {{0, -5, 0}, {5, -5, 0}, {5, 5, 0}, {0, 5, 0}, {0, -5, 5}, {0, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  const Surroundings corner = around(mesh);
  const double range = 0.3;
  for (const Vec3& p : {Vec3(0.1, 0.4, 0.2), Vec3(0.2, 0.1, 0.2), Vec3(0.25, -1, 0.05)}) {
    const double edge = std::hypot(p.x(), p.z());
    const Energy e = energy_at(corner, p, range);
    CHECK(e.value == Approx(phi(p.x(), range) + phi(p.z(), range) - phi(edge, range)));
  }
}

TEST_CASE("the energy is continuously differentiable along random lines", "[contact]") {
  for (unsigned seed : {51u, 52u, 53u}) {
    Random random(seed);
    CAPTURE(seed);
    const Surroundings field = around(rough_surface());
    const double range = 0.35;
    double worst = 0, largest = 0;
    for (int line = 0; line < 40; ++line) {
      const Vec3 from = random.point(1.1).cwiseProduct(Vec3(1, 1, 0.6)), way = random.direction();
      const double step = 2e-5;
      Energy last = energy_at(field, from, range);
      for (int i = 1; i < 2000; ++i) {
        const Energy now = energy_at(field, from + i * step * way, range);
        // Passing through the surface itself is no smooth matter for a distance without sign.
        if (field.closest(from + i * step * way, 9).distance > 0.01) {
          worst = std::max(worst, (now.gradient - last.gradient).norm());
          largest = std::max(largest, now.gradient.norm());
        }
        last = now;
      }
    }
    // A kink of the energy would be a jump of the gradient of its own size, the step is 1/500 of the least distance.
    CHECK(worst < 0.02 * largest);
    CHECK(largest > 0.1);
  }
}

TEST_CASE("gradient and Hessian of the energy against finite differences", "[contact]") {
  for (unsigned seed : {61u, 62u, 63u}) {
    Random random(seed);
    CAPTURE(seed);
    const Frame pose{random.point(2), random.rotation()};
    const double kept = seed == 63 ? 0.05 : 0;
    const Surroundings field = around(rough_surface(), pose, kept);
    int checked = 0;
    for (int i = 0; i < 600; ++i) {
      const Vec3 p = pose.at + pose.rotation * random.point(1).cwiseProduct(Vec3(1.2, 1.2, 0.7));
      const double range = 0.3, h = 1e-5;
      if (field.closest(p, 9).distance < 0.02) continue;
      const Vec3 way = random.direction();
      const Energy e = energy_at(field, p, range, kept);
      const double by_value = slope([&](double t) { return energy_at(field, p + t * way, range, kept).value; }, h);
      CHECK(e.gradient.dot(way) == Approx(by_value).margin(2e-8));
      // The Hessian jumps where a foot passes from one feature to another: only where both sides agree.
      const auto gradient = [&](double t) { return energy_at(field, p + t * way, range, kept).gradient; };
      const Vec3 forward = (gradient(h) - e.gradient) / h, backward = (e.gradient - gradient(-h)) / h;
      if ((forward - backward).norm() > 1e-3) continue;
      ++checked;
      CHECK((e.hessian * way - 0.5 * (forward + backward)).norm() < 1e-3 * (1 + e.hessian.norm()));
    }
    CHECK(checked > 200);
  }
}

TEST_CASE("a kept clearance moves the surface out by that much, and no more than is asked for", "[contact]") {
  const Surroundings bare = around(plate(5)), thick = around(plate(5), {}, 0.1);
  const Vec3 p(0.3, 0.2, 0.25);
  CHECK(thick.closest(p, 9).distance == Approx(0.25));
  for (const auto& [most, counts] : {std::pair{9.0, 0.1}, {0.1, 0.1}, {0.04, 0.04}, {0.0, 0.0}}) {
    CAPTURE(most);
    CHECK(thick.closest_kept(p, 9, most).distance == Approx(0.25 - counts));
    CHECK(thick.closest_kept(p, 9, most).point.isApprox(Vec3(0.3, 0.2, 0)));
    CHECK(thick.closest_kept(p, 0.1, most).obstacle == -1);
    CHECK(thick.closest_kept(p, 0.1, most).distance == 0.1);
    CHECK(energy_at(thick, p, 0.2, most).value == Approx(energy_at(bare, p, 0.2 + counts).value));
    CHECK(energy_at(thick, p, 0.2, most).gradient.isApprox(energy_at(bare, p, 0.2 + counts).gradient));
  }
  CHECK(thick.clearance(0) == 0.1);
  CHECK(thick.largest_clearance() == 0.1);
  CHECK(bare.largest_clearance() == 0);
}

TEST_CASE("terms are finite on the surface itself and for degenerate and repeated triangles", "[contact]") {
  Random random(71);
  Mesh mesh = triangle_soup(300, 0.4, random);
  mesh.triangles.push_back(mesh.triangles[7]);
  const Surroundings field = around(mesh);
  for (int i = 0; i < 300; ++i) {
    const auto& t = mesh.triangles[random.below(300)];
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Vec3 p = i % 3 == 0 ? a : i % 3 == 1 ? Vec3(0.5 * (a + b)) : Vec3((a + b + c) / 3);
    std::vector<DistanceTerm> terms;
    field.terms(p, 0.3, terms);
    REQUIRE_FALSE(terms.empty());
    for (const DistanceTerm& term : terms) {
      CHECK(std::isfinite(term.distance));
      CHECK(term.normal.norm() == Approx(1));
      CHECK(all_finite(term.hessian));
      CHECK(term.distance < 0.3);
    }
  }
  std::vector<DistanceTerm> none;
  field.terms({std::nan(""), 0, 0}, 1, none);
  field.terms({0, 0, 0}, -1, none);
  CHECK(none.empty());
}
